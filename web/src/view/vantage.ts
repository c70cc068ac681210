/** From where everything is seen: no wall hides the bodies, and all of them fit into the picture. */
import { Box3, Matrix4, Quaternion, Ray, Vector3 } from 'three';
import { fixed, present, type BodyInfo, type Frame, type Roster } from '../model';
import { nearest } from './pick';
import { boxOf } from './solids';

/** From the front and a little from above, as the first choice; the height over the horizontal distance. */
const heights = [0.42, 0.7, 1.1, 1.8, 3.2];
const front = new Vector3(-0.52, -0.86, 0);
/** A view in which so large a part of those are seen that the best view shows needs no better one. */
const enough = 0.6;
/** How many bodies are asked whether they are seen. */
const asked = 60;

/** Unit vectors towards the camera. */
function directions(): Vector3[] {
  return heights.map((height) => front.clone().setZ(height * front.length()).normalize());
}

/** The part of the bodies that can move which no fixed body hides. */
function seenPart(roster: Roster, frame: Frame, towards: Vector3, distance: number): number {
  const walls = { ...roster, bodies: new Map([...roster.bodies].filter(([slot, body]) =>
    slot < frame.slots && frame.flags[slot] & fixed && !body.sensor)) };
  const movers = [...roster.bodies.keys()].filter((slot) => slot < frame.slots && (frame.flags[slot] & (present | fixed)) === present);
  const stride = Math.max(1, Math.floor(movers.length / asked));
  let seen = 0, all = 0;
  for (let i = 0; i < movers.length; i += stride) {
    const ray = new Ray(new Vector3().fromArray(frame.position, 3 * movers[i]), towards);
    all++;
    if (nearest(ray, walls, frame).distance > distance) seen++;
  }
  return all === 0 ? 1 : seen / all;
}

/** The lowest direction from which enough is seen. @param distance of the camera [m] */
export function bestDirection(roster: Roster | null, frame: Frame | null, distance: number): Vector3 {
  const all = directions();
  if (!roster || !frame) return all[0];
  const parts = all.map((towards) => seenPart(roster, frame, towards, distance));
  return all[parts.findIndex((part) => part >= enough * Math.max(...parts))];
}

/** How far from the middle of a box the camera must be so that all of it is in the picture.
 * @param towards the camera, a unit vector @param tangent of half the angle of view from bottom to top */
export function fittingDistance(box: Box3, towards: Vector3, tangent: number, aspect: number): number {
  const right = new Vector3(0, 0, 1).cross(towards).normalize();
  const up = towards.clone().cross(right);
  const centre = box.getCenter(new Vector3());
  let distance = 0;
  for (let i = 0; i < 8; i++) {
    const corner = new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(centre);
    const across = Math.max(Math.abs(corner.dot(up)) / tangent, Math.abs(corner.dot(right)) / (tangent * aspect));
    distance = Math.max(distance, corner.dot(towards) + across);
  }
  return distance;
}

/** The box around a body as it stands; none for half-spaces. */
function placedBox({ shape, slot }: BodyInfo, frame: Frame): Box3 | undefined {
  return boxOf(shape)?.applyMatrix4(new Matrix4().compose(new Vector3().fromArray(frame.position, 3 * slot),
    new Quaternion().fromArray(frame.orientation, 4 * slot), new Vector3(1, 1, 1)));
}

/** The box of what is to be seen: bodies, and fixed ones of their size that stand among them.
 * @param slots of the bodies */
export function shownBox(roster: Roster, frame: Frame, slots: number[]): Box3 {
  const all = new Box3();
  for (const slot of slots) {
    const box = placedBox(roster.bodies.get(slot)!, frame);
    if (box) all.union(box);
  }
  const reach = all.getSize(new Vector3()).length();
  const near = all.clone().expandByScalar(0.05 * reach);
  for (const body of roster.bodies.values()) {
    const { shape, slot, sensor } = body;
    if (sensor || shape.type === 'mesh' || slot >= frame.slots || (frame.flags[slot] & (present | fixed)) !== (present | fixed)) continue;
    const box = placedBox(body, frame);
    if (box && box.getSize(new Vector3()).length() < 3 * reach && box.intersectsBox(near)) all.union(box);
  }
  return all;
}
