/** What the page knows of a world: the roster of bodies, the frames and the samples for the charts. SI units. */

export type ShapeInfo =
  | { type: 'sphere'; radius: number }
  | { type: 'box'; size: [number, number, number] }
  | { type: 'capsule'; radius: number; length: number }
  | { type: 'cylinder'; radius: number; length: number }
  | { type: 'hull'; points: [number, number, number][] }
  | { type: 'compound'; parts: PartInfo[] }
  | { type: 'mesh'; vertices: [number, number, number][]; indices: [number, number, number][] }
  | { type: 'plane'; normal: [number, number, number]; offset: number };

/** A shape of a compound with its pose; the orientation is w, x, y, z. */
export interface PartInfo {
  shape: ShapeInfo;
  position: [number, number, number];
  orientation: [number, number, number, number];
}

/** A body as the page draws it; `slot` is its place in the arrays of a frame. */
export interface BodyInfo {
  slot: number;
  generation: number;
  name: string;
  shape: ShapeInfo;
  material: number;
  mass: number | null;
  /** touches nobody */
  sensor?: boolean;
  law?: LawInfo;
}

/** How a fixed body moves or its surface runs: vectors in W, that of the surface in the frame of the body. */
export interface LawInfo {
  /** [m/s] */
  velocity?: [number, number, number];
  /** [rad/s] */
  spin?: [number, number, number];
  /** largest displacement of what swings or follows a table [m] */
  swing?: [number, number, number];
  /** largest rotation vector of it [rad] */
  turn?: [number, number, number];
  /** [m/s] */
  surface?: [number, number, number];
}

export interface MaterialInfo {
  name: string;
  density: number;
}

/** All bodies of a world; `epoch` grows with every change, frames of another epoch do not fit. */
export interface Roster {
  epoch: number;
  title: string;
  materials: MaterialInfo[];
  bodies: Map<number, BodyInfo>;
  slots: number;
}

export const present = 1;
export const asleep = 2;
export const fixed = 4;

/** The contacts of one step; three numbers per vector. */
export interface Contacts {
  count: number;
  a: Uint32Array;
  b: Uint32Array;
  point: Float32Array;
  normal: Float32Array;
  distance: Float32Array;
  impulse: Float32Array;
}

/** What a joint keeps, in the order of their numbers. */
export const jointKinds = ['distance', 'rope', 'ball joint', 'hinge', 'slider', 'fixed joint', 'universal joint', 'planar joint',
  'cylindrical joint', 'screw', 'generic joint', 'gear', 'rack', 'mimic'];
export const distanceJoint = 0, ropeJoint = 1, ballJoint = 2, sliderJoint = 4, fixedJoint = 5, universalJoint = 6, planarJoint = 7,
  cylindricalJoint = 8, screwJoint = 9, genericJoint = 10, gearJoint = 11;

/** Gears, racks and mimics: between the anchors of two joints. */
export function couples(kind: number): boolean { return kind >= gearJoint; }
/** Whether a line shows the axis that the joint turns about or moves along. */
export function hasAxis(kind: number): boolean {
  return kind !== ballJoint && kind !== fixedJoint && kind !== genericJoint && kind > ropeJoint && !couples(kind);
}
/** stands for the world where a body could stand */
export const noSlot = 0xffffffff;

/** The joints of a world; `points` has nine numbers per joint: the points of A and B, and the axis of hinges and sliders. */
export interface Joints {
  count: number;
  kind: Uint32Array;
  a: Uint32Array;
  b: Uint32Array;
  points: Float32Array;
}

/** The state at one moment; arrays have one entry (or 3, 4, 6) per slot. Optional ones are there when asked for. */
export interface Frame {
  epoch: number;
  time: number;
  step: number;
  slots: number;
  position: Float32Array;
  /** x, y, z, w */
  orientation: Float32Array;
  flags: Uint8Array;
  speed?: Float32Array;
  batch?: Uint32Array;
  overlap?: Float32Array;
  level?: Int8Array;
  stage?: Int16Array;
  bounds?: Float32Array;
  moves?: Float32Array;
  contacts?: Contacts;
  /** pairs of points */
  springs?: Float32Array;
  joints?: Joints;
  /** nine numbers per ray that hits: where it begins and hits, and the normal there */
  rays?: Float32Array;
}

/** One simulation step of 1/30 s, for the charts; `values` in the order of `sampleFields`. */
export interface Sample {
  time: number;
  values: Float64Array;
}

export type LayerName =
  | 'speed' | 'batch' | 'overlap' | 'level' | 'stage' | 'bounds' | 'moves' | 'contacts' | 'joints';

export type ColourMode = 'material' | 'batch' | 'asleep' | 'speed' | 'overlap' | 'level' | 'stage';

/** What the user sees; shared by live views and recordings. */
export interface ViewOptions {
  colour: ColourMode;
  points: boolean;
  normals: boolean;
  impulses: boolean;
  friction: boolean;
  moves: boolean;
  bounds: boolean;
  joints: boolean;
  laws: boolean;
  rays: boolean;
  shadows: boolean;
  grid: boolean;
}

export const defaultOptions: ViewOptions = {
  colour: 'material', points: false, normals: false, impulses: false, friction: false, moves: false, bounds: false,
  joints: true, laws: true, rays: false, shadows: true, grid: true,
};

/** The arrays that must come with the frames so that the options can be drawn. */
export function layersFor(options: ViewOptions): LayerName[] {
  const layers = new Set<LayerName>();
  if (options.colour !== 'material' && options.colour !== 'asleep') layers.add(options.colour);
  if (options.points || options.normals || options.impulses || options.friction) layers.add('contacts');
  if (options.moves) layers.add('moves');
  if (options.bounds) layers.add('bounds');
  if (options.joints) layers.add('joints');
  return [...layers].sort();
}
