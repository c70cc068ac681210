/** What is thrown and added, and the state of the selected body. */
import { jointKinds, type MaterialInfo, type ShapeInfo } from '../model';
import type { Selection } from '../protocol';
import { h, quantity, significant } from './dom';

/** What can be added: shapes that fill a cube of the size asked for, as far as they can. */
export const addable = {
  box: { label: 'Box', shape: (size: number): ShapeInfo => ({ type: 'box', size: [size, size, size] }) },
  sphere: { label: 'Ball', shape: (size: number): ShapeInfo => ({ type: 'sphere', radius: size / 2 }) },
  capsule: { label: 'Capsule', shape: (size: number): ShapeInfo => ({ type: 'capsule', radius: size / 4, length: size / 2 }) },
  cylinder: { label: 'Cylinder', shape: (size: number): ShapeInfo => ({ type: 'cylinder', radius: size / 2, length: size }) },
};
export type Addable = keyof typeof addable;

export interface BodyActions {
  throwBall(): void;
  add(shape: Addable): void;
  freeze(): void;
  remove(): void;
  deselect(): void;
}

/** What the user set for thrown and added bodies. */
export interface Ammunition { radius: number; speed: number; material: string; size: number }

export class BodiesPanel {
  readonly element = h('div', { class: 'bodies' });
  private readonly diameter = number('throw-diameter', 26.4, 1, 500, 0.1);
  private readonly speed = number('throw-speed', 12, 0, 200, 0.5);
  private readonly size = number('add-size', 20, 1, 500, 1);
  private readonly throwMaterial = h('select', { id: 'throw-material' });
  private readonly addMaterial = h('select', { id: 'add-material' });
  private readonly card = h('section', { class: 'card', id: 'body-card' });
  private readonly tools = h('div', {});
  private shown = '';

  constructor(private readonly actions: BodyActions) {
    const add = ([shape, { label }]: [string, { label: string }]): HTMLElement =>
      h('button', { type: 'button', id: `add-${shape}`, onclick: () => actions.add(shape as Addable) }, label);
    this.tools.append(
      h('fieldset', {}, h('legend', {}, 'Throw'),
        field('Diameter', 'cm', this.diameter), field('Speed', 'm/s', this.speed), field('Material', '', this.throwMaterial),
        h('div', { class: 'buttons' }, h('button', { type: 'button', class: 'strong', onclick: () => actions.throwBall() }, 'Throw a ball'))),
      h('fieldset', {}, h('legend', {}, 'Add'),
        field('Size', 'cm', this.size), field('Material', '', this.addMaterial),
        h('div', { class: 'buttons' }, ...Object.entries(addable).map(add))));
    this.element.append(this.card, this.tools);
    this.showNothing(true);
  }

  setReplay(): void { this.tools.remove(); }

  get ammunition(): Ammunition {
    return {
      radius: clamp(this.diameter) / 200, speed: clamp(this.speed), material: this.throwMaterial.value, size: clamp(this.size) / 100,
    };
  }

  get addedMaterial(): string { return this.addMaterial.value; }

  setMaterials(materials: MaterialInfo[]): void {
    for (const [select, wanted] of [[this.throwMaterial, 'iron'], [this.addMaterial, 'oak']] as const) {
      const chosen = select.value || wanted;
      const names = materials.map((material) => material.name);
      select.replaceChildren(...names.map((name) => h('option', { value: name }, name)));
      select.value = names.includes(chosen) ? chosen : names.includes(wanted) ? wanted : names[0] ?? '';
    }
  }

  showNothing(force = false): void {
    if (this.shown === '' && !force) return;
    this.shown = '';
    this.card.replaceChildren(h('h3', {}, 'No body selected'), h('p', { class: 'note' }, 'Click a body to read its state, contacts and batch.'));
  }

  /** @param live whether the body can be changed */
  show(selection: Selection, live: boolean): void {
    const id = `${selection.body?.slot}:${selection.body?.generation}:${live}`;
    if (this.shown !== id) {
      this.shown = id;
      this.card.replaceChildren(
        h('header', {}, h('h3', { id: 'body-name' }), live ? h('span', { class: 'buttons' },
          h('button', { type: 'button', id: 'body-freeze', onclick: () => this.actions.freeze() }, 'Freeze'),
          h('button', { type: 'button', id: 'body-delete', onclick: () => this.actions.remove() }, 'Delete')) : null),
        h('table', { class: 'state', id: 'body-state' }), h('div', { id: 'body-joints' }), h('div', { id: 'body-contacts' }));
    }
    this.card.querySelector('#body-name')!.textContent = selection.name;
    const freeze = this.card.querySelector('#body-freeze');
    if (freeze) freeze.textContent = selection.fixed ? 'Unfreeze' : 'Freeze';
    const rows: [string, string, string][] = [
      ['shape', 'Shape', selection.shape],
      ['material', 'Material', selection.material],
      ['mass', 'Mass', selection.mass === null ? 'fixed' : quantity(selection.mass * 1000, 'g')],
      ['position', 'Position', `${triple(selection.position)} m`],
      ['orientation', 'Orientation', triple(selection.orientation)],
      ['velocity', 'Velocity', `${triple(selection.velocity)} m/s`],
      ['spin', 'Spin', `${triple(selection.spin)} rad/s`],
      ['asleep', 'State', selection.fixed ? 'fixed' : selection.asleep ? 'asleep' : 'awake'],
    ];
    if (selection.batch) rows.push(['batch', 'Batch', `${selection.batch.index}: ${counted(selection.batch.bodies, 'body', 'bodies')}, ${counted(selection.batch.contacts, 'contact')}`]);
    const table = this.card.querySelector('#body-state')!;
    table.replaceChildren(...rows.map(([key, label, text]) =>
      h('tr', {}, h('th', { scope: 'row' }, label), h('td', { 'data-key': key }, text))));
    if (!live) return;
    this.showJoints(selection.joints);
    const contacts = this.card.querySelector('#body-contacts')!;
    const shownContacts = selection.contacts.slice(0, 12);
    const rest = selection.contacts.length - shownContacts.length;
    contacts.replaceChildren(h('h4', {}, counted(selection.contacts.length, 'contact')));
    if (shownContacts.length === 0) return;
    contacts.append(h('table', { class: 'contacts' },
      h('tr', {}, h('th', {}, 'with'), h('th', {}, 'distance'), h('th', {}, 'impulse')),
      ...shownContacts.map((contact) => h('tr', {}, h('td', {}, contact.other), h('td', {}, quantity(contact.distance, 'm')),
        h('td', {}, quantity(Math.hypot(...contact.impulse), 'N·s'))))));
    if (rest > 0) contacts.append(h('p', { class: 'note' }, `and ${rest} more`));
  }

  private showJoints(joints: Selection['joints']): void {
    const place = this.card.querySelector('#body-joints')!;
    place.replaceChildren();
    if (joints.length === 0) return;
    place.append(h('h4', {}, counted(joints.length, 'joint')), h('table', { class: 'contacts' },
      h('tr', {}, h('th', {}, 'kind'), h('th', {}, 'with'), h('th', {}, 'force'), h('th', {}, 'torque')),
      ...joints.map((joint) => h('tr', {}, h('td', {}, jointKinds[joint.kind]), h('td', {}, joint.other),
        h('td', {}, quantity(joint.force, 'N')), h('td', {}, quantity(joint.torque, 'N·m'))))));
  }
}

function number(id: string, value: number, min: number, max: number, step: number): HTMLInputElement {
  return h('input', { type: 'number', id, value, min, max, step });
}

function field(label: string, unit: string, control: HTMLElement): HTMLElement {
  return h('label', { class: 'row', for: control.id }, h('span', {}, label, h('small', {}, unit)), control);
}

function clamp(input: HTMLInputElement): number {
  const value = Number(input.value);
  const fallback = Number(input.defaultValue);
  return Math.min(Number(input.max), Math.max(Number(input.min), Number.isFinite(value) && input.value !== '' ? value : fallback));
}

function counted(count: number, one: string, many = `${one}s`): string {
  return `${count} ${count === 1 ? one : many}`;
}

function triple(values: number[]): string {
  return values.map((v) => (Math.abs(v) < 5e-7 ? '0' : significant(v, 4))).join(', ');
}
