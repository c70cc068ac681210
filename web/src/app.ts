/** What live worlds and recordings have in common: stage, shell, layers, charts, theme, shortcuts, the picture loop. */
import { defaultOptions, type ViewOptions } from './model';
import { Stage } from './view/stage';
import type { Theme } from './view/panel';
import { Charts, type ChartData } from './ui/charts';
import { Help } from './ui/help';
import { colourModes, LayersPanel, legendFor, switches } from './ui/layers';
import { Shell, type Tab } from './ui/shell';
import { h, setText, significant } from './ui/dom';

export interface Mode {
  /** once per picture, before it is drawn. @param seconds since the last one */
  advance(seconds: number): void;
  optionsChanged(): void;
  chartData(): ChartData;
  /** @return true if the key was for it */
  key(key: string): boolean;
}

export class App {
  readonly options: ViewOptions = { ...defaultOptions };
  readonly shell: Shell;
  readonly stage: Stage;
  readonly layers: LayersPanel;
  readonly charts = new Charts();
  readonly help = new Help();
  readonly about = h('div', { class: 'about' });
  theme: Theme = 'light';
  mode: Mode | null = null;
  private lastTick = 0;
  private lastCharts = 0;
  private legendKey = '';

  constructor(root: HTMLElement) {
    this.shell = new Shell(root, {
      theme: () => this.setTheme(this.theme === 'light' ? 'dark' : 'light'),
      camera: () => this.stage.frameAll(),
      help: () => this.help.toggle(),
      picture: () => void this.savePicture(),
      tab: () => { this.lastCharts = 0; },
    });
    this.stage = new Stage(this.shell.canvasHolder);
    this.layers = new LayersPanel(this.options, () => this.optionsChanged());
    root.append(this.help.element);
    const wished = new URLSearchParams(location.search).get('theme') ?? stored('cairn-theme');
    const dark = wished ? wished === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    this.setTheme(dark ? 'dark' : 'light');
    window.addEventListener('keydown', (event) => this.onKey(event));
  }

  start(mode: Mode): void {
    this.mode = mode;
    const tick = (now: number): void => {
      requestAnimationFrame(tick);
      const seconds = Math.min(0.25, (now - this.lastTick) / 1000);
      this.lastTick = now;
      mode.advance(seconds);
      this.stage.render(now);
      if (now - this.lastCharts > 200) {
        this.lastCharts = now;
        this.updateLegend();
        if (this.shell.panelOpen && this.shell.active === 'charts') this.charts.draw(mode.chartData());
      }
    };
    requestAnimationFrame(tick);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.stage.setTheme(theme);
    store('cairn-theme', theme);
    this.lastCharts = 0;
  }

  optionsChanged(): void {
    this.stage.shadows = this.options.shadows;
    for (const panel of this.stage.panels) if (panel.frame) panel.setFrame(panel.frame, this.options);
    this.mode?.optionsChanged();
    this.updateLegend();
    this.stage.touch();
  }

  /** @param replay what kind of recording is shown; undefined = a live world */
  setPages(pages: Partial<Record<Tab, HTMLElement>>, replay?: { contacts: boolean }): void {
    this.layers.build(replay);
    this.help.build(!replay);
    this.shell.setPages({ view: h('div', {}, this.layers.element, this.about), ...pages });
  }

  setAbout(lines: [string, string, string][]): void {
    if (this.about.children.length === 0) this.about.append(h('fieldset', {}, h('legend', {}, 'This run'), h('table', { class: 'state' })));
    const table = this.about.querySelector('table')!;
    const key = lines.map((line) => line[0]).join();
    if (table.dataset.key !== key) {
      table.dataset.key = key;
      table.replaceChildren(...lines.map(([id, label]) => h('tr', {}, h('th', { scope: 'row' }, label), h('td', { id: `run-${id}` }))));
    }
    for (const [id, , text] of lines) setText(table.querySelector(`#run-${id}`)!, text);
  }

  private updateLegend(): void {
    const [panel] = this.stage.panels;
    const maximum = panel.bodies.range.maximum;
    const step = this.options.grid ? panel.gridStep : 0;
    const key = `${this.options.colour}:${maximum}:${step}`;
    if (key === this.legendKey) return;
    this.legendKey = key;
    const legend = legendFor(this.options.colour, maximum);
    this.shell.legend.replaceChildren(...(legend ? [legend] : []), ...(step > 0 ? [h('div', { id: 'scale' }, `Grid ${length(step)}, fine ${length(step / 10)}`)] : []));
  }

  private async savePicture(): Promise<void> {
    this.stage.draw();
    const blob = await this.stage.toBlob('image/png', 1);
    const link = h('a', { href: URL.createObjectURL(blob), download: 'cairn.png' });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    const typing = target instanceof HTMLInputElement && !['checkbox', 'radio', 'range'].includes(target.type);
    if (typing || target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey || event.altKey) return;
    if (this.handleKey(event.key)) {
      event.preventDefault();
      // A focused button must not be pressed by the space bar as well.
      if (event.key === ' ' && target instanceof HTMLButtonElement) target.blur();
    }
  }

  private handleKey(key: string): boolean {
    const letter = key.toUpperCase();
    if (this.help.element.open) {
      if (letter !== 'H' && key !== '?') return false;
      this.help.toggle();
      return true;
    }
    if (this.mode?.key(key)) return true;
    const colour = colourModes.find((mode) => mode.shortcut === key);
    const layer = switches.find((s) => s.shortcut === letter);
    if (colour) this.layers.choose(colour.key);
    else if (layer) this.layers.toggle(layer.key);
    else if (key === '0') this.stage.frameAll();
    else if (letter === 'D') this.setTheme(this.theme === 'light' ? 'dark' : 'light');
    else if (letter === 'P') this.shell.togglePanel();
    else if (letter === 'H' || key === '?') this.help.toggle();
    else return false;
    return true;
  }
}

function length(metres: number): string {
  return metres >= 1 ? `${significant(metres)} m` : `${significant(100 * metres)} cm`;
}

/** Storage is refused in some files opened from disk; nothing important is kept there. */
function stored(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

function store(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Then the choice lasts as long as the page.
  }
}
