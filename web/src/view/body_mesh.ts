/** Bodies that are drawn by one call: instances of one geometry, or all of them merged into one large geometry. */
import {
  BufferAttribute, BufferGeometry, DataTexture, FloatType, InstancedBufferAttribute, InstancedMesh, Matrix4, Mesh, Quaternion, RGBAFormat,
  Vector3, type Material,
} from 'three';
import type { BodyInfo, Frame, MaterialInfo } from '../model';
import type { Rgb } from './palette';
import { patternOf, texelColumns, texelsPerBody, type Surfaces } from './surface';

export interface BodyMesh {
  readonly mesh: Mesh;
  readonly bodies: BodyInfo[];
  /** Of the body at a place in `bodies`, as all others here. */
  place(i: number, frame: Frame): void;
  hide(i: number): void;
  tint(i: number, colour: Rgb): void;
  /** @param strength 0 to 1 */
  emphasise(i: number, strength: number): void;
  /** Hands what changed to the graphics. */
  upload(): void;
  dispose(): void;
}

/** Half extents of the unit shape's scale [m]; a negative x marks a round body, a negative y as well a ball. */
function signedHalves(body: BodyInfo): [number, number, number] {
  const half = halfExtents(body);
  if (body.shape.type !== 'box') half[0] *= -1;
  if (body.shape.type === 'sphere') half[1] *= -1;
  return half;
}

function halfExtents({ shape }: BodyInfo): [number, number, number] {
  if (shape.type === 'cylinder') return [shape.radius, shape.radius, shape.length / 2];
  if (shape.type === 'box') return shape.size.map((edge) => edge / 2) as [number, number, number];
  if (shape.type === 'sphere') return [shape.radius, shape.radius, shape.radius];
  return [1, 1, 1];
}

/** Differs from body to body and stays, for grain that does not repeat; below 1. */
const seedOf = (body: BodyInfo): number => (body.slot * 0.6180339887) % 1;

function prepare(mesh: Mesh): void {
  mesh.frustumCulled = false;
  mesh.castShadow = true;
  mesh.receiveShadow = true;
}

/** What graphics cards like: one geometry, a matrix per body. */
export class InstancedBodies implements BodyMesh {
  readonly mesh: InstancedMesh;
  private readonly scale: Float32Array;
  private readonly tints: InstancedBufferAttribute;
  private readonly kinds: InstancedBufferAttribute;

  constructor(readonly bodies: BodyInfo[], materials: MaterialInfo[], geometry: BufferGeometry, surfaces: Surfaces) {
    const count = bodies.length;
    this.scale = new Float32Array(bodies.flatMap(halfExtents));
    this.tints = new InstancedBufferAttribute(new Float32Array(3 * count), 3);
    this.kinds = new InstancedBufferAttribute(new Float32Array(bodies.flatMap((body) =>
      [patternOf(materials[body.material]?.name ?? ''), seedOf(body), 0])), 3);
    geometry.setAttribute('aTint', this.tints);
    geometry.setAttribute('aKind', this.kinds);
    geometry.setAttribute('aHalf', new InstancedBufferAttribute(new Float32Array(bodies.flatMap(signedHalves)), 3));
    this.mesh = new InstancedMesh(geometry, surfaces.fine, count);
    if (bodies[0].shape.type === 'sphere') this.mesh.customDepthMaterial = surfaces.ballDepth;
    prepare(this.mesh);
  }

  place(i: number, frame: Frame): void {
    const { slot } = this.bodies[i];
    position.fromArray(frame.position, 3 * slot);
    orientation.fromArray(frame.orientation, 4 * slot);
    extent.fromArray(this.scale, 3 * i);
    matrix.compose(position, orientation, extent).toArray(this.mesh.instanceMatrix.array, 16 * i);
  }

  hide(i: number): void { this.mesh.instanceMatrix.array.fill(0, 16 * i, 16 * i + 16); }

  tint(i: number, colour: Rgb): void {
    this.tints.set(colour, 3 * i);
    this.tints.needsUpdate = true;
  }

  emphasise(i: number, strength: number): void {
    this.kinds.setZ(i, strength);
    this.kinds.needsUpdate = true;
  }

  upload(): void { this.mesh.instanceMatrix.needsUpdate = true; }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.dispose();
  }
}

const position = new Vector3();
const orientation = new Quaternion();
const extent = new Vector3();
const matrix = new Matrix4();

/**
 * What software rendering likes: it begins anew with every instance, which takes it longer than the few triangles of one.
 * The vertex shader reads the state of a vertex's body from a texture, `texelsPerBody` texels for each.
 */
export class MergedBodies implements BodyMesh {
  readonly mesh: Mesh;
  private readonly state: Float32Array;
  private readonly texture: DataTexture;
  private readonly material: Material;
  private readonly depth: Material;

  /** @param geometryOf of the unit shape of a body; may be shared */
  constructor(readonly bodies: BodyInfo[], materials: MaterialInfo[], geometryOf: (body: BodyInfo) => BufferGeometry, surfaces: Surfaces) {
    const rows = texelsPerBody * Math.max(1, Math.ceil(bodies.length / texelColumns));
    this.state = new Float32Array(4 * rows * texelColumns);
    this.texture = new DataTexture(this.state, texelColumns, rows, RGBAFormat, FloatType);
    bodies.forEach((body, i) => {
      const pattern = patternOf(materials[body.material]?.name ?? '');
      this.state.set([...signedHalves(body), pattern + seedOf(body)], this.texel(i, 3));
    });
    this.material = surfaces.makeMerged(this.texture);
    this.depth = surfaces.makeMergedDepth(this.texture);
    this.mesh = new Mesh(mergedGeometry(bodies.map(geometryOf)), this.material);
    this.mesh.customDepthMaterial = this.depth;
    prepare(this.mesh);
  }

  place(i: number, frame: Frame): void {
    const { state } = this;
    const { slot } = this.bodies[i];
    const at = this.texel(i, 0), turn = this.texel(i, 1);
    for (let k = 0; k < 3; k++) state[at + k] = frame.position[3 * slot + k];
    for (let k = 0; k < 4; k++) state[turn + k] = frame.orientation[4 * slot + k];
    state[this.texel(i, 2) + 3] = 1;
  }

  hide(i: number): void { this.state[this.texel(i, 2) + 3] = 0; }
  tint(i: number, colour: Rgb): void { this.state.set(colour, this.texel(i, 2)); }
  emphasise(i: number, strength: number): void { this.state[this.texel(i, 0) + 3] = strength; }
  upload(): void { this.texture.needsUpdate = true; }

  dispose(): void {
    this.mesh.geometry.dispose();
    for (const thing of [this.texture, this.material, this.depth]) thing.dispose();
  }

  /** Where a texel of a body begins; bodies stand side by side, their texels below each other. */
  private texel(i: number, k: number): number {
    return 4 * ((Math.floor(i / texelColumns) * texelsPerBody + k) * texelColumns + (i % texelColumns));
  }
}

/** All geometries as one; `aBody` tells which one a vertex is of. */
function mergedGeometry(parts: BufferGeometry[]): BufferGeometry {
  const vertices = parts.reduce((sum, part) => sum + part.getAttribute('position').count, 0);
  const corners = parts.reduce((sum, part) => sum + (part.index ?? part.getAttribute('position')).count, 0);
  const points = new Float32Array(3 * vertices);
  const normals = new Float32Array(3 * vertices);
  const owners = new Float32Array(vertices);
  const index = new Uint32Array(corners);
  let vertex = 0, corner = 0;
  parts.forEach((part, body) => {
    const { count } = part.getAttribute('position');
    points.set(part.getAttribute('position').array, 3 * vertex);
    normals.set(part.getAttribute('normal').array, 3 * vertex);
    owners.fill(body, vertex, vertex + count);
    const own = part.index?.array;
    for (let i = 0; i < (own?.length ?? count); i++) index[corner++] = vertex + (own ? own[i] : i);
    vertex += count;
  });
  const merged = new BufferGeometry();
  merged.setAttribute('position', new BufferAttribute(points, 3));
  merged.setAttribute('normal', new BufferAttribute(normals, 3));
  merged.setAttribute('aBody', new BufferAttribute(owners, 1));
  merged.setIndex(new BufferAttribute(index, 1));
  return merged;
}
