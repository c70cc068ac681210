/** Shapes that have no dimensions of their own: hulls of points, surfaces of triangles, and compounds of other shapes. */
import { Box3, BufferGeometry, Float32BufferAttribute, Matrix4, Quaternion, Ray, Vector3 } from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';
import { ConvexHull } from 'three/addons/math/ConvexHull.js';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import type { PartInfo, ShapeInfo } from '../model';

/** The half of a unit ball with z ≥ 0; the vertex shader turns it to the camera, so that the other half is never missed. */
export function domeGeometry(around: number, rings: number): BufferGeometry {
  const points = [0, 0, 1];
  const triangles: number[] = [];
  const at = (ring: number, i: number): number => 1 + (ring - 1) * around + (i % around);
  for (let ring = 1; ring <= rings; ring++) {
    const down = (Math.PI / 2) * (ring / rings);
    for (let i = 0; i < around; i++) {
      const turn = (2 * Math.PI * i) / around;
      points.push(Math.sin(down) * Math.cos(turn), Math.sin(down) * Math.sin(turn), Math.cos(down));
      if (ring === 1) triangles.push(0, at(1, i), at(1, i + 1));
      else triangles.push(at(ring - 1, i), at(ring, i), at(ring, i + 1), at(ring - 1, i), at(ring, i + 1), at(ring - 1, i + 1));
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  geometry.setAttribute('normal', new Float32BufferAttribute(points, 3));
  geometry.setIndex(triangles);
  return geometry;
}

/** Three faces of a box of ±1; the vertex shader turns each to the camera, so that the other three are never missed. */
export function cornerGeometry(): BufferGeometry {
  const points: number[] = [], normals: number[] = [], triangles: number[] = [];
  for (let axis = 0; axis < 3; axis++) {
    const first = points.length / 3;
    for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
      const point = [1, u, v], normal = [1, 0, 0];
      for (let k = 0; k < 3; k++) {
        points.push(point[(k + 3 - axis) % 3]);
        normals.push(normal[(k + 3 - axis) % 3]);
      }
    }
    triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  geometry.setAttribute('normal', new Float32BufferAttribute(normals, 3));
  geometry.setIndex(triangles);
  return geometry;
}

const vectors = (points: number[][]): Vector3[] => points.map(([x, y, z]) => new Vector3(x, y, z));

export function hullGeometry(points: number[][]): BufferGeometry {
  return new ConvexGeometry(vectors(points));
}

/** A surface of flat triangles, drawn from both sides: what is beneath a terrain is seen, too. */
export function meshGeometry(vertices: number[][], indices: number[][]): BufferGeometry {
  const sides = [(t: number[]): number[] => t, ([a, b, c]: number[]): number[] => [a, c, b]];
  const points = sides.flatMap((turned) => indices.flatMap((t) => turned(t).flatMap((corner) => vertices[corner])));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** @param make the geometry of a part in its own frame, in metres */
export function compoundGeometry(parts: PartInfo[], make: (shape: ShapeInfo) => BufferGeometry): BufferGeometry {
  const one = new Vector3(1, 1, 1);
  const geometries = parts.map((part) => {
    const made = make(part.shape);
    const geometry = made.index ? made.toNonIndexed() : made;
    geometry.deleteAttribute('uv');
    return geometry.applyMatrix4(new Matrix4().compose(new Vector3(...part.position), turnOf(part), one));
  });
  return mergeGeometries(geometries);
}

/** The orientation of a part. */
function turnOf(part: PartInfo): Quaternion {
  const [w, x, y, z] = part.orientation;
  return new Quaternion(x, y, z, w).normalize();
}

/** Largest length of a shape [m], roughly. */
export function sizeOf(shape: ShapeInfo): number {
  switch (shape.type) {
    case 'box': return Math.max(...shape.size);
    case 'sphere': return 2 * shape.radius;
    case 'capsule':
    case 'cylinder': return 2 * shape.radius + shape.length;
    case 'hull': return 2 * Math.max(...distances(shape.points));
    case 'mesh': return boxOf(shape)!.getSize(new Vector3()).length();
    case 'compound': return Math.max(...shape.parts.map((part) => 2 * Math.hypot(...part.position) + sizeOf(part.shape)));
    case 'plane': return Infinity;
  }
}

/** The box around a shape, in its own frame; none for half-spaces. */
export function boxOf(shape: ShapeInfo): Box3 | null {
  const about = (x: number, y: number, z: number): Box3 => new Box3(new Vector3(-x, -y, -z), new Vector3(x, y, z));
  switch (shape.type) {
    case 'box': return about(shape.size[0] / 2, shape.size[1] / 2, shape.size[2] / 2);
    case 'sphere': return about(shape.radius, shape.radius, shape.radius);
    case 'capsule': return about(shape.radius, shape.radius, shape.radius + shape.length / 2);
    case 'cylinder': return about(shape.radius, shape.radius, shape.length / 2);
    case 'hull': return new Box3().setFromPoints(vectors(shape.points));
    case 'mesh': return new Box3().setFromPoints(vectors(shape.vertices));
    case 'compound': return shape.parts.reduce((box, part) => {
      const place = new Matrix4().compose(new Vector3(...part.position), turnOf(part), new Vector3(1, 1, 1));
      const inner = boxOf(part.shape);
      return inner ? box.union(inner.applyMatrix4(place)) : box;
    }, new Box3());
    case 'plane': return null;
  }
}

/** Of points from their middle. */
function distances(points: number[][]): number[] {
  const middle = [0, 1, 2].map((k) => points.reduce((sum, point) => sum + point[k], 0) / points.length);
  return points.map((point) => Math.hypot(...point.map((value, k) => value - middle[k])));
}

const hulls = new WeakMap<number[][], ConvexHull>();

/** Distance along a ray in the frame of the points, or infinity. */
export function hullDistance(o: Vector3, d: Vector3, points: number[][]): number {
  let hull = hulls.get(points);
  if (!hull) hulls.set(points, (hull = new ConvexHull().setFromPoints(vectors(points))));
  const hit = hull.intersectRay(new Ray(o, d), new Vector3());
  return hit ? hit.distanceTo(o) : Infinity;
}

const corners = new WeakMap<number[][], Vector3[]>();

/** Distance along a ray in the frame of the vertices, or infinity. */
export function meshDistance(o: Vector3, d: Vector3, vertices: number[][], indices: number[][]): number {
  const ray = new Ray(o, d);
  const at = new Vector3();
  let points = corners.get(vertices);
  if (!points) corners.set(vertices, (points = vectors(vertices)));
  let best = Infinity;
  for (const [a, b, c] of indices) {
    if (ray.intersectTriangle(points[a], points[b], points[c], false, at)) best = Math.min(best, at.distanceTo(o));
  }
  return best;
}

/** Distance along a ray in the frame of the compound, or infinity. */
export function compoundDistance(
  o: Vector3, d: Vector3, parts: PartInfo[], distance: (shape: ShapeInfo, o: Vector3, d: Vector3) => number,
): number {
  return Math.min(...parts.map((part) => {
    const back = turnOf(part).conjugate();
    const from = o.clone().sub(new Vector3(...part.position)).applyQuaternion(back);
    return distance(part.shape, from, d.clone().applyQuaternion(back));
  }));
}
