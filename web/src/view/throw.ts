/** How a ball is thrown from the camera so that it comes down where the pointer is. */
import { Vector3, type Ray } from 'three';
import type { Plane } from './ground';

export interface Shot { origin: Vector3; velocity: Vector3 }

/**
 * @param ray from the camera through the pointer
 * @param aim distance along the ray of what is to be hit [m]
 * @param planes half-spaces that the ball must not begin in
 */
export function shotAlong(ray: Ray, aim: number, gravity: Vector3, speed: number, radius: number, planes: Plane[]): Shot {
  // A little in front of the camera, but not in what is hit.
  let start = Math.max(0, Math.min(4 * radius, aim - 1.5 * radius));
  const above = (plane: Plane, point: Vector3): number => plane.normal.dot(point) - plane.offset - 1.02 * radius;
  for (const plane of planes) {
    const slope = plane.normal.dot(ray.direction);
    if (slope > 0) start = Math.max(start, -above(plane, ray.origin) / slope);
  }
  const origin = ray.at(start, new Vector3());
  for (const plane of planes) origin.addScaledVector(plane.normal, Math.max(0, -above(plane, origin)));
  return { origin, velocity: velocityTo(ray.at(Math.max(aim, start + radius), new Vector3()).sub(origin), gravity, speed) };
}

/** The flat one of the two parabolas that lead to a point, or straight on if none does. @param way to the point [m] */
function velocityTo(way: Vector3, gravity: Vector3, speed: number): Vector3 {
  const b = speed * speed + way.dot(gravity);
  const root = b * b - gravity.lengthSq() * way.lengthSq();
  if (root < 0 || b <= 0) return way.clone().setLength(speed);
  const time = Math.sqrt((2 * way.lengthSq()) / (b + Math.sqrt(root)));
  return way.clone().divideScalar(time).addScaledVector(gravity, -time / 2);
}
