/** Which layers are drawn, and what their colours mean. */
import type { ColourMode, ViewOptions } from '../model';
import { asleepHex, awakeHex, fixedHex, noneHex, overlayHex, qualitativeHex, sequentialCss } from '../view/palette';
import { h, quantity } from './dom';

interface Choice<T> { key: T; label: string; hint: string; shortcut?: string; swatch?: string }

export const colourModes: Choice<ColourMode>[] = [
  { key: 'material', label: 'Material', hint: 'Oak, iron, granite', shortcut: '1' },
  { key: 'batch', label: 'Batch', hint: 'Bodies that contacts connect share a colour', shortcut: '2' },
  { key: 'asleep', label: 'Asleep or awake', hint: 'Which bodies the sleeping system has put to rest', shortcut: '3' },
  { key: 'speed', label: 'Speed', hint: 'Of the centre of mass', shortcut: '4' },
  { key: 'overlap', label: 'Overlap', hint: 'Largest overlap of the contacts of a body', shortcut: '5' },
  { key: 'level', label: 'Hierarchy level', hint: 'Of the grids of the broad phase', shortcut: '6' },
  { key: 'stage', label: 'Shock stage', hint: 'The order in which the shock propagation froze the bodies in the last step', shortcut: '7' },
];

type Switch = Exclude<keyof ViewOptions, 'colour'>;

export const switches: Choice<Switch>[] = [
  { key: 'points', label: 'Contact points', hint: 'Where bodies touch', shortcut: 'C', swatch: overlayHex.points },
  { key: 'normals', label: 'Normals', hint: 'Of the contacts, from B to A', shortcut: 'N', swatch: overlayHex.normals },
  { key: 'impulses', label: 'Impulses', hint: 'Along the normal, in the last step; a line twice as long is an impulse four times as large', shortcut: 'I', swatch: overlayHex.impulses },
  { key: 'friction', label: 'Friction', hint: 'Impulses along the surface, in the last step', shortcut: 'K', swatch: overlayHex.friction },
  { key: 'moves', label: 'Correction moves', hint: 'Of the penetration correction in the last step, drawn 100 times as long', shortcut: 'M', swatch: overlayHex.moves },
  { key: 'bounds', label: 'Bounding boxes', hint: 'As the broad phase sees them', shortcut: 'B', swatch: overlayHex.bounds },
  { key: 'joints', label: 'Joints', hint: 'Where bodies are joined, with rods, ropes and the axes of hinges and sliders', shortcut: 'J', swatch: overlayHex.joints },
  { key: 'laws', label: 'Laws of motion', hint: 'Where bodies go, swing and turn by a law, and how belts run', shortcut: 'L', swatch: overlayHex.moves },
  { key: 'rays', label: 'Rays', hint: 'Cast from the camera as it is now, with the normals where they hit; look from elsewhere to see them', shortcut: 'Y', swatch: overlayHex.outline },
  { key: 'shadows', label: 'Shadows', hint: 'Of the sun', shortcut: 'S' },
  { key: 'grid', label: 'Grid', hint: 'The scale of its lines stands below the picture', shortcut: 'G' },
];

/** What a recording holds. */
const recorded = ['material', 'asleep', 'speed', 'joints', 'laws', 'shadows', 'grid'];
/** And what it holds besides if contacts were recorded. */
const recordedContacts = ['points', 'normals', 'impulses', 'friction'];

export class LayersPanel {
  readonly element = h('div', { class: 'layers' });

  constructor(private readonly options: ViewOptions, private readonly changed: () => void) {}

  /** @param replay what kind of recording is shown; undefined = a live world */
  build(replay?: { contacts: boolean }): void {
    const held = new Set(replay?.contacts ? [...recorded, ...recordedContacts] : recorded);
    const off = (key: string): boolean => replay !== undefined && !held.has(key);
    const colours = h('fieldset', { class: 'choices' }, h('legend', {}, 'Colour by'));
    for (const mode of colourModes) {
      const input = h('input', { type: 'radio', name: 'colour', value: mode.key, id: `colour-${mode.key}`, disabled: off(mode.key) });
      input.checked = this.options.colour === mode.key;
      input.addEventListener('change', () => {
        this.options.colour = mode.key;
        this.changed();
      });
      colours.append(this.row(input, mode));
    }
    const layers = h('fieldset', { class: 'choices' }, h('legend', {}, 'Show'));
    for (const layer of switches) {
      const input = h('input', { type: 'checkbox', id: `layer-${layer.key}`, disabled: off(layer.key) });
      input.checked = this.options[layer.key];
      input.addEventListener('change', () => {
        this.options[layer.key] = input.checked;
        this.changed();
      });
      layers.append(this.row(input, layer));
    }
    this.element.replaceChildren(colours, layers);
    if (replay) this.element.append(h('p', { class: 'note' }, 'Greyed layers need a live world: recordings hold poses, velocities and sleep, and contacts on request.'));
  }

  /** @return false if the view has no such layer */
  toggle(key: Switch): void { this.click(`layer-${key}`); }
  choose(key: ColourMode): void { this.click(`colour-${key}`); }

  private click(id: string): void {
    (this.element.querySelector(`#${id}`) as HTMLInputElement | null)?.click();
  }

  private row(input: HTMLInputElement, choice: Choice<string>): HTMLElement {
    const hint = input.disabled ? 'The recording does not hold this' : choice.hint;
    return h('label', { class: input.disabled ? 'row off' : 'row', title: hint },
      input, h('span', {}, choice.swatch ? h('i', { class: 'swatch', style: `background:${choice.swatch}` }) : null, choice.label),
      choice.shortcut ? h('kbd', {}, choice.shortcut) : null);
  }
}

/** What the colours of the bodies mean now. @param maximum of a quantity, in SI units */
export function legendFor(mode: ColourMode, maximum: number): HTMLElement | null {
  const swatch = (colour: string, text: string): HTMLElement => h('span', { class: 'entry' }, h('i', { style: `background:${colour}` }), text);
  switch (mode) {
    case 'material': return null;
    case 'asleep': return h('div', {}, swatch(awakeHex, 'awake'), swatch(asleepHex, 'asleep'), swatch(fixedHex, 'fixed'));
    case 'batch': return h('div', {}, h('span', { class: 'entry' }, 'One colour per batch'), swatch(noneHex, 'no contacts'), swatch(fixedHex, 'fixed'));
    case 'speed':
    case 'overlap':
      return h('div', {}, h('span', { class: 'entry' }, '0'), h('span', { class: 'ramp', style: `background:${sequentialCss}` }),
        h('span', { class: 'entry' }, mode === 'speed' ? quantity(maximum, 'm/s') : quantity(maximum, 'm')));
    case 'level':
    case 'stage':
      return h('div', {}, ...[0, 1, 2, 3, 4].map((i) => swatch(qualitativeHex[i], i === 4 ? '4 …' : String(i))), swatch(noneHex, 'none'));
  }
}
