/** Colours that people with any kind of colour vision can tell apart. All linear RGB in 0 to 1 after `toLinear`. */
import { Color } from 'three';

export type Rgb = [number, number, number];

/**
 * For things that have no order. Like all sets here, near Okabe and Ito's hues, moved until any two differ by 19 or more in
 * CIELAB to people with any kind of colour vision; tests/view/palette.cjs holds them to it.
 */
export const qualitativeHex = ['#607bc2', '#e8a002', '#22a275', '#794583', '#60c3fd', '#d25c01', '#e6da68', '#40409c'];
/** For quantities: blue over grey to yellow like cividis, but no darker than shaded bodies can bear. */
export const sequentialHex = ['#2455a8', '#4874b4', '#6d8eb5', '#93a3a9', '#b6b18b', '#d8c25f', '#fae03c'];
/** Of materials without a pattern of their own. */
export const paintHex = ['#4477a8', '#d9a441', '#6db392', '#d19ed1', '#b5553a', '#79838f'];

/** Of materials whose name says what they look like. */
const namedPaintHex: [RegExp, string][] = [
  [/earth|soil|mud/, '#8d8063'], [/sand|travertine|plaster/, '#cbb690'], [/grass|moss/, '#7d9460'], [/brick|clay/, '#a85f45'],
  [/rubber|tar|coal/, '#3c4046'], [/snow|ice/, '#e6eef3'],
];

export const qualitative: Rgb[] = qualitativeHex.map(toLinear);
const sequentialColours: Rgb[] = sequentialHex.map(toLinear);
export const sequentialCss = `linear-gradient(90deg, ${sequentialHex.join(', ')})`;
export const awakeHex = '#e69f00';
export const asleepHex = '#2f6fbf';
export const fixedHex = '#666b72';
export const noneHex = '#a9afb7';
export const awakeColour = toLinear(awakeHex);
export const asleepColour = toLinear(asleepHex);
export const fixedColour = toLinear(fixedHex);
export const noneColour = toLinear(noneHex);
export const paint: Rgb[] = paintHex.map(toLinear);

/** For the stages of the time step, in their order; neighbours differ most. */
export const stageHex = ['#c0c5c9', '#5db9ef', '#0d73b4', '#6d3c67', '#e7a002', '#73ae86', '#d15c00', '#c172a1', '#e6da68'];
/** For up to three lines of a chart. */
export const seriesHex = ['#0983cf', '#e69f00', '#a14278'];
/** For what is drawn over the bodies. */
export const overlayHex = {
  points: '#d45d00', normals: '#17639f', impulses: '#18986a', friction: '#de96cb', moves: '#eba208', bounds: '#78828d',
  joints: '#7941c8', outline: '#2eb0ff',
};

export function toLinear(hex: string): Rgb {
  const c = new Color(hex);
  return [c.r, c.g, c.b];
}

/** The colour of a material without a pattern. @param index of the material */
export function paintOf(name: string, index: number): Rgb {
  const named = namedPaintHex.find(([words]) => words.test(name.toLowerCase()));
  return named ? toLinear(named[1]) : paint[index % paint.length];
}

/** A colour for a thing without order, such as a batch. */
export function categorical(index: number): Rgb {
  let h = Math.imul(index ^ 0x9e3779b9, 0x85ebca6b);
  h ^= h >>> 13;
  return qualitative[(h >>> 0) % qualitative.length];
}

/** @param part 0 to 1 */
export function sequential(part: number, out: Rgb): Rgb {
  const at = Math.min(0.9999, Math.max(0, part)) * (sequentialColours.length - 1);
  const i = Math.floor(at), f = at - i;
  const a = sequentialColours[i], b = sequentialColours[i + 1];
  for (let k = 0; k < 3; k++) out[k] = a[k] + f * (b[k] - a[k]);
  return out;
}
