/** The dial between performance and accuracy, and every setting with its unit and range. */
import type { FieldInfo, State, Value } from '../protocol';
import { h, readable, setText } from './dom';

const stageTitles: Record<string, string> = {
  world: 'Time step', time: 'Time step', detection: 'Contact detection', correction: 'Penetration correction', resolution: 'Contact resolution',
  sleep: 'Sleeping', integration: 'Integration', parallel: 'Threads',
};

export interface SettingsActions {
  setDial(value: number): void;
  setField(name: string, value: Value): void;
}

export class SettingsPanel {
  readonly element = h('div', { class: 'settings' });
  private readonly dial = h('input', {
    type: 'range', min: 0, max: 1, step: 0.01, id: 'dial', 'aria-label': 'Between performance and accuracy',
  });
  private readonly dialNote = h('p', { class: 'note', id: 'dial-note' });
  private readonly controls = new Map<string, HTMLInputElement | HTMLSelectElement>();
  private fields: FieldInfo[] = [];

  constructor(private readonly actions: SettingsActions) {
    this.dial.addEventListener('change', () => actions.setDial(Number(this.dial.value)));
    this.dial.addEventListener('input', () => this.describeDial(Number(this.dial.value)));
  }

  setFields(fields: FieldInfo[]): void {
    this.fields = fields;
    this.controls.clear();
    const stop = (value: number, name: string): HTMLElement =>
      h('button', { class: 'link', type: 'button', id: `preset-${name}`, onclick: () => this.actions.setDial(value) }, name);
    const parts: HTMLElement[] = [
      h('section', { class: 'dial' }, h('div', { class: 'dial-ends' }, stop(0, 'performance'), stop(1, 'accuracy')), this.dial, this.dialNote),
    ];
    const stages = [...new Set(fields.map((field) => field.stage))];
    for (const stage of stages) {
      const group = h('fieldset', {}, h('legend', {}, stageTitles[stage] ?? title(stage)));
      for (const field of fields) if (field.stage === stage) group.append(this.row(field));
      parts.push(group);
    }
    this.element.replaceChildren(...parts);
  }

  show(state: State): void {
    if (document.activeElement !== this.dial) {
      this.dial.value = String(state.dial ?? 0.5);
      this.describeDial(state.dial);
    }
    this.dial.classList.toggle('off', state.dial === null);
    for (const field of this.fields) {
      const control = this.controls.get(field.name);
      const value = state.settings[field.name];
      if (!control || value === undefined || document.activeElement === control) continue;
      if (control instanceof HTMLInputElement && control.type === 'checkbox') control.checked = value === true;
      else control.value = typeof value === 'number' ? String(Number(value.toPrecision(6))) : String(value);
    }
  }

  /** Takes back what was refused. */
  refuse(): void {
    const active = document.activeElement;
    if (active instanceof HTMLElement && this.element.contains(active)) active.blur();
  }

  private describeDial(value: number | null): void {
    let text = 'Own settings: not a point of the dial.';
    if (value === 0) text = 'The preset for real time.';
    else if (value === 1) text = 'The preset for accuracy.';
    else if (value !== null) text = `${Math.round(100 * value)} % of the way to accuracy; thresholds and steps in between.`;
    setText(this.dialNote, text);
  }

  private row(field: FieldInfo): HTMLElement {
    const label = field.name.replaceAll('_', ' ');
    const id = `field-${field.name}`;
    let control: HTMLInputElement | HTMLSelectElement;
    if (field.kind === 'switch') {
      control = h('input', { type: 'checkbox', id });
      control.addEventListener('change', () => this.actions.setField(field.name, (control as HTMLInputElement).checked));
    } else if (field.kind === 'choice') {
      control = h('select', { id }, ...field.choices.map((c) => h('option', { value: c }, c.replaceAll('_', ' '))));
      control.addEventListener('change', () => this.actions.setField(field.name, control.value));
    } else {
      control = h('input', { type: 'number', id, step: field.kind === 'whole' ? 1 : 'any', min: field.minimum, max: field.maximum });
      control.addEventListener('change', () => {
        if (control.value !== '' && Number.isFinite(Number(control.value))) this.actions.setField(field.name, Number(control.value));
      });
    }
    this.controls.set(field.name, control);
    const hint = `${field.meaning}${rangeOf(field) ? ` (${rangeOf(field)})` : ''}`;
    return h('label', { class: 'row', title: hint, for: id },
      h('span', {}, label, h('small', {}, [field.unit, rangeOf(field)].filter(Boolean).join(' · '))), control);
  }
}

function title(stage: string): string {
  return stage.charAt(0).toUpperCase() + stage.slice(1).replaceAll('_', ' ');
}

function rangeOf(field: FieldInfo): string {
  if (field.kind !== 'whole' && field.kind !== 'number') return '';
  if (field.minimum !== null && field.minimum > 0 && field.minimum < 1e-300) {
    return `above 0${field.maximum === null || field.maximum > 1e15 ? '' : `, up to ${readable(field.maximum)}`}`;
  }
  const from = field.minimum === null ? '−∞' : readable(field.minimum);
  return `${from} to ${field.maximum === null || field.maximum > 1e15 ? '∞' : readable(field.maximum)}`;
}
