/** Joints and springs of a recording: placed by the poses of the bodies that they tie together. */
import { Quaternion, Vector3 } from 'three';
import {
  couples, cylindricalJoint, distanceJoint, genericJoint, noSlot, planarJoint, present, ropeJoint, screwJoint, sliderJoint,
  type Frame, type Joints,
} from './model';

type Triple = [number, number, number];

/** A line between two bodies, or a body and the world (b = null); anchors in the frames of the bodies. */
export interface LineInfo { a: number; b: number | null; anchorA: Triple; anchorB: Triple }

export interface JointInfo extends LineInfo {
  kind: number;
  /** of those that have one, in the frame of B */
  axis: Triple;
  /** of distances and ropes [m] */
  length: number;
  breaks: boolean;
}

/** Recordings do not say when a joint broke: a breakable one is gone once its points are apart by more than this [m]. */
const apart = 0.005;

class Placer {
  private readonly turn = new Quaternion();
  private readonly origin = new Vector3();

  constructor(private readonly frame: Frame) {}

  has(slot: number | null): boolean { return slot === null || (this.frame.flags[slot] & present) !== 0; }

  point(slot: number | null, local: Triple): Vector3 {
    const point = this.direction(slot, local);
    return slot === null ? point : point.add(this.origin.fromArray(this.frame.position, 3 * slot));
  }

  direction(slot: number | null, local: Triple): Vector3 {
    const vector = new Vector3(...local);
    return slot === null ? vector : vector.applyQuaternion(this.turn.fromArray(this.frame.orientation, 4 * slot));
  }
}

/** @return pairs of points */
export function springsAt(springs: LineInfo[], frame: Frame): Float32Array {
  const place = new Placer(frame);
  return new Float32Array(springs.filter((s) => place.has(s.a) && place.has(s.b))
    .flatMap((s) => [...place.point(s.a, s.anchorA).toArray(), ...place.point(s.b, s.anchorB).toArray()]));
}

/** @param broken which joints are gone */
export function jointsAt(infos: JointInfo[], frame: Frame, broken: (index: number) => boolean): Joints {
  const place = new Placer(frame);
  const shown = infos.filter((joint, i) => place.has(joint.a) && place.has(joint.b) && !broken(i));
  return {
    count: shown.length,
    kind: Uint32Array.from(shown, (joint) => joint.kind),
    a: Uint32Array.from(shown, (joint) => joint.a),
    b: Uint32Array.from(shown, (joint) => joint.b ?? noSlot),
    points: new Float32Array(shown.flatMap((joint) => [place.point(joint.a, joint.anchorA), place.point(joint.b, joint.anchorB),
      place.direction(joint.b, joint.axis)].flatMap((vector) => vector.toArray()))),
  };
}

/** @return for each joint the first frame in which it is broken, Infinity for those that hold */
export function breaksOf(infos: JointInfo[], frames: number, frameAt: (index: number) => Frame): number[] {
  const first = infos.map(() => Infinity);
  if (!infos.some((joint) => joint.breaks)) return first;
  for (let f = 0; f < frames; f++) {
    const place = new Placer(frameAt(f));
    infos.forEach((joint, i) => {
      if (joint.breaks && first[i] === Infinity && gapOf(joint, place) > apart) first[i] = f;
    });
  }
  return first;
}

/** How far a joint is from what it keeps [m]. */
function gapOf(joint: JointInfo, place: Placer): number {
  const way = place.point(joint.a, joint.anchorA).sub(place.point(joint.b, joint.anchorB));
  switch (joint.kind) {
    case distanceJoint: return Math.abs(way.length() - joint.length);
    case ropeJoint: return way.length() - joint.length;
    case sliderJoint: case cylindricalJoint: case screwJoint:
      return way.projectOnPlane(place.direction(joint.b, joint.axis).normalize()).length();
    case planarJoint: return Math.abs(way.dot(place.direction(joint.b, joint.axis).normalize()));
    // What it leaves free is not told.
    case genericJoint: return 0;
    default: return couples(joint.kind) ? 0 : way.length();
  }
}
