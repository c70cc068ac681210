/** Colours that people with any kind of colour vision can tell apart. All linear RGB in 0 to 1 after `toLinear`. */
import { Color } from 'three';

export type Rgb = [number, number, number];

/** Okabe and Ito's set, with lighter and darker tints of it, for things that have no order. */
const qualitativeHex = [
  '#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#b8a800', '#7a5195', '#5ba98a', '#a3683b',
  '#4a7fc1', '#c9a26b',
];
/** For quantities: blue over grey to yellow like cividis, but no darker than shaded bodies can bear. */
const sequentialHex = ['#2b5fae', '#4c78b4', '#6f8fb4', '#93a3a9', '#b5b08c', '#d5bf63', '#f4d838'];

export const qualitative: Rgb[] = qualitativeHex.map(toLinear);
const sequentialColours: Rgb[] = sequentialHex.map(toLinear);
export const sequentialCss = `linear-gradient(90deg, ${sequentialHex.join(', ')})`;
export const awakeHex = '#e69f00';
export const asleepHex = '#3f6f9f';
export const fixedHex = '#8b9098';
export const awakeColour = toLinear(awakeHex);
export const asleepColour = toLinear(asleepHex);
export const fixedColour = toLinear(fixedHex);
export const noneColour = toLinear('#9aa0a8');

/** For the stages of the time step, in their order; neighbours differ in lightness. */
export const stageHex = ['#9aa0a8', '#56b4e9', '#0072b2', '#7a5195', '#e69f00', '#5ba98a', '#d55e00', '#cc79a7', '#b8a800'];

export function toLinear(hex: string): Rgb {
  const c = new Color(hex);
  return [c.r, c.g, c.b];
}

/** A colour for a thing without order, such as a batch. */
export function categorical(index: number): Rgb {
  let h = Math.imul(index ^ 0x9e3779b9, 0x85ebca6b);
  h ^= h >>> 13;
  return qualitative[(h >>> 0) % qualitative.length];
}

export function categoricalHex(index: number): string {
  return qualitativeHex[index % qualitativeHex.length];
}

/** @param part 0 to 1 */
export function sequential(part: number, out: Rgb): Rgb {
  const at = Math.min(0.9999, Math.max(0, part)) * (sequentialColours.length - 1);
  const i = Math.floor(at), f = at - i;
  const a = sequentialColours[i], b = sequentialColours[i + 1];
  for (let k = 0; k < 3; k++) out[k] = a[k] + f * (b[k] - a[k]);
  return out;
}
