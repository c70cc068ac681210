/** The frame of the page: canvas, top bar, side panel with tabs, transport bar, legend, hints and messages. */
import { h, iconButton, setIcon, setText } from './dom';

export type Tab = 'view' | 'settings' | 'charts' | 'bodies';

const tabTitles: Record<Tab, string> = { view: 'View', settings: 'Settings', charts: 'Charts', bodies: 'Bodies' };

export interface ShellActions {
  theme(): void;
  camera(): void;
  help(): void;
  picture(): void;
  tab(tab: Tab): void;
}

export class Shell {
  readonly canvasHolder = h('main', { class: 'holder' });
  readonly title = h('div', { class: 'title' });
  readonly status = h('div', { class: 'status', id: 'status', role: 'status' });
  readonly pictures = h('div', { class: 'status pictures', id: 'pictures' });
  readonly transport = h('div', { class: 'transport' });
  readonly legend = h('div', { class: 'legend', id: 'legend' });
  readonly labels = h('div', { class: 'labels' });
  private readonly toasts = h('div', { class: 'toasts', role: 'alert' });
  private readonly hint = h('div', { class: 'hint' });
  private readonly panel = h('aside', { class: 'panel', id: 'panel', 'aria-label': 'Settings and measurements' });
  private readonly pages = new Map<Tab, HTMLElement>();
  private readonly tabs = new Map<Tab, HTMLButtonElement>();
  private readonly panelButton: HTMLButtonElement;
  active: Tab = 'view';

  constructor(root: HTMLElement, private readonly actions: ShellActions) {
    this.panelButton = iconButton('panel', 'Panel (P)', () => this.togglePanel(), 'panel-button');
    const bar = h('header', { class: 'topbar' }, this.title, this.status, this.pictures, h('div', { class: 'tools' },
      iconButton('camera', 'Show everything (0)', actions.camera, 'camera-button'),
      iconButton('picture', 'Save a picture', actions.picture, 'picture-button'),
      iconButton('theme', 'Dark or light (D)', actions.theme, 'theme-button'),
      iconButton('help', 'Help (H)', actions.help, 'help-button'), this.panelButton));
    root.append(this.canvasHolder, this.labels, bar, this.panel, h('div', { class: 'below' }, this.hint, this.legend, this.transport), this.toasts);
    if (window.innerWidth < 760) document.body.classList.add('panel-closed');
  }

  setPages(pages: Partial<Record<Tab, HTMLElement>>): void {
    const strip = h('nav', { class: 'tabs', role: 'tablist' });
    const body = h('div', { class: 'pages' });
    this.pages.clear();
    this.tabs.clear();
    for (const [tab, page] of Object.entries(pages) as [Tab, HTMLElement][]) {
      const button = h('button', { type: 'button', role: 'tab', id: `tab-${tab}`, onclick: () => this.open(tab) }, tabTitles[tab]);
      strip.append(button);
      body.append(page);
      this.pages.set(tab, page);
      this.tabs.set(tab, button);
    }
    this.panel.replaceChildren(strip, body);
    this.open(this.pages.has(this.active) ? this.active : [...this.pages.keys()][0], false);
  }

  open(tab: Tab, show = true): void {
    this.active = tab;
    for (const [name, page] of this.pages) page.hidden = name !== tab;
    for (const [name, button] of this.tabs) button.setAttribute('aria-selected', String(name === tab));
    if (show) document.body.classList.remove('panel-closed');
    this.actions.tab(tab);
  }

  get panelOpen(): boolean { return !document.body.classList.contains('panel-closed'); }

  togglePanel(): void {
    document.body.classList.toggle('panel-closed');
    this.actions.tab(this.active);
  }

  showHint(text: string): void {
    setText(this.hint, text);
    this.hint.classList.add('shown');
    setTimeout(() => this.hint.classList.remove('shown'), 9000);
  }

  hideHint(): void { this.hint.classList.remove('shown'); }

  /** Says something for a few seconds. */
  say(text: string, kind: 'error' | 'info' = 'info'): void {
    for (const old of [...this.toasts.children]) if (old.textContent === text) old.remove();
    const toast = h('div', { class: `toast ${kind}` }, text);
    this.toasts.append(toast);
    while (this.toasts.children.length > 3) this.toasts.firstElementChild?.remove();
    setTimeout(() => toast.remove(), kind === 'error' ? 9000 : 4000);
  }

  showPictures(perSecond: number): void { setText(this.pictures, `${Math.round(perSecond) || '–'} pictures/s`); }

  showPlaying(button: HTMLButtonElement, playing: boolean): void {
    setIcon(button, playing ? 'pause' : 'play', playing ? 'Pause (Space)' : 'Play (Space)');
  }
}
