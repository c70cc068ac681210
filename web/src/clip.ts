/** Clips: recordings as `cairn view` serves and `cairn export --html` embeds them. Format: docs/view-protocol.md. */
import { breaksOf, jointsAt, springsAt, type JointInfo, type LineInfo } from './links';
import { present, type BodyInfo, type Contacts, type Frame, type MaterialInfo, type Roster, type Sample } from './model';
import type { Value } from './protocol';

interface Header {
  title: string;
  version: string;
  machine: string;
  settings: Record<string, Value>;
  materials: MaterialInfo[];
  bodies: BodyInfo[];
  joints: JointInfo[];
  springs: LineInfo[];
  frames: number;
  /** whether contacts were recorded */
  contacts: boolean;
  stages: string[];
  sampleFields: string[];
  positionUnit: number;
  orientationUnit: number;
  velocityUnit: number;
  spinUnit: number;
}

const magic = 'CAIRNCLP';
const clipVersion = 3;

/** A recording in memory: every frame can be had at once. */
export class Clip {
  readonly roster: Roster;
  readonly samples: Sample[] = [];
  private readonly count: number;
  private readonly breaks: number[];

  constructor(
    readonly header: Header,
    readonly times: Float64Array,
    private readonly flags: Uint8Array,
    private readonly positions: Float32Array,
    private readonly orientations: Float32Array,
    private readonly velocities: Float32Array,
    private readonly spins: Float32Array,
    sampleValues: Float64Array,
    private readonly contacts: Contacts[],
  ) {
    this.count = header.bodies.length;
    this.roster = {
      epoch: 1,
      title: header.title,
      materials: header.materials,
      bodies: new Map(header.bodies.map((body) => [body.slot, body])),
      slots: this.count,
    };
    this.breaks = breaksOf(header.joints, header.frames, (f) => this.recorded(f));
    const width = header.sampleFields.length;
    for (let f = 1; f < header.frames; f++) {
      this.samples.push({ time: times[f], values: sampleValues.subarray(f * width, (f + 1) * width) });
    }
  }

  get frames(): number { return this.header.frames; }
  get duration(): number { return this.frames > 0 ? this.times[this.frames - 1] : 0; }

  /** The last frame at or before a time. */
  indexAt(time: number): number {
    let low = 0, high = this.frames - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time + 1e-9) low = middle; else high = middle - 1;
    }
    return Math.max(0, low);
  }

  /** The state at any time, between frames interpolated. */
  frameAt(time: number): Frame {
    const i = this.indexAt(time);
    const j = Math.min(i + 1, this.frames - 1);
    const span = this.times[j] - this.times[i];
    const part = span > 0 ? Math.min(1, Math.max(0, (time - this.times[i]) / span)) : 0;
    const n = this.count;
    const frame = this.recorded(i);
    frame.time = Math.min(Math.max(time, 0), this.duration);
    frame.speed = new Float32Array(n);
    if (part > 1e-6) this.blend(frame, j, part);
    frame.joints = jointsAt(this.header.joints, frame, (joint) => this.breaks[joint] <= i);
    frame.springs = springsAt(this.header.springs, frame);
    if (this.header.contacts) frame.contacts = this.contacts[i];
    for (let b = 0; b < n; b++) {
      const at = 3 * (n * i + b);
      frame.speed[b] = Math.hypot(this.velocities[at], this.velocities[at + 1], this.velocities[at + 2]);
    }
    return frame;
  }

  /** @return velocity [m/s] and spin [rad/s] of a body in the last frame at or before the time */
  motionAt(time: number, body: number): { velocity: number[]; spin: number[] } {
    const at = 3 * (this.count * this.indexAt(time) + body);
    return { velocity: [...this.velocities.subarray(at, at + 3)], spin: [...this.spins.subarray(at, at + 3)] };
  }

  /** A frame as it was recorded, in arrays of its own. */
  private recorded(i: number): Frame {
    const n = this.count;
    return {
      epoch: 1,
      time: this.times[i],
      step: i,
      slots: n,
      position: this.positions.slice(3 * n * i, 3 * n * (i + 1)),
      orientation: this.orientations.slice(4 * n * i, 4 * n * (i + 1)),
      flags: this.flags.subarray(n * i, n * (i + 1)),
    };
  }

  private blend(frame: Frame, next: number, part: number): void {
    const n = this.count;
    const p = this.positions, q = this.orientations;
    for (let b = 0; b < n; b++) {
      if (!(frame.flags[b] & present) || !(this.flags[n * next + b] & present)) continue;
      for (let k = 0; k < 3; k++) {
        const at = 3 * b + k;
        frame.position[at] += part * (p[3 * n * next + at] - frame.position[at]);
      }
      const at = 4 * b, to = 4 * n * next + at, o = frame.orientation;
      const sign = o[at] * q[to] + o[at + 1] * q[to + 1] + o[at + 2] * q[to + 2] + o[at + 3] * q[to + 3] < 0 ? -1 : 1;
      let length = 0;
      for (let k = 0; k < 4; k++) {
        o[at + k] += part * (sign * q[to + k] - o[at + k]);
        length += o[at + k] * o[at + k];
      }
      length = 1 / Math.sqrt(length || 1);
      for (let k = 0; k < 4; k++) o[at + k] *= length;
    }
  }
}

/** @throws Error with a readable text if the data are not a clip */
export async function decodeClip(compressed: Blob): Promise<Clip> {
  const stream = compressed.stream().pipeThrough(new DecompressionStream('gzip'));
  const data = await new Response(stream).arrayBuffer();
  const view = new DataView(data);
  const text = new TextDecoder();
  if (data.byteLength < 16 || text.decode(new Uint8Array(data, 0, 8)) !== magic) throw new Error('This is not a Cairn clip.');
  if (view.getUint32(8, true) !== clipVersion) throw new Error('This clip was made by another version of Cairn.');
  const headerBytes = view.getUint32(12, true);
  const header = JSON.parse(text.decode(new Uint8Array(data, 16, headerBytes))) as Header;
  let at = 16 + headerBytes;
  const take = (): Uint8Array => {
    const bytes = Number(view.getBigUint64(at, true));
    at += 8 + bytes;
    return new Uint8Array(data, at - bytes, bytes);
  };
  const n = header.bodies.length;
  const times = toNumbers(take());
  const flags = take();
  const positions = undelta(take(), header.frames, n, 3, header.positionUnit, 2);
  const orientations = undelta(take(), header.frames, n, 4, header.orientationUnit, 1);
  normalise(orientations);
  const velocities = undelta(take(), header.frames, n, 3, header.velocityUnit, 1);
  const spins = undelta(take(), header.frames, n, 3, header.spinUnit, 1);
  return new Clip(header, times, flags, positions, orientations, velocities, spins, toNumbers(take()), toContacts(take(), header.frames));
}

/** Of each frame: their number, then two indices and ten numbers for each. */
function toContacts(bytes: Uint8Array, frames: number): Contacts[] {
  const view = new DataView(bytes.slice().buffer);
  const all: Contacts[] = [];
  let at = 0;
  for (let f = 0; f < frames; f++) {
    const count = view.getUint32(at, true);
    at += 4;
    const contacts: Contacts = {
      count, a: new Uint32Array(count), b: new Uint32Array(count), distance: new Float32Array(count),
      point: new Float32Array(3 * count), normal: new Float32Array(3 * count), impulse: new Float32Array(3 * count),
    };
    for (let i = 0; i < count; i++, at += 48) {
      contacts.a[i] = view.getUint32(at, true);
      contacts.b[i] = view.getUint32(at + 4, true);
      contacts.distance[i] = view.getFloat32(at + 8, true);
      for (let k = 0; k < 3; k++) {
        contacts.point[3 * i + k] = view.getFloat32(at + 12 + 4 * k, true);
        contacts.normal[3 * i + k] = view.getFloat32(at + 24 + 4 * k, true);
        contacts.impulse[3 * i + k] = view.getFloat32(at + 36 + 4 * k, true);
      }
    }
    all.push(contacts);
  }
  return all;
}

function toNumbers(bytes: Uint8Array): Float64Array {
  return new Float64Array(bytes.slice().buffer);
}

/**
 * Undoes zigzag varints of the differences to the prediction: the last row (order 1), or the line through two (2).
 * A row holds the first component of all bodies, then the second, and so on.
 */
function undelta(bytes: Uint8Array, rows: number, bodies: number, components: number, unit: number, order: 1 | 2): Float32Array {
  const width = bodies * components;
  const out = new Float32Array(rows * width);
  let previous = new Float64Array(width), before = new Float64Array(width);
  let at = 0;
  for (let row = 0; row < rows; row++) {
    const current = before;
    for (let k = 0; k < components; k++) {
      for (let i = k; i < width; i += components) {
        let byte = bytes[at++];
        let zigzag = byte & 127;
        for (let scale = 128; byte & 128; scale *= 128) {
          byte = bytes[at++];
          zigzag += (byte & 127) * scale;
        }
        const difference = zigzag % 2 === 0 ? zigzag / 2 : -(zigzag + 1) / 2;
        const predicted = order === 2 && row > 1 ? 2 * previous[i] - before[i] : previous[i];
        current[i] = predicted + difference;
        out[row * width + i] = current[i] * unit;
      }
    }
    before = previous;
    previous = current;
  }
  return out;
}

function normalise(q: Float32Array): void {
  for (let i = 0; i < q.length; i += 4) {
    const scale = 1 / (Math.hypot(q[i], q[i + 1], q[i + 2], q[i + 3]) || 1);
    for (let k = 0; k < 4; k++) q[i + k] *= scale;
  }
}

/** The clip that `cairn export --html` put into this page. */
export function embeddedClip(): Blob | null {
  const element = document.getElementById('clip');
  if (!element?.textContent) return null;
  const text = atob(element.textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return new Blob([bytes]);
}
