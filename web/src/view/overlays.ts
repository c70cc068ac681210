/** What the simulation did, drawn over the bodies: contacts, normals, impulses, friction, moves, bounds, springs, rays. */
import {
  BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, LineBasicMaterial, LineSegments, Matrix4, Points, PointsMaterial, Quaternion,
  Vector3,
} from 'three';
import { couples, distanceJoint, hasAxis, noSlot, present, ropeJoint, type BodyInfo, type Frame, type Joints, type Roster, type ViewOptions } from '../model';
import { drawLaws } from './laws';
import { overlayHex } from './palette';
import { boxOf } from './solids';

/** Line segments that grow with their number. */
class Segments {
  readonly object: LineSegments;
  private used = 0;
  private points = new Float32Array(6 * 256);

  constructor(colour: string, depthTest: boolean, opacity = 1) {
    this.object = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: colour, depthTest, opacity, transparent: true }));
    this.object.frustumCulled = false;
    this.object.renderOrder = 2;
  }

  begin(): void { this.used = 0; }

  add(ax: number, ay: number, az: number, bx: number, by: number, bz: number): void {
    if (this.used + 6 > this.points.length) {
      const larger = new Float32Array(2 * this.points.length);
      larger.set(this.points);
      this.points = larger;
    }
    this.points.set([ax, ay, az, bx, by, bz], this.used);
    this.used += 6;
  }

  end(): void { show(this.object.geometry, this.points, this.used / 3); }
}

function show(geometry: BufferGeometry, points: Float32Array, count: number): void {
  let attribute = geometry.getAttribute('position') as BufferAttribute | undefined;
  if (attribute?.array !== points) {
    geometry.dispose();
    attribute = new BufferAttribute(points, 3);
    attribute.setUsage(DynamicDrawUsage);
    geometry.setAttribute('position', attribute);
  }
  attribute.needsUpdate = true;
  geometry.setDrawRange(0, count);
}

function dots(colour: string, size: number): Points {
  const points = new Points(new BufferGeometry(), new PointsMaterial({ color: colour, size, sizeAttenuation: false, depthTest: false, transparent: true }));
  points.frustumCulled = false;
  points.renderOrder = 3;
  return points;
}

export class Overlays {
  readonly group = new Group();
  private readonly lines = {
    normals: new Segments(overlayHex.normals, false),
    impulses: new Segments(overlayHex.impulses, false),
    friction: new Segments(overlayHex.friction, false),
    moves: new Segments(overlayHex.moves, false),
    bounds: new Segments(overlayHex.bounds, true),
    springs: new Segments(overlayHex.moves, false),
    joints: new Segments(overlayHex.joints, false),
    laws: new Segments(overlayHex.moves, false),
    rays: new Segments(overlayHex.outline, true, 0.4),
    hits: new Segments(overlayHex.normals, false),
    outline: new Segments(overlayHex.outline, false),
  };
  private readonly points = dots(overlayHex.points, 5);
  private readonly pins = dots(overlayHex.joints, 8);
  private impulseScale = 0;

  constructor() {
    this.group.add(this.points, this.pins);
    for (const segments of Object.values(this.lines)) this.group.add(segments.object);
  }

  /** @param size typical size of a body [m], for the length of the arrows */
  update(roster: Roster, frame: Frame, options: ViewOptions, size: number): void {
    this.lines.laws.begin();
    if (options.laws) drawLaws((...ends) => this.lines.laws.add(...ends), roster, frame, size);
    this.lines.laws.end();
    this.drawContacts(frame, options, size);
    this.lines.moves.begin();
    if (options.moves && frame.moves) this.drawMoves(frame, size);
    this.lines.moves.end();
    this.lines.bounds.begin();
    if (options.bounds && frame.bounds) this.drawBounds(frame);
    this.lines.bounds.end();
    this.lines.springs.begin();
    const s = frame.springs;
    for (let i = 0; s && i + 5 < s.length; i += 6) this.lines.springs.add(s[i], s[i + 1], s[i + 2], s[i + 3], s[i + 4], s[i + 5]);
    this.lines.springs.end();
    this.drawRays(options.rays ? frame.rays : undefined, size);
    this.drawJoints(options.joints ? frame.joints : undefined, frame, size);
  }

  /** A box around the selected body. */
  outline(frame: Frame, body: BodyInfo | undefined): void {
    const lines = this.lines.outline;
    lines.begin();
    const box = body && body.slot < frame.slots && frame.flags[body.slot] & present ? boxOf(body.shape) : null;
    if (body && box) {
      const place = new Matrix4().compose(new Vector3().fromArray(frame.position, 3 * body.slot),
        new Quaternion().fromArray(frame.orientation, 4 * body.slot), new Vector3(1, 1, 1));
      box.expandByScalar(0.03 * box.getSize(new Vector3()).length());
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
        i & 4 ? box.max.z : box.min.z).applyMatrix4(place));
      for (const bit of [1, 2, 4]) {
        for (let i = 0; i < 8; i++) if (!(i & bit)) lines.add(...corners[i].toArray(), ...corners[i | bit].toArray());
      }
    }
    lines.end();
  }

  private drawContacts(frame: Frame, options: ViewOptions, size: number): void {
    const c = frame.contacts;
    const { normals, impulses, friction } = this.lines;
    for (const lines of [normals, impulses, friction]) lines.begin();
    show(this.points.geometry, c?.point ?? new Float32Array(0), c && options.points ? c.count : 0);
    if (c) {
      if (options.impulses || options.friction) this.followImpulses(c.impulse);
      const length = 0.45 * size;
      for (let i = 0; i < c.count; i++) {
        const at = 3 * i;
        const x = c.point[at], y = c.point[at + 1], z = c.point[at + 2];
        const nx = c.normal[at], ny = c.normal[at + 1], nz = c.normal[at + 2];
        if (options.normals) normals.add(x, y, z, x + nx * length, y + ny * length, z + nz * length);
        const jx = c.impulse[at], jy = c.impulse[at + 1], jz = c.impulse[at + 2];
        if (jx === 0 && jy === 0 && jz === 0) continue;
        const j = jx * nx + jy * ny + jz * nz;
        const scale = (1.5 * size) / Math.sqrt(this.impulseScale * Math.hypot(jx, jy, jz));
        if (options.impulses) impulses.add(x, y, z, x + j * nx * scale, y + j * ny * scale, z + j * nz * scale);
        if (options.friction) friction.add(x, y, z, x + (jx - j * nx) * scale, y + (jy - j * ny) * scale, z + (jz - j * nz) * scale);
      }
    }
    for (const lines of [normals, impulses, friction]) lines.end();
  }

  /** The longest line belongs to the largest impulse of the last moments; others are as long as the root of their part. */
  private followImpulses(impulse: Float32Array): void {
    let largest = 0;
    for (let i = 0; i < impulse.length; i += 3) largest = Math.max(largest, Math.hypot(impulse[i], impulse[i + 1], impulse[i + 2]));
    this.impulseScale = Math.max(largest, 0.95 * this.impulseScale);
  }

  /** Moves are often far below a millimetre: they are drawn a hundred times as long, at most three bodies long. */
  private drawMoves(frame: Frame, size: number): void {
    const m = frame.moves!;
    for (let slot = 0; slot < frame.slots; slot++) {
      const at = 3 * slot;
      const length = Math.hypot(m[at], m[at + 1], m[at + 2]);
      if (length === 0 || !(frame.flags[slot] & present)) continue;
      const scale = Math.min(100, (3 * size) / length);
      const x = frame.position[at], y = frame.position[at + 1], z = frame.position[at + 2];
      this.lines.moves.add(x, y, z, x + m[at] * scale, y + m[at + 1] * scale, z + m[at + 2] * scale);
    }
  }

  /** A pin where bodies are joined, tied to their origins; rods, ropes and gears as they are, others with their axis. */
  private drawJoints(joints: Joints | undefined, frame: Frame, size: number): void {
    const lines = this.lines.joints;
    const pins: number[] = [];
    lines.begin();
    for (let i = 0; joints && i < joints.count; i++) {
      const [ax, ay, az, bx, by, bz, x, y, z] = joints.points.subarray(9 * i, 9 * i + 9);
      pins.push(ax, ay, az);
      const kind = joints.kind[i];
      if (kind === distanceJoint || kind === ropeJoint || couples(kind)) {
        pins.push(bx, by, bz);
        lines.add(ax, ay, az, bx, by, bz);
        continue;
      }
      for (const slot of [joints.a[i], joints.b[i]]) {
        const at = 3 * slot;
        if (slot !== noSlot && slot < frame.slots) lines.add(ax, ay, az, frame.position[at], frame.position[at + 1], frame.position[at + 2]);
      }
      if (!hasAxis(kind)) continue;
      lines.add(bx - size * x, by - size * y, bz - size * z, bx + size * x, by + size * y, bz + size * z);
    }
    lines.end();
    show(this.pins.geometry, new Float32Array(pins), pins.length / 3);
  }

  /** Each ray up to where it hits, and the normal there. */
  private drawRays(rays: Float32Array | undefined, size: number): void {
    const { rays: lines, hits } = this.lines;
    for (const segments of [lines, hits]) segments.begin();
    const length = 0.45 * size;
    for (let i = 0; rays && i + 8 < rays.length; i += 9) {
      const [fx, fy, fz, x, y, z, nx, ny, nz] = rays.subarray(i, i + 9);
      lines.add(fx, fy, fz, x, y, z);
      hits.add(x, y, z, x + length * nx, y + length * ny, z + length * nz);
    }
    for (const segments of [lines, hits]) segments.end();
  }

  private drawBounds(frame: Frame): void {
    const b = frame.bounds!;
    const lines = this.lines.bounds;
    for (let slot = 0; slot < frame.slots; slot++) {
      const [x0, y0, z0, x1, y1, z1] = b.subarray(6 * slot, 6 * slot + 6);
      if (!(frame.flags[slot] & present) || !Number.isFinite(x0 + y0 + z0 + x1 + y1 + z1)) continue;
      for (const [y, z] of [[y0, z0], [y1, z0], [y0, z1], [y1, z1]]) lines.add(x0, y, z, x1, y, z);
      for (const [x, z] of [[x0, z0], [x1, z0], [x0, z1], [x1, z1]]) lines.add(x, y0, z, x, y1, z);
      for (const [x, y] of [[x0, y0], [x1, y0], [x0, y1], [x1, y1]]) lines.add(x, y, z0, x, y, z1);
    }
  }
}
