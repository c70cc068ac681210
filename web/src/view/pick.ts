/** Which body lies under the pointer: exact ray tests against the shapes, nothing to do with triangles. */
import { Quaternion, Ray, Vector3 } from 'three';
import { present, type BodyInfo, type Frame, type Roster, type ShapeInfo } from '../model';
import { compoundDistance, hullDistance, meshDistance } from './solids';

export interface Hit { slot: number; distance: number; point: Vector3 }

const turn = new Quaternion();
const origin = new Vector3();
const direction = new Vector3();

/** @return the nearest body that is not a half-space, in front of any half-space that faces the ray */
export function pick(ray: Ray, roster: Roster, frame: Frame): Hit | null {
  const { body, distance } = nearest(ray, roster, frame);
  return body && body.shape.type !== 'plane' ? { slot: body.slot, distance, point: ray.at(distance, new Vector3()) } : null;
}

/** What the ray meets first, half-spaces included. */
export function nearest(ray: Ray, roster: Roster, frame: Frame): { body: BodyInfo | null; distance: number } {
  let best: BodyInfo | null = null;
  let limit = Infinity;
  for (const body of roster.bodies.values()) {
    const slot = body.slot;
    if (slot >= frame.slots || !(frame.flags[slot] & present)) continue;
    turn.fromArray(frame.orientation, 4 * slot).conjugate();
    origin.copy(ray.origin).sub(direction.fromArray(frame.position, 3 * slot)).applyQuaternion(turn);
    direction.copy(ray.direction).applyQuaternion(turn);
    const distance = distanceTo(body.shape, origin, direction);
    if (!(distance < limit)) continue;
    limit = distance;
    best = body;
  }
  return { body: best, distance: limit };
}

/** Distance along a ray in the frame of the body, or infinity. */
function distanceTo(shape: ShapeInfo, o: Vector3, d: Vector3): number {
  switch (shape.type) {
    case 'sphere': return sphere(o, d, shape.radius);
    case 'box': return box(o, d, shape.size);
    case 'capsule': return capsule(o, d, shape.radius, shape.length / 2);
    case 'cylinder': return cylinder(o, d, shape.radius, shape.length / 2);
    case 'hull': return hullDistance(o, d, shape.points);
    case 'mesh': return meshDistance(o, d, shape.vertices, shape.indices);
    case 'compound': return compoundDistance(o, d, shape.parts, distanceTo);
    case 'plane': {
      const n = new Vector3(...shape.normal);
      const slope = n.dot(d);
      return slope < 0 ? inFront((shape.offset * n.length() - n.dot(o)) / slope) : Infinity;
    }
  }
}

const inFront = (t: number): number => (t > 0 ? t : Infinity);

function sphere(o: Vector3, d: Vector3, radius: number): number {
  const b = o.dot(d), c = o.lengthSq() - radius * radius;
  const root = b * b - c;
  return root < 0 ? Infinity : inFront(-b - Math.sqrt(root));
}

function box(o: Vector3, d: Vector3, size: number[]): number {
  let near = -Infinity, far = Infinity;
  for (let k = 0; k < 3; k++) {
    const half = size[k] / 2;
    const from = o.getComponent(k), along = d.getComponent(k);
    if (along === 0) {
      if (Math.abs(from) > half) return Infinity;
      continue;
    }
    const t0 = (-half - from) / along, t1 = (half - from) / along;
    near = Math.max(near, Math.min(t0, t1));
    far = Math.min(far, Math.max(t0, t1));
  }
  return near <= far ? inFront(near) : Infinity;
}

function cylinder(o: Vector3, d: Vector3, radius: number, half: number): number {
  const a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y, c = o.x * o.x + o.y * o.y - radius * radius;
  const root = b * b - a * c;
  if (root < 0 || (a === 0 && c > 0)) return Infinity;
  let near = a > 0 ? (-b - Math.sqrt(root)) / a : -Infinity, far = a > 0 ? (-b + Math.sqrt(root)) / a : Infinity;
  if (d.z === 0) return Math.abs(o.z) <= half ? inFront(near) : Infinity;
  const t0 = (-half - o.z) / d.z, t1 = (half - o.z) / d.z;
  near = Math.max(near, Math.min(t0, t1));
  far = Math.min(far, Math.max(t0, t1));
  return near <= far ? inFront(near) : Infinity;
}

function capsule(o: Vector3, d: Vector3, radius: number, half: number): number {
  let best = Infinity;
  const a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y, c = o.x * o.x + o.y * o.y - radius * radius;
  const root = b * b - a * c;
  if (a > 0 && root >= 0) {
    const t = (-b - Math.sqrt(root)) / a;
    if (t > 0 && Math.abs(o.z + t * d.z) <= half) best = t;
  }
  for (const z of [-half, half]) best = Math.min(best, sphere(o.clone().setZ(o.z - z), d, radius));
  return best;
}
