/** The canvas: renderer, camera, one or two panels side by side, and the quality that the machine can afford. */
import {
  ACESFilmicToneMapping, BackSide, Color, Mesh, MeshBasicMaterial, BasicShadowMap, PCFShadowMap, PerspectiveCamera, PMREMGenerator,
  Raycaster, Scene, SphereGeometry, Vector2, Vector3, WebGLRenderer, type Ray, type Texture,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { WorldPanel, type Theme } from './panel';
import { bestDirection, fittingDistance } from './vantage';

export type Quality = 'high' | 'medium' | 'low' | 'lowest';

interface QualityPlan { pixels: number; fine: boolean; soft: boolean; shadow: number; shadowEvery: number }

const plans: Record<Quality, QualityPlan> = {
  high: { pixels: 2, fine: true, soft: true, shadow: 2048, shadowEvery: 1 },
  medium: { pixels: 1, fine: true, soft: true, shadow: 1024, shadowEvery: 1 },
  low: { pixels: 0.8, fine: false, soft: false, shadow: 1024, shadowEvery: 1 },
  lowest: { pixels: 0.5, fine: false, soft: false, shadow: 512, shadowEvery: 2 },
};
const order: Quality[] = ['high', 'medium', 'low', 'lowest'];
/** without a new picture for so long nothing moves any more [ms] */
const restTime = 400;
/** a picture that takes longer is too slow [ms] */
const slowPicture = 55;

export class Stage {
  readonly camera = new PerspectiveCamera(42, 1, 0.02, 500);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  panels: WorldPanel[] = [new WorldPanel()];
  shadows = true;
  /** drawn in the last second */
  picturesPerSecond = 0;
  private readonly renderer: WebGLRenderer;
  private theme: Theme = 'light';
  private quality: Quality = 'medium';
  private fixedQuality = false;
  private environment: Texture | null = null;
  private dirty = true;
  /** how many were drawn */
  pictures = 0;
  private staleShadows = false;
  private lastTick = 0;
  private drewLast = false;
  private drawnAt: number[] = [];
  private readonly judged = { ms: 0, pictures: 0, slowSeconds: 0 };

  /** @param purpose films take the time for smooth edges whatever draws them */
  constructor(parent: HTMLElement, purpose: 'page' | 'film' = 'page') {
    const software = isSoftware();
    this.renderer = new WebGLRenderer({ antialias: purpose === 'film' || !software, powerPreference: 'high-performance' });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.canvas.className = 'stage';
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('aria-label', 'The simulated world');
    parent.append(this.canvas);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = Math.PI * 0.93;
    this.controls.addEventListener('change', () => this.touch());
    this.fixedQuality = new URLSearchParams(location.search).has('quality');
    const wished = new URLSearchParams(location.search).get('quality') as Quality | null;
    this.setQuality(wished && order.includes(wished) ? wished : software ? 'low' : 'high');
    new ResizeObserver(() => this.resize()).observe(parent);
    this.resize();
  }

  get currentQuality(): Quality { return this.quality; }

  /** Something changed: the next picture is needed. */
  touch(): void { this.dirty = true; }

  setPanels(count: number): void {
    while (this.panels.length < count) {
      const panel = new WorldPanel();
      panel.setTheme(this.theme);
      this.panels.push(panel);
    }
    this.panels.length = count;
    this.setQuality(this.quality);
    this.resize();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    for (const panel of this.panels) panel.setTheme(theme);
    this.applyEnvironment();
    this.touch();
  }

  /** One chosen by hand stays. */
  chooseQuality(quality: Quality): void {
    this.fixedQuality = true;
    this.setQuality(quality);
  }

  /** For pictures and films: exact size and one quality. */
  fix(width: number, height: number): void {
    this.chooseQuality('high');
    this.makeEnvironment();
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** Looks at what the first panel shows from the front, as far from above as is needed. @param margin 1 = as large as possible */
  frameAll(margin = 1.25): void {
    const { roster, frame, extent } = this.panels[0];
    const { box, radius } = extent;
    const tangent = Math.tan((this.camera.fov * Math.PI) / 360);
    const towards = bestDirection(roster, frame, 20 * radius);
    const distance = margin * fittingDistance(box, towards, tangent, this.camera.aspect);
    const target = box.getCenter(new Vector3());
    this.controls.target.copy(target);
    this.camera.position.copy(towards).multiplyScalar(distance).add(target);
    this.camera.near = Math.max(0.005, distance / 400);
    this.camera.far = distance * 60;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.touch();
  }

  lookFrom(camera: number[]): void {
    this.camera.position.set(camera[0], camera[1], camera[2]);
    this.controls.target.set(camera[3], camera[4], camera[5]);
    this.controls.update();
    this.touch();
  }

  /** @param x, y [CSS pixels of the window] @return the ray and the panel under a point */
  rayAt(x: number, y: number): { ray: Ray; panel: WorldPanel } {
    const box = this.canvas.getBoundingClientRect();
    const columns = this.panels.length;
    const width = box.width / columns;
    const column = Math.min(columns - 1, Math.max(0, Math.floor((x - box.left) / width)));
    const inside = new Vector2((((x - box.left) % width) / width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const caster = new Raycaster();
    caster.setFromCamera(inside, this.camera);
    return { ray: caster.ray, panel: this.panels[column] };
  }

  /** @return CSS pixels of a point of the world, in the first panel */
  project(point: Vector3): { x: number; y: number } {
    const p = point.clone().project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    const width = box.width / this.panels.length;
    return { x: box.left + ((p.x + 1) / 2) * width, y: box.top + ((1 - p.y) / 2) * box.height };
  }

  /** Draws if something changed. @param now [ms] @return true if it drew */
  render(now: number): boolean {
    if (this.drewLast) this.judge(now - this.lastTick);
    this.lastTick = now;
    this.drewLast = this.dirty;
    if (this.dirty) this.drawnAt.push(now);
    while (this.drawnAt[0] < now - 1000) this.drawnAt.shift();
    this.picturesPerSecond = this.drawnAt.length;
    if (!this.dirty) {
      // The last picture of a movement gets its own shadows; between two it would only cost time.
      if (this.staleShadows && !(now - this.drawnAt[this.drawnAt.length - 1] < restTime)) this.draw(true);
      return false;
    }
    this.dirty = false;
    this.draw(this.pictures % plans[this.quality].shadowEvery === 0);
    return true;
  }

  draw(withShadows = true): void {
    const size = this.renderer.getSize(new Vector2());
    const columns = this.panels.length;
    const width = size.x / columns;
    this.renderer.setScissorTest(columns > 1);
    this.renderer.setClearColor(new Color(WorldPanel.background(this.theme)));
    const plan = plans[this.quality];
    this.staleShadows = !withShadows;
    this.pictures++;
    this.panels.forEach((panel, i) => {
      panel.setShadows(this.shadows, plan.shadow);
      this.renderer.setViewport(i * width, 0, width, size.y);
      this.renderer.setScissor(i * width, 0, width, size.y);
      this.renderer.clear();
      this.renderer.shadowMap.needsUpdate = withShadows;
      this.renderer.render(panel.scene, this.camera);
    });
    if (!this.environment && plan.fine && this.pictures > 2) this.makeEnvironment();
  }

  toBlob(type: string, quality: number): Promise<Blob> {
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture could not be encoded.'))), type, quality);
    });
  }

  private setQuality(quality: Quality): void {
    this.quality = quality;
    const plan = plans[quality];
    this.renderer.shadowMap.type = plan.soft ? PCFShadowMap : BasicShadowMap;
    for (const panel of this.panels) panel.setFine(plan.fine);
    this.applyEnvironment();
    this.resize();
  }

  private resize(): void {
    const parent = this.canvas.parentElement;
    if (!parent || parent.clientWidth === 0) return;
    this.renderer.setPixelRatio(Math.min(plans[this.quality].pixels, plans[this.quality].pixels < 1 ? plans[this.quality].pixels : window.devicePixelRatio));
    this.renderer.setSize(parent.clientWidth, parent.clientHeight);
    this.camera.aspect = parent.clientWidth / this.panels.length / Math.max(1, parent.clientHeight);
    this.camera.updateProjectionMatrix();
    this.touch();
  }

  /** Chooses less while pictures take long. Never more by itself: going up and down again would flicker. @param ms of one picture */
  private judge(ms: number): void {
    const judged = this.judged;
    judged.ms += ms;
    judged.pictures++;
    if (judged.ms < 1000) return;
    judged.slowSeconds = judged.ms / judged.pictures > slowPicture ? judged.slowSeconds + 1 : 0;
    judged.ms = judged.pictures = 0;
    const next = order[order.indexOf(this.quality) + 1];
    if (judged.slowSeconds >= 2 && next && !this.fixedQuality) {
      judged.slowSeconds = 0;
      this.setQuality(next);
    }
  }

  /** A sky with a few soft lamps for what iron reflects; made after the first picture because it takes a moment. */
  private makeEnvironment(): void {
    if (this.environment) return;
    const scene = new Scene();
    const dome = new SphereGeometry(50, 24, 16);
    scene.add(new Mesh(dome, new MeshBasicMaterial({ color: '#9aa4ae', side: BackSide })));
    const lamp = (x: number, y: number, z: number, radius: number, light: number, colour: string): void => {
      const mesh = new Mesh(new SphereGeometry(radius, 16, 12), new MeshBasicMaterial({ color: new Color(colour).multiplyScalar(light) }));
      mesh.position.set(x, z, -y);
      scene.add(mesh);
    };
    lamp(-14, -18, 34, 13, 5, '#fff1dd');
    lamp(30, 8, 16, 9, 2.2, '#dfe9ff');
    lamp(0, 0, -42, 30, 0.28, '#d8cfc2');
    const generator = new PMREMGenerator(this.renderer);
    this.environment = generator.fromScene(scene, 0.03).texture;
    generator.dispose();
    this.applyEnvironment();
    this.touch();
  }

  private applyEnvironment(): void {
    const fine = plans[this.quality].fine;
    for (const panel of this.panels) {
      panel.setEnvironment(fine ? this.environment : null, this.theme === 'dark' ? 0.5 : 0.75);
    }
  }
}

/** Whether pictures are drawn by the processor: asked of a context of its own, since smoothing is chosen with the first one. */
function isSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
