/** All bodies of a world as a few meshes: one per kind of geometry, or a single one for software rendering. */
import { BoxGeometry, BufferGeometry, CapsuleGeometry, CylinderGeometry, Group, SphereGeometry } from 'three';
import { asleep, fixed, present, type BodyInfo, type ColourMode, type Frame, type Roster, type ShapeInfo } from '../model';
import { InstancedBodies, MergedBodies, type BodyMesh } from './body_mesh';
import { compoundGeometry, cornerGeometry, domeGeometry, hullGeometry, meshGeometry } from './solids';
import {
  asleepColour, awakeColour, categorical, fixedColour, noneColour, paint, paintOf, qualitative, sequential, type Rgb,
} from './palette';
import { Surfaces } from './surface';

const none = 0xffffffff;

/** The numbers that the colours of a layer stand for. */
export interface ColourRange { maximum: number }

export class Bodies {
  readonly group = new Group();
  readonly surfaces = new Surfaces();
  range: ColourRange = { maximum: 1 };
  private meshes: BodyMesh[] = [];
  private roster: Roster | null = null;
  private fine = true;
  private emphasised = new Map<number, number>();

  setRoster(roster: Roster): void {
    for (const old of this.meshes) {
      this.group.remove(old.mesh);
      old.dispose();
    }
    this.roster = roster;
    const groups = new Map<string, BodyInfo[]>();
    for (const body of roster.bodies.values()) {
      if (body.shape.type === 'plane' || body.sensor) continue;
      const key = geometryKey(body);
      const members = groups.get(key);
      if (members) members.push(body); else groups.set(key, [body]);
    }
    this.meshes = this.fine ? this.makeInstanced(groups, roster) : this.makeMerged(groups, roster);
    for (const { mesh } of this.meshes) this.group.add(mesh);
    this.paintedMode = null;
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
    for (const drawn of this.meshes) {
      drawn.bodies.forEach(({ slot }, i) => {
        if (slot >= frame.slots || !(frame.flags[slot] & present)) {
          drawn.hide(i);
          return;
        }
        drawn.place(i, frame);
        if (mode === 'material') return;
        this.colourOf(frame, slot, mode, colour);
        drawn.tint(i, colour);
      });
    }
    if (mode === 'material') this.paintMaterials();
    this.paintedMode = mode;
    for (const drawn of this.meshes) drawn.upload();
  }

  private paintedMode: ColourMode | null = null;

  private paintMaterials(): void {
    if (this.paintedMode === 'material') return;
    const colours = this.roster!.materials.map(({ name }, i) => paintOf(name, i));
    for (const drawn of this.meshes) drawn.bodies.forEach((body, i) => drawn.tint(i, colours[body.material] ?? paint[0]));
  }

  private makeInstanced(groups: Map<string, BodyInfo[]>, { materials }: Roster): BodyMesh[] {
    return [...groups.values()].map((bodies) =>
      new InstancedBodies(bodies, materials, makeGeometry(bodies[0], fineness(bodies.length)), this.surfaces));
  }

  private makeMerged(groups: Map<string, BodyInfo[]>, { materials }: Roster): BodyMesh[] {
    const geometries = new Map([...groups].map(([key, bodies]) => [key, bodies[0].shape.type === 'box' ? cornerGeometry()
      : makeGeometry(bodies[0], coarseness(bodies.length))]));
    const all = [...groups.values()].flat();
    return [new MergedBodies(all, materials, (body) => geometries.get(geometryKey(body))!, this.surfaces)];
  }

  private applyEmphasis(): void {
    for (const drawn of this.meshes) {
      drawn.bodies.forEach(({ slot }, i) => drawn.emphasise(i, this.emphasised.get(slot) ?? 0));
      drawn.upload();
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
function geometryKey({ shape, slot, generation }: BodyInfo): string {
  // A surface may have a million triangles: its text is not made to be compared.
  if (shape.type === 'mesh') return `mesh ${slot} ${generation}`;
  return shape.type === 'capsule' || shape.type === 'hull' || shape.type === 'compound' ? JSON.stringify(shape) : shape.type;
}

/** Segments around a round body and from pole to pole. */
type Fineness = [number, number];

/** Fewer triangles where there are many bodies. */
function fineness(count: number): Fineness {
  return count > 600 ? [24, 8] : count > 100 ? [32, 16] : [48, 28];
}

/** Software rendering takes its time for triangles. */
function coarseness(count: number): Fineness {
  return count > 1000 ? [8, 2] : count > 100 ? [12, 4] : [24, 8];
}

/** A shape as it is, in its own frame [m]. */
export function solidGeometry(shape: ShapeInfo, [around, along]: Fineness): BufferGeometry {
  switch (shape.type) {
    case 'box': return new BoxGeometry(...shape.size);
    case 'sphere': return new SphereGeometry(shape.radius, around, along).rotateX(Math.PI / 2);
    case 'capsule':
      return new CapsuleGeometry(shape.radius, shape.length, Math.ceil(along / 2), around).rotateX(Math.PI / 2);
    case 'cylinder':
      return new CylinderGeometry(shape.radius, shape.radius, shape.length, 2 * around).rotateX(Math.PI / 2);
    case 'hull': return hullGeometry(shape.points);
    case 'mesh': return meshGeometry(shape.vertices, shape.indices);
    case 'compound': return compoundGeometry(shape.parts, (part) => solidGeometry(part, [around, along]));
    case 'plane': return new BufferGeometry();
  }
}

function makeGeometry({ shape }: BodyInfo, fine: Fineness): BufferGeometry {
  switch (shape.type) {
    case 'box': return solidGeometry({ type: 'box', size: [2, 2, 2] }, fine);
    case 'sphere': return domeGeometry(fine[0], fine[1] / 2);
    case 'cylinder': return solidGeometry({ type: 'cylinder', radius: 1, length: 2 }, fine);
    default: return solidGeometry(shape, fine);
  }
}
