/** Half-spaces: floors and walls, each a polygon cut by the others, with a grid whose lines have a scale. */
import { BufferGeometry, DoubleSide, Float32BufferAttribute, FrontSide, Group, Mesh, MeshLambertMaterial, Quaternion, Vector3, type WebGLProgramParametersWithUniforms } from 'three';
import { present, type Frame, type Roster } from '../model';

/** A half-space as it stands now: normal·p ≤ offset is solid. */
export interface Plane { normal: Vector3; offset: number; slot: number }

export function planesOf(roster: Roster, frame: Frame): Plane[] {
  const planes: Plane[] = [];
  for (const { shape, slot } of roster.bodies.values()) {
    if (shape.type !== 'plane' || slot >= frame.slots || !(frame.flags[slot] & present)) continue;
    const normal = new Vector3(...shape.normal).normalize().applyQuaternion(new Quaternion().fromArray(frame.orientation, 4 * slot));
    planes.push({ normal, offset: shape.offset + normal.dot(new Vector3().fromArray(frame.position, 3 * slot)), slot });
  }
  return planes;
}

const vertexHead = 'varying vec3 vWorld;\n';
const vertexBody = '#include <begin_vertex>\nvWorld = position;\n';
const fragmentHead = /* glsl */ `
uniform vec3 uAxisU;
uniform vec3 uAxisV;
uniform vec3 uCentre;
uniform vec3 uBack;
uniform float uGrid;
uniform float uFade;
uniform float uLine;
uniform float uStep;
varying vec3 vWorld;
float lines(vec2 p, float spacing, float width) {
  vec2 q = p / spacing;
  vec2 w = max(fwidth(q) * width, vec2(1e-5));
  vec2 d = abs(fract(q - 0.5) - 0.5);
  vec2 l = 1.0 - smoothstep(w * 0.5, w * 1.2, d);
  vec2 fine = clamp(1.0 - 2.5 * fwidth(q), 0.0, 1.0);
  return max(l.x * fine.x, l.y * fine.y);
}
`;
const fragmentColour = /* glsl */ `
#include <color_fragment>
vec2 cell = vec2(dot(vWorld, uAxisU), dot(vWorld, uAxisV));
float fade = 1.0 - smoothstep(0.35 * uFade, uFade, distance(vWorld, uCentre));
float grid = max(0.30 * lines(cell, 0.1 * uStep, 1.0), max(0.75 * lines(cell, uStep, 1.3), lines(cell, 10.0 * uStep, 1.8)));
diffuseColor.rgb = mix(diffuseColor.rgb, diffuseColor.rgb * uLine, uGrid * grid * 0.55 * fade);
`;
const fragmentEnd = /* glsl */ `
gl_FragColor.rgb = mix(uBack, gl_FragColor.rgb, fade);
#include <dithering_fragment>
`;

export class Ground {
  readonly group = new Group();
  private readonly uniforms = {
    uCentre: { value: new Vector3() },
    uBack: { value: new Vector3(1, 1, 1) },
    uGrid: { value: 1 },
    uFade: { value: 30 },
    uLine: { value: 0.6 },
    uStep: { value: 1 },
  };
  private colour = '#d9dce0';
  private key = '';

  setTheme(ground: string, back: Vector3, line: number): void {
    this.colour = ground;
    this.uniforms.uBack.value.copy(back);
    this.uniforms.uLine.value = line;
    for (const child of this.group.children) ((child as Mesh).material as MeshLambertMaterial).color.set(ground);
  }

  /** The kind of shadows changed. */
  refresh(): void {
    for (const child of this.group.children) ((child as Mesh).material as MeshLambertMaterial).needsUpdate = true;
  }

  setGrid(visible: boolean): void {
    this.uniforms.uGrid.value = visible ? 1 : 0;
  }

  /** @param step [m] distance of the strong lines */
  setExtent(centre: Vector3, radius: number, step: number): void {
    this.uniforms.uCentre.value.copy(centre);
    this.uniforms.uFade.value = Math.max(8 * radius, 4);
    this.uniforms.uStep.value = step;
  }

  /** Builds the polygons anew if a half-space came, went or moved. */
  update(roster: Roster, frame: Frame, centre: Vector3, radius: number): void {
    const planes = planesOf(roster, frame);
    let key = planes.map(({ slot, normal, offset }) => `${slot}:${normal.toArray().map((x) => x.toFixed(5)).join(',')}:${offset.toFixed(5)};`).join('');
    key += `${roster.epoch > 0 ? radius.toPrecision(2) : ''}`;
    if (key === this.key) return;
    this.key = key;
    for (const child of [...this.group.children]) {
      this.group.remove(child);
      (child as Mesh).geometry.dispose();
      ((child as Mesh).material as MeshLambertMaterial).dispose();
    }
    for (const plane of planes) this.group.add(this.makeMesh(plane, planes, centre, Math.max(12 * radius, 8)));
  }

  private makeMesh(plane: Plane, planes: Plane[], centre: Vector3, reach: number): Mesh {
    const { u, v } = axes(plane.normal);
    const middle = centre.clone().addScaledVector(plane.normal, plane.offset - plane.normal.dot(centre));
    let polygon = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) =>
      middle.clone().addScaledVector(u, x * reach).addScaledVector(v, y * reach));
    let cut = false;
    for (const other of planes) {
      if (other === plane) continue;
      const before = polygon.length;
      polygon = clip(polygon, other);
      cut ||= polygon.length !== before;
    }
    const geometry = new BufferGeometry();
    const points: number[] = [], normals: number[] = [];
    for (let i = 1; i + 1 < polygon.length; i++) {
      for (const p of [polygon[0], polygon[i], polygon[i + 1]]) {
        points.push(p.x, p.y, p.z);
        normals.push(plane.normal.x, plane.normal.y, plane.normal.z);
      }
    }
    geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
    geometry.setAttribute('normal', new Float32BufferAttribute(normals, 3));
    const floor = plane.normal.z > 0.7;
    const material = new MeshLambertMaterial({ color: this.colour, side: floor && !cut ? DoubleSide : FrontSide });
    const own = { uAxisU: { value: u }, uAxisV: { value: v } };
    material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms) => {
      Object.assign(shader.uniforms, this.uniforms, own);
      shader.vertexShader = vertexHead + shader.vertexShader.replace('#include <begin_vertex>', vertexBody);
      shader.fragmentShader = fragmentHead + shader.fragmentShader
        .replace('#include <color_fragment>', fragmentColour)
        .replace('#include <dithering_fragment>', fragmentEnd);
    };
    const mesh = new Mesh(geometry, material);
    mesh.receiveShadow = true;
    mesh.userData.slot = plane.slot;
    return mesh;
  }
}

function axes(normal: Vector3): { u: Vector3; v: Vector3 } {
  const help = Math.abs(normal.z) > 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
  const u = help.clone().cross(normal).normalize();
  return { u, v: normal.clone().cross(u) };
}

/** The part of a polygon that lies outside of another half-space. */
function clip(polygon: Vector3[], plane: Plane): Vector3[] {
  const out: Vector3[] = [];
  const height = polygon.map((p) => plane.normal.dot(p) - plane.offset);
  polygon.forEach((p, i) => {
    const j = (i + 1) % polygon.length;
    if (height[i] >= 0) out.push(p);
    if (height[i] >= 0 !== height[j] >= 0) out.push(p.clone().lerp(polygon[j], height[i] / (height[i] - height[j])));
  });
  return out;
}
