/** All bodies of a world as a few instanced meshes, one per kind of geometry. */
import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, CylinderGeometry, Group, InstancedBufferAttribute, InstancedMesh, Matrix4, Quaternion,
  SphereGeometry, Vector3, type Material,
} from 'three';
import { asleep, fixed, present, type BodyInfo, type ColourMode, type Frame, type Roster, type ShapeInfo } from '../model';
import { compoundGeometry, domeGeometry, hullGeometry } from './solids';
import {
  asleepColour, awakeColour, categorical, fixedColour, noneColour, qualitative, sequential, toLinear, type Rgb,
} from './palette';
import { patternOf, Surfaces } from './surface';

const none = 0xffffffff;
const paintHex = ['#4f86b8', '#d9a441', '#4f9d86', '#c07aa8', '#b5553a', '#8a8f98'];
const paint = paintHex.map(toLinear);

interface Batch {
  mesh: InstancedMesh;
  slots: number[];
  scale: Float32Array;
  tint: InstancedBufferAttribute;
  kind: InstancedBufferAttribute;
}

/** The numbers that the colours of a layer stand for. */
export interface ColourRange { maximum: number }

export class Bodies {
  readonly group = new Group();
  readonly surfaces = new Surfaces();
  range: ColourRange = { maximum: 1 };
  private batches: Batch[] = [];
  private roster: Roster | null = null;
  private fine = true;
  private emphasised = new Map<number, number>();

  setRoster(roster: Roster): void {
    for (const batch of this.batches) {
      this.group.remove(batch.mesh);
      batch.mesh.geometry.dispose();
      batch.mesh.dispose();
    }
    this.roster = roster;
    const groups = new Map<string, BodyInfo[]>();
    for (const body of roster.bodies.values()) {
      if (body.shape.type === 'plane') continue;
      const key = geometryKey(body);
      const members = groups.get(key);
      if (members) members.push(body); else groups.set(key, [body]);
    }
    this.batches = [...groups.values()].map((members) => this.makeBatch(members, roster));
    this.applyEmphasis();
  }

  /** Good materials and fine triangles, or ones for software rendering. */
  setFine(fine: boolean): void {
    if (fine === this.fine) return;
    this.fine = fine;
    if (this.roster) this.setRoster(this.roster);
  }

  /** Highlights some bodies. @param slots slot → strength 0 to 1 */
  emphasise(slots: Map<number, number>): void {
    this.emphasised = slots;
    this.applyEmphasis();
  }

  update(frame: Frame, mode: ColourMode): void {
    this.surfaces.uniforms.uFlat.value = mode === 'material' ? 0 : 1;
    if (mode === 'speed' || mode === 'overlap') this.followRange(frame[mode], frame, mode);
    const colour: Rgb = [0, 0, 0];
    for (const batch of this.batches) {
      const matrices = batch.mesh.instanceMatrix.array;
      const tints = batch.tint.array;
      for (let i = 0; i < batch.slots.length; i++) {
        const slot = batch.slots[i];
        if (slot >= frame.slots || !(frame.flags[slot] & present)) {
          matrices.fill(0, 16 * i, 16 * i + 16);
          continue;
        }
        compose(frame, slot, batch.scale, i, matrices as Float32Array);
        if (mode === 'material') continue;
        this.colourOf(frame, slot, mode, colour);
        tints[3 * i] = colour[0];
        tints[3 * i + 1] = colour[1];
        tints[3 * i + 2] = colour[2];
      }
      batch.mesh.instanceMatrix.needsUpdate = true;
      if (mode !== 'material') batch.tint.needsUpdate = true;
    }
    if (mode === 'material') this.paintMaterials();
  }

  private paintedMode: ColourMode | null = null;

  private paintMaterials(): void {
    if (this.paintedMode === 'material' || !this.roster) return;
    for (const batch of this.batches) {
      batch.slots.forEach((slot, i) => {
        const body = this.roster!.bodies.get(slot);
        batch.tint.set(paint[(body?.material ?? 0) % paint.length], 3 * i);
      });
      batch.tint.needsUpdate = true;
    }
  }

  private material(): Material {
    return this.fine ? this.surfaces.fine : this.surfaces.plain;
  }

  private makeBatch(members: BodyInfo[], roster: Roster): Batch {
    const count = members.length;
    const geometry = makeGeometry(members[0], this.fine ? fineness(count) : coarseness(count));
    const scale = new Float32Array(3 * count);
    const kinds = new Float32Array(3 * count);
    const halves = new Float32Array(3 * count);
    members.forEach((body, i) => {
      const half = halfExtents(body);
      scale.set(half, 3 * i);
      halves.set(half, 3 * i);
      if (body.shape.type !== 'box') halves[3 * i] *= -1;
      if (body.shape.type === 'sphere') halves[3 * i + 1] *= -1;
      const name = roster.materials[body.material]?.name ?? '';
      kinds.set([patternOf(name), ((body.slot * 0.6180339887) % 1), 0], 3 * i);
    });
    const tint = new InstancedBufferAttribute(new Float32Array(3 * count), 3);
    const kind = new InstancedBufferAttribute(kinds, 3);
    geometry.setAttribute('aTint', tint);
    geometry.setAttribute('aKind', kind);
    geometry.setAttribute('aHalf', new InstancedBufferAttribute(halves, 3));
    const mesh = new InstancedMesh(geometry, this.material(), count);
    mesh.frustumCulled = false;
    if (members[0].shape.type === 'sphere') mesh.customDepthMaterial = this.surfaces.ballDepth;
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    this.group.add(mesh);
    this.paintedMode = null;
    return { mesh, slots: members.map((body) => body.slot), scale, tint, kind };
  }

  private applyEmphasis(): void {
    for (const batch of this.batches) {
      batch.slots.forEach((slot, i) => batch.kind.setZ(i, this.emphasised.get(slot) ?? 0));
      batch.kind.needsUpdate = true;
    }
  }

  /** Follows the largest value in steps of 1, 2 and 5, so that the legend does not flicker. */
  private followRange(values: Float32Array | undefined, frame: Frame, mode: ColourMode): void {
    if (!values) return;
    let largest = 0;
    for (let i = 0; i < frame.slots; i++) if (values[i] > largest) largest = values[i];
    const smallest = mode === 'speed' ? 0.1 : 1e-4;
    const wanted = niceAbove(Math.max(largest, smallest));
    if (wanted > this.range.maximum || wanted < this.range.maximum / 4) this.range = { maximum: wanted };
  }

  private colourOf(frame: Frame, slot: number, mode: ColourMode, out: Rgb): void {
    const flags = frame.flags[slot];
    let colour: Rgb = noneColour;
    if (mode === 'speed') colour = sequential(Math.sqrt((frame.speed?.[slot] ?? 0) / this.range.maximum), out);
    else if (mode === 'overlap') colour = sequential((frame.overlap?.[slot] ?? 0) / this.range.maximum, out);
    else if (mode === 'level') colour = ordinal(frame.level?.[slot] ?? -1);
    else if (flags & fixed) colour = fixedColour;
    else if (mode === 'asleep') colour = flags & asleep ? asleepColour : awakeColour;
    else if (mode === 'batch') {
      const batch = frame.batch?.[slot] ?? none;
      if (batch !== none) colour = categorical(batch);
    } else if (mode === 'stage') colour = ordinal(frame.stage?.[slot] ?? -1);
    out[0] = colour[0];
    out[1] = colour[1];
    out[2] = colour[2];
  }
}

function ordinal(index: number): Rgb {
  return index < 0 ? noneColour : qualitative[index % qualitative.length];
}

export function niceAbove(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const factor of [1, 2, 5]) if (value <= factor * power * 1.0001) return factor * power;
  return 10 * power;
}

/** Bodies of one key are instances of one geometry. Boxes, balls and cylinders are scaled, the others drawn as they are. */
function geometryKey({ shape }: BodyInfo): string {
  return shape.type === 'capsule' || shape.type === 'hull' || shape.type === 'compound' ? JSON.stringify(shape) : shape.type;
}

function halfExtents({ shape }: BodyInfo): [number, number, number] {
  if (shape.type === 'cylinder') return [shape.radius, shape.radius, shape.length / 2];
  if (shape.type === 'box') return shape.size.map((edge) => edge / 2) as [number, number, number];
  if (shape.type === 'sphere') return [shape.radius, shape.radius, shape.radius];
  return [1, 1, 1];
}

/** Segments around a round body and from pole to pole. */
type Fineness = [number, number];

/** Fewer triangles where there are many bodies. */
function fineness(count: number): Fineness {
  return count > 600 ? [24, 8] : count > 100 ? [32, 16] : [48, 28];
}

/** Software rendering takes its time for triangles. */
function coarseness(count: number): Fineness {
  return count > 1000 ? [8, 4] : count > 100 ? [12, 4] : [24, 8];
}

function makeGeometry({ shape }: BodyInfo, [around, along]: Fineness): BufferGeometry {
  const actual = (part: ShapeInfo): BufferGeometry => {
    switch (part.type) {
      case 'box': return new BoxGeometry(...part.size);
      case 'sphere': return new SphereGeometry(part.radius, around, along).rotateX(Math.PI / 2);
      case 'capsule':
        return new CapsuleGeometry(part.radius, part.length, Math.ceil(along / 2), around).rotateX(Math.PI / 2);
      case 'cylinder':
        return new CylinderGeometry(part.radius, part.radius, part.length, 2 * around).rotateX(Math.PI / 2);
      case 'hull': return hullGeometry(part.points);
      case 'compound': return compoundGeometry(part.parts, actual);
      case 'plane': return new BufferGeometry();
    }
  };
  switch (shape.type) {
    case 'box': return actual({ type: 'box', size: [2, 2, 2] });
    case 'sphere': return domeGeometry(around, along / 2);
    case 'cylinder': return actual({ type: 'cylinder', radius: 1, length: 2 });
    default: return actual(shape);
  }
}

const position = new Vector3();
const orientation = new Quaternion();
const extent = new Vector3();
const matrix = new Matrix4();

function compose(frame: Frame, slot: number, scale: Float32Array, i: number, out: Float32Array): void {
  position.fromArray(frame.position, 3 * slot);
  orientation.fromArray(frame.orientation, 4 * slot);
  extent.fromArray(scale, 3 * i);
  matrix.compose(position, orientation, extent).toArray(out, 16 * i);
}
