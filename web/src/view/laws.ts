/** Laws of motion as lines: where a body goes, how far it swings, which way it turns, and how its surface runs. */
import { Quaternion, Vector3 } from 'three';
import { present, type BodyInfo, type Frame, type LawInfo, type Roster } from '../model';
import { boxOf } from './solids';

export type AddLine = (ax: number, ay: number, az: number, bx: number, by: number, bz: number) => void;

/** Strokes of the circle that shows a turn. */
const strokes = 28;

function line(add: AddLine, from: Vector3, to: Vector3): void { add(from.x, from.y, from.z, to.x, to.y, to.z); }

/** Any direction across another one. */
function across(axis: Vector3): Vector3 {
  const help = Math.abs(axis.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  return help.cross(axis).normalize();
}

function arrow(add: AddLine, from: Vector3, to: Vector3, head: number): void {
  line(add, from, to);
  const way = to.clone().sub(from).normalize();
  const side = across(way);
  for (const sign of [-0.45, 0.45]) line(add, to, to.clone().addScaledVector(way, -head).addScaledVector(side, sign * head));
}

/** Three quarters of a circle about an axis, with a head. */
function turning(add: AddLine, centre: Vector3, axis: Vector3, radius: number): void {
  const u = across(axis), v = axis.clone().cross(u);
  const at = (i: number): Vector3 => {
    const angle = (1.5 * Math.PI * i) / strokes;
    return centre.clone().addScaledVector(u, radius * Math.cos(angle)).addScaledVector(v, radius * Math.sin(angle));
  };
  for (let i = 0; i + 1 < strokes; i++) line(add, at(i), at(i + 1));
  arrow(add, at(strokes - 1), at(strokes), 0.25 * radius);
  line(add, centre.clone().addScaledVector(axis, -1.6 * radius), centre.clone().addScaledVector(axis, 1.6 * radius));
}

function drawLaw(add: AddLine, law: LawInfo, centre: Vector3, orientation: Quaternion, half: Vector3, size: number): void {
  const head = 0.8 * size;
  if (law.velocity) {
    const v = new Vector3(...law.velocity);
    if (v.length() > 0) arrow(add, centre, centre.clone().add(v), head);
  }
  if (law.swing) {
    const swing = new Vector3(...law.swing);
    if (swing.length() > 0) {
      // Short swings are drawn longer, so that they are seen beside the body.
      const reach = swing.clone().setLength(Math.max(swing.length(), half.length()));
      arrow(add, centre, centre.clone().add(reach), head);
      arrow(add, centre, centre.clone().sub(reach), head);
    }
  }
  const spin = law.spin ?? law.turn;
  if (spin && new Vector3(...spin).length() > 0) {
    const axis = new Vector3(...spin).normalize();
    turning(add, centre, axis, 0.75 * half.length());
  }
  if (law.surface) {
    // Arrows along the belt, on its upper side.
    const along = new Vector3(...law.surface);
    const way = along.clone().normalize();
    const top = new Vector3(0, 0, half.z + 0.05 * size);
    const reach = Math.abs(way.x) * half.x + Math.abs(way.y) * half.y;
    for (const part of [-0.7, -0.1, 0.5]) {
      const place = (t: number): Vector3 => way.clone().multiplyScalar(t * reach).add(top).applyQuaternion(orientation).add(centre);
      arrow(add, place(part), place(part + 0.25), head);
    }
  }
}

/** Draws all laws of a world. @param size of a typical body [m] */
export function drawLaws(add: AddLine, roster: Roster, frame: Frame, size: number): void {
  for (const body of lawfulBodies(roster)) {
    const { slot } = body;
    if (slot >= frame.slots || !(frame.flags[slot] & present)) continue;
    const orientation = new Quaternion().fromArray(frame.orientation, 4 * slot);
    const box = boxOf(body.shape);
    if (!box) continue;
    const centre = box.getCenter(new Vector3()).applyQuaternion(orientation).add(new Vector3().fromArray(frame.position, 3 * slot));
    drawLaw(add, body.law!, centre, orientation, box.getSize(new Vector3()).multiplyScalar(0.5), size);
  }
}

const found = new WeakMap<Roster, BodyInfo[]>();

/** Few bodies move by a law: they are looked for once. */
function lawfulBodies(roster: Roster): BodyInfo[] {
  let bodies = found.get(roster);
  if (!bodies) found.set(roster, (bodies = [...roster.bodies.values()].filter((body) => body.law)));
  return bodies;
}
