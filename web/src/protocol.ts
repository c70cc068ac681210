/** The messages of docs/view-protocol.md, as the page sees them. */
import type { BodyInfo, Contacts, Frame, Joints, MaterialInfo, Sample } from './model';

export type Value = number | string | boolean;

export interface FieldInfo {
  name: string;
  stage: string;
  unit: string;
  meaning: string;
  kind: 'switch' | 'whole' | 'number' | 'choice';
  minimum: number | null;
  maximum: number | null;
  choices: string[];
}

export interface Hello {
  type: 'hello';
  protocol: number;
  version: string;
  mode: 'live' | 'replay' | 'film';
  client: number;
  scenes: { name: string; description: string; example: string }[];
  fields: FieldInfo[];
  stages: string[];
  sampleFields: string[];
  recordings: string[];
  film?: FilmOrder;
}

export interface FilmOrder {
  width: number;
  height: number;
  format: 'png' | 'jpeg';
  times: number[];
  camera: number[] | null;
  theme: 'light' | 'dark';
  /** what is drawn over the bodies: names of switches */
  layers: string[];
}

export interface WorldMessage {
  type: 'world';
  epoch: number;
  title: string;
  materials: MaterialInfo[];
  bodies: BodyInfo[];
}

export interface BodiesMessage {
  type: 'bodies';
  epoch: number;
  materials: MaterialInfo[];
  added: BodyInfo[];
  removed: number[];
}

export interface State {
  type: 'state';
  scene: string;
  duration: number;
  playing: boolean;
  speed: number;
  time: number;
  steps: number;
  realTime: number;
  dial: number | null;
  settings: Record<string, Value>;
  gravity: [number, number, number];
  clients: number;
  hash: string | null;
  kinetic: number;
  potential: number;
  faults: string[];
}

export interface SelectedContact {
  other: string;
  point: number[];
  normal: number[];
  distance: number;
  impulse: number[];
}

export interface SelectedJoint {
  kind: number;
  other: string;
  position: number;
  force: number;
  torque: number;
}

export interface Selection {
  type: 'selection';
  body: { slot: number; generation: number } | null;
  name: string;
  shape: string;
  material: string;
  mass: number | null;
  position: number[];
  orientation: number[];
  velocity: number[];
  spin: number[];
  asleep: boolean;
  fixed: boolean;
  batch: { index: number; bodies: number; contacts: number } | null;
  contacts: SelectedContact[];
  joints: SelectedJoint[];
}

export interface ErrorMessage { type: 'error'; text: string; id?: number }
export interface DoneMessage { type: 'done'; id: number; body?: { slot: number; generation: number } }

export interface NextPicture { type: 'next-picture' }

export type TextMessage = NextPicture | Hello | WorldMessage | BodiesMessage | State | Selection | ErrorMessage | DoneMessage;

export const frameKind = 1;
export const sampleKind = 2;

const enum Section { position = 1, orientation, flags, speed, batch, overlap, level, stage, bounds, moves, contacts, springs, joints, rays }
const contactWords = 12;
const jointWords = 12;

/** The rest of a binary message after its kind. @throws RangeError if it is cut off */
export function decodeFrame(data: ArrayBuffer): Frame {
  const view = new DataView(data);
  const frame: Frame = {
    epoch: view.getUint32(4, true),
    step: Number(view.getBigUint64(8, true)),
    time: view.getFloat64(16, true),
    slots: view.getUint32(24, true),
    position: new Float32Array(0),
    orientation: new Float32Array(0),
    flags: new Uint8Array(0),
  };
  let at = 32;
  while (at < data.byteLength) {
    const kind = view.getUint32(at, true);
    const bytes = view.getUint32(at + 4, true);
    at += 8;
    switch (kind) {
      case Section.position: frame.position = new Float32Array(data, at, bytes / 4); break;
      case Section.orientation: frame.orientation = unpackOrientations(new Int16Array(data, at, bytes / 2)); break;
      case Section.flags: frame.flags = new Uint8Array(data, at, bytes); break;
      case Section.speed: frame.speed = new Float32Array(data, at, bytes / 4); break;
      case Section.batch: frame.batch = new Uint32Array(data, at, bytes / 4); break;
      case Section.overlap: frame.overlap = new Float32Array(data, at, bytes / 4); break;
      case Section.level: frame.level = new Int8Array(data, at, bytes); break;
      case Section.stage: frame.stage = new Int16Array(data, at, bytes / 2); break;
      case Section.bounds: frame.bounds = new Float32Array(data, at, bytes / 4); break;
      case Section.moves: frame.moves = new Float32Array(data, at, bytes / 4); break;
      case Section.contacts: frame.contacts = unpackContacts(data, at, bytes); break;
      case Section.springs: frame.springs = new Float32Array(data, at, bytes / 4); break;
      case Section.joints: frame.joints = unpackJoints(data, at, bytes); break;
      case Section.rays: frame.rays = new Float32Array(data, at, bytes / 4); break;
    }
    at += (bytes + 3) & ~3;
  }
  return frame;
}

function unpackOrientations(packed: Int16Array): Float32Array {
  const out = new Float32Array(packed.length);
  for (let i = 0; i < packed.length; i += 4) {
    const x = packed[i], y = packed[i + 1], z = packed[i + 2], w = packed[i + 3];
    const scale = 1 / (Math.hypot(x, y, z, w) || 1);
    out[i] = x * scale;
    out[i + 1] = y * scale;
    out[i + 2] = z * scale;
    out[i + 3] = w * scale;
  }
  return out;
}

function unpackContacts(data: ArrayBuffer, at: number, bytes: number): Contacts {
  const words = new Uint32Array(data, at, bytes / 4);
  const numbers = new Float32Array(data, at, bytes / 4);
  const count = Math.floor(words.length / contactWords);
  const contacts: Contacts = {
    count,
    a: new Uint32Array(count),
    b: new Uint32Array(count),
    point: new Float32Array(3 * count),
    normal: new Float32Array(3 * count),
    distance: new Float32Array(count),
    impulse: new Float32Array(3 * count),
  };
  for (let i = 0; i < count; i++) {
    const w = i * contactWords;
    contacts.a[i] = words[w];
    contacts.b[i] = words[w + 1];
    contacts.distance[i] = numbers[w + 2];
    for (let k = 0; k < 3; k++) {
      contacts.point[3 * i + k] = numbers[w + 3 + k];
      contacts.normal[3 * i + k] = numbers[w + 6 + k];
      contacts.impulse[3 * i + k] = numbers[w + 9 + k];
    }
  }
  return contacts;
}

function unpackJoints(data: ArrayBuffer, at: number, bytes: number): Joints {
  const words = new Uint32Array(data, at, bytes / 4);
  const numbers = new Float32Array(data, at, bytes / 4);
  const count = Math.floor(words.length / jointWords);
  const joints: Joints = {
    count, kind: new Uint32Array(count), a: new Uint32Array(count), b: new Uint32Array(count), points: new Float32Array(9 * count),
  };
  for (let i = 0; i < count; i++) {
    const w = i * jointWords;
    joints.kind[i] = words[w];
    joints.a[i] = words[w + 1];
    joints.b[i] = words[w + 2];
    joints.points.set(numbers.subarray(w + 3, w + 12), 9 * i);
  }
  return joints;
}

/** One or more simulation steps for the charts. */
export function decodeSamples(data: ArrayBuffer): Sample[] {
  const view = new DataView(data);
  const width = view.getUint32(4, true);
  const values = new Float64Array(data, 8);
  const samples: Sample[] = [];
  for (let at = 0; at + width <= values.length; at += width) {
    samples.push({ time: values[at], values: values.slice(at, at + width) });
  }
  return samples;
}
