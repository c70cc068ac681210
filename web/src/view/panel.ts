/** One world in three dimensions: bodies, ground, overlays and the light that follows their extent. */
import { Box3, DirectionalLight, HemisphereLight, Scene, Vector3, type Texture } from 'three';
import { defaultOptions, fixed, present, type Frame, type Roster, type ViewOptions } from '../model';
import { Bodies } from './bodies';
import { Ground } from './ground';
import { Overlays } from './overlays';
import { Sensors } from './sensors';
import { sizeOf } from './solids';
import { shownBox } from './vantage';

export type Theme = 'light' | 'dark';

const looks = {
  light: { back: '#eceff2', ground: '#e3e6e9', line: 0.74, sky: '#ffffff', earth: '#b9b2a8', hemisphere: 1.25, sun: 2.5, shade: 1 },
  dark: { back: '#14171b', ground: '#565d66', line: 1.6, sky: '#c3d2e6', earth: '#2b2723', hemisphere: 1.0, sun: 2.4, shade: 0.82 },
};

/** Of the bodies that can move; `box` is what a picture of them shows. */
export interface Extent { centre: Vector3; radius: number; size: number; box: Box3 }

export class WorldPanel {
  readonly scene = new Scene();
  readonly bodies = new Bodies();
  readonly overlays = new Overlays();
  readonly sensors = new Sensors();
  readonly ground = new Ground();
  roster: Roster | null = null;
  frame: Frame | null = null;
  extent: Extent = { centre: new Vector3(), radius: 1, size: 0.1, box: boxAbout(new Vector3(), 0.6) };
  private selected: number | null = null;
  private options: ViewOptions = defaultOptions;
  private readonly sun = new DirectionalLight('#fff4e4', 2.5);
  private readonly sky = new HemisphereLight('#ffffff', '#b9b2a8', 1);

  constructor() {
    this.sun.castShadow = true;
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = 0.006;
    this.sun.shadow.radius = 2;
    this.scene.add(this.sun, this.sun.target, this.sky, this.ground.group, this.bodies.group, this.sensors.group, this.overlays.group);
    this.setTheme('light');
  }

  setTheme(theme: Theme): void {
    const look = looks[theme];
    this.sky.color.set(look.sky);
    this.sky.groundColor.set(look.earth);
    this.sky.intensity = look.hemisphere;
    this.sun.intensity = look.sun;
    this.sun.shadow.intensity = look.shade;
    const c = look.back.match(/[0-9a-f]{2}/g)!.map((x) => parseInt(x, 16) / 255);
    this.ground.setTheme(look.ground, new Vector3(c[0], c[1], c[2]), look.line);
  }

  static background(theme: Theme): string { return looks[theme].back; }

  setEnvironment(texture: Texture | null, intensity: number): void {
    this.scene.environment = texture;
    this.scene.environmentIntensity = intensity;
  }

  setShadows(visible: boolean, mapSize: number): void {
    this.sun.castShadow = visible;
    if (this.sun.shadow.mapSize.x === mapSize) return;
    this.sun.shadow.mapSize.set(mapSize, mapSize);
    this.sun.shadow.map?.dispose();
    this.sun.shadow.map = null;
  }

  setRoster(roster: Roster): void {
    this.roster = roster;
    this.frame = null;
    this.bodies.setRoster(roster);
    this.sensors.setRoster(roster);
  }

  /** Good materials, or ones for software rendering. */
  setFine(fine: boolean): void {
    this.bodies.setFine(fine);
    this.ground.refresh();
    if (this.frame) this.setFrame(this.frame, this.options);
  }

  /** [m] between the strong lines of the grid; the fine ones are a tenth of it apart. */
  get gridStep(): number { return 10 ** Math.floor(Math.log10(1.6 * this.extent.radius)); }

  /** Highlights a body. */
  select(slot: number | null): void {
    this.selected = slot;
    this.bodies.emphasise(new Map(slot === null ? [] : [[slot, 1]]));
    if (this.frame) this.overlays.outline(this.frame, slot === null ? undefined : this.roster?.bodies.get(slot));
  }

  /** @return true if it was drawn: frames of another epoch are not */
  setFrame(frame: Frame, options: ViewOptions): boolean {
    if (!this.roster || frame.epoch !== this.roster.epoch) return false;
    const first = this.frame === null;
    this.frame = frame;
    this.options = options;
    if (first) this.extent = extentOf(this.roster, frame);
    this.bodies.update(frame, options.colour);
    this.sensors.update(frame);
    this.overlays.update(this.roster, frame, options, this.extent.size);
    this.overlays.outline(frame, this.selected === null ? undefined : this.roster.bodies.get(this.selected));
    const { centre, radius } = this.extent;
    this.ground.setExtent(centre, radius, this.gridStep);
    this.ground.setGrid(options.grid);
    this.ground.update(this.roster, frame, centre, radius);
    this.aimSun(frame);
    return true;
  }

  /** The shadow map covers what moves within three times the first extent, in coarse steps against flicker. */
  private aimSun(frame: Frame): void {
    const { centre, radius } = this.extent;
    let reach = 0.3 * radius;
    const p = frame.position;
    for (let slot = 0; slot < frame.slots; slot++) {
      if ((frame.flags[slot] & (present | fixed)) !== present) continue;
      const distance = Math.hypot(p[3 * slot] - centre.x, p[3 * slot + 1] - centre.y, p[3 * slot + 2] - centre.z);
      if (distance < 3 * radius) reach = Math.max(reach, distance + this.extent.size);
    }
    reach = 1.25 ** Math.ceil(Math.log(Math.max(reach, 0.05)) / Math.log(1.25));
    this.sun.target.position.copy(centre);
    this.sun.position.set(-0.8, -0.25, 0.85).normalize().multiplyScalar(3 * reach).add(centre);
    const camera = this.sun.shadow.camera;
    if (camera.right === reach) return;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    camera.near = 0.5 * reach;
    camera.far = 6 * reach;
    this.sun.shadow.normalBias = 0.0025 * reach;
    camera.updateProjectionMatrix();
  }
}

/** Part of the bodies that the first picture shows: a bullet far away must not make the walls small. */
const shownPart = 0.96;

/** Where the bodies are that can move (or, without any, the fixed ones), and how large one of them is. */
export function extentOf(roster: Roster, frame: Frame): Extent {
  for (const wanted of [present, present | fixed]) {
    const points: { slot: number; p: Vector3; size: number; far: number }[] = [];
    for (const { shape, slot } of roster.bodies.values()) {
      if (shape.type === 'plane' || slot >= frame.slots || (frame.flags[slot] & (present | fixed)) !== wanted) continue;
      const size = sizeOf(shape);
      points.push({ slot, p: new Vector3().fromArray(frame.position, 3 * slot), size, far: 0 });
    }
    if (points.length === 0) continue;
    const middle = new Vector3(...[0, 1, 2].map((k) => median(points.map((point) => point.p.getComponent(k)))));
    for (const point of points) point.far = point.p.distanceTo(middle);
    points.sort((a, b) => a.far - b.far);
    const shown = points.length < 25 ? points : mostOf(points);
    const lower = new Vector3(Infinity, Infinity, Infinity), upper = new Vector3(-Infinity, -Infinity, -Infinity);
    let sizes = 0;
    for (const { p, size } of shown) {
      lower.min(p.clone().subScalar(size / 2));
      upper.max(p.clone().addScalar(size / 2));
      sizes += size;
    }
    include(frame.joints?.points, lower, upper, lower.distanceTo(upper));
    const centre = lower.clone().add(upper).multiplyScalar(0.5);
    const radius = Math.max(0.5 * lower.distanceTo(upper), 0.1);
    return { centre, radius, size: sizes / shown.length, box: shownBox(roster, frame, shown.map((point) => point.slot)) };
  }
  const centre = new Vector3(0, 0, 0.5);
  return { centre, radius: 2, size: 0.2, box: boxAbout(centre, 1.2) };
}

/** Those in the middle, and of the others such as are large beside them, like a machine at a heap. @param points by distance */
function mostOf<T extends { size: number; far: number }>(points: T[]): T[] {
  const count = Math.ceil(shownPart * points.length);
  const large = 3 * median(points.map((point) => point.size));
  const reach = 8 * points[count - 1].far;
  return points.filter((point, i) => i < count || (point.size > large && point.far < reach));
}

function boxAbout(centre: Vector3, half: number): Box3 {
  return new Box3(centre.clone().subScalar(half), centre.clone().addScalar(half));
}

/** Widens a box by the points of the joints, apart from such that are far away. */
function include(joints: Float32Array | undefined, lower: Vector3, upper: Vector3, reach: number): void {
  const middle = lower.clone().add(upper).multiplyScalar(0.5);
  for (let i = 0; joints && i < joints.length; i += 9) {
    for (const at of [i, i + 3]) {
      const point = new Vector3().fromArray(joints, at);
      if (point.distanceTo(middle) > 3 * reach) continue;
      lower.min(point);
      upper.max(point);
    }
  }
}

function median(values: number[]): number {
  values.sort((a, b) => a - b);
  return values[values.length >> 1];
}
