/** The overlay that says how to use the page. */
import { h } from './dom';
import { colourModes, switches } from './layers';

const pointer: [string, string][] = [
  ['Drag a body', 'pull it on a spring; the wheel moves it nearer or farther'],
  ['Click a body', 'read its state, contacts and batch'],
  ['Drag the background', 'look around (two fingers or the right button: move; wheel or pinch: zoom)'],
];
const live: [string, string][] = [
  ['Space', 'play or pause'], ['.', 'one time step'], [',', 'one simulation step (1/30 s)'], ['R', 'reset the scene'],
  ['T', 'throw a ball to where the pointer is'], ['A', 'add a box'], ['F', 'freeze the selected body, or let it go'], ['Delete', 'delete the selected body'],
];
const replay: [string, string][] = [['Space', 'play or pause'], ['← →', 'one frame back or on'], ['R', 'back to the beginning']];
const view: [string, string][] = [
  ['[ ]', 'slower, faster'], ['0', 'show everything'], ['D', 'dark or light'], ['P', 'panel on or off'], ['H or ?', 'this help'], ['Esc', 'close, deselect'],
];

function list(title: string, rows: [string, string][]): HTMLElement {
  return h('section', {}, h('h3', {}, title), h('dl', {}, ...rows.flatMap(([key, text]) => [h('dt', {}, h('kbd', {}, key)), h('dd', {}, text)])));
}

export class Help {
  readonly element = h('dialog', { id: 'help', 'aria-label': 'Help' });

  build(isLive: boolean): void {
    const layers: [string, string][] = [
      [`${colourModes[0].shortcut} to ${colourModes.at(-1)!.shortcut}`, 'colour by material, batch, sleep, speed, overlap, level, shock stage'],
      ...switches.filter((s) => s.shortcut).map((s): [string, string] => [s.shortcut!, s.label.toLowerCase()]),
    ];
    this.element.replaceChildren(
      h('header', {}, h('h2', {}, 'How to use it'), h('button', { type: 'button', onclick: () => this.element.close() }, 'Close')),
      h('div', { class: 'columns' },
        h('section', {}, h('h3', {}, 'With the pointer'), h('ul', {}, ...pointer.filter(([key]) => isLive || key !== 'Drag a body')
          .map(([key, text]) => h('li', {}, h('b', {}, key), `: ${text}`)))),
        list(isLive ? 'The simulation' : 'The recording', isLive ? live : replay), list('The view', view), list('Layers', layers)));
    this.element.addEventListener('click', (event) => {
      if (event.target === this.element) this.element.close();
    });
  }

  toggle(): void {
    if (this.element.open) this.element.close(); else this.element.showModal();
  }
}
