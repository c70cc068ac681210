/** A running simulation: shows what the server sends and sends what the user does. */
import { Vector3 } from 'three';
import type { App, Mode } from './app';
import { Connection } from './connection';
import { layersFor, type Frame, type Roster, type Sample } from './model';
import type { BodiesMessage, Hello, Selection, State, TextMessage, Value, WorldMessage } from './protocol';
import type { ChartData } from './ui/charts';
import { addable, BodiesPanel, type Addable } from './ui/bodies';
import { Dragging } from './ui/drag';
import { h, iconButton, quantity, setText, significant } from './ui/dom';
import { SettingsPanel } from './ui/settings';
import { planesOf } from './view/ground';
import { nearest, type Hit } from './view/pick';
import { shotAlong } from './view/throw';

const shownSeconds = 12;
const rayColumns = 16, rayRows = 9;
const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8];

export class Live implements Mode {
  roster: Roster | null = null;
  state: State | null = null;
  selection: Selection | null = null;
  samples: Sample[] = [];
  frames = 0;
  private latest: Frame | null = null;
  private undrawn = 0;
  private framed = false;
  private castsRays = false;
  private lastFollowed: string | null = null;
  private readonly connection: Connection;
  private readonly dragging: Dragging;
  private readonly settings: SettingsPanel;
  private readonly bodies: BodiesPanel;
  private readonly playButton: HTMLButtonElement;
  private readonly scenePicker = h('select', { id: 'scene', 'aria-label': 'Scene' });
  private readonly speedSlider = h('input', { type: 'range', id: 'speed', min: 0, max: speeds.length - 1, step: 1, 'aria-label': 'Speed' });
  private readonly speedText = h('output', { for: 'speed' });
  private readonly clock = h('output', { class: 'clock', id: 'clock' });

  constructor(private readonly app: App, connection: Connection, hello: Hello) {
    this.connection = connection;
    this.playButton = iconButton('play', 'Play (Space)', () => this.togglePlay(), 'play');
    this.settings = new SettingsPanel({
      setDial: (value) => this.command({ do: 'dial', value }),
      setField: (name, value: Value) => this.command({ do: 'set', field: name, value }),
    });
    this.bodies = new BodiesPanel({
      throwBall: () => this.throwBall(), add: (shape) => this.add(shape), freeze: () => this.freeze(), remove: () => this.remove(),
      deselect: () => this.select(null),
    });
    this.dragging = new Dragging(app.stage, {
      grab: (hit) => this.grab(hit),
      drag: (target) => this.command({ do: 'drag', target: target.toArray() }),
      release: () => this.command({ do: 'release' }),
      select: (hit) => this.select(hit ? hit.slot : null),
    });
    this.buildBars(hello);
    this.settings.setFields(hello.fields);
    this.app.charts.setFields(hello.sampleFields, hello.stages);
    this.app.setPages({ settings: this.settings.element, charts: this.app.charts.element, bodies: this.bodies.element });
    this.app.shell.showHint(matchMedia('(pointer: coarse)').matches ? 'Drag a body to pull it · tap one to read its state'
      : 'Drag a body to pull it · T throws a ball · R resets · H for help');
    this.optionsChanged();
  }

  // --- messages ---
  onText(message: TextMessage): void {
    switch (message.type) {
      case 'hello':
        this.castsRays = false;
        this.optionsChanged();
        break;
      case 'world': this.setWorld(message); break;
      case 'bodies': this.changeBodies(message); break;
      case 'state': this.setState(message); break;
      case 'selection': this.setSelection(message); break;
      case 'error':
        this.app.shell.say(message.text, 'error');
        this.settings.refuse();
        if (this.state) this.settings.show(this.state);
        this.showScene();
        break;
      default: break;
    }
  }

  onFrame(frame: Frame): void {
    this.latest = frame;
    this.frames++;
    this.undrawn++;
  }

  onSamples(samples: Sample[]): void {
    this.samples.push(...samples);
    const last = this.samples.at(-1)!.time;
    if (this.samples[0].time < last - 4 * shownSeconds) this.samples = this.samples.filter((s) => s.time >= last - 2 * shownSeconds);
  }

  // --- what the page asks of it ---
  advance(): void {
    for (; this.undrawn > 0; this.undrawn--) this.connection.askForFrame();
    if (!this.latest || !this.roster) return;
    const frame = this.latest;
    this.latest = null;
    const panel = this.app.stage.panels[0];
    if (!panel.setFrame(frame, this.app.options)) return;
    if (!this.framed) {
      this.framed = true;
      this.app.stage.frameAll();
    }
    this.app.stage.touch();
    this.showClock(frame.time);
  }

  optionsChanged(): void {
    this.command({ do: 'layers', layers: layersFor(this.app.options) });
    if (this.app.options.rays !== this.castsRays) this.castRays(this.app.options.rays);
  }

  /** Through a grid of points of the picture; they stay where they are while the camera goes on. */
  private castRays(on: boolean): void {
    this.castsRays = on;
    const box = this.app.stage.canvas.getBoundingClientRect();
    const directions: number[][] = [];
    for (let row = 0.5; on && row < rayRows; row++) {
      for (let column = 0.5; column < rayColumns; column++) {
        const { ray } = this.app.stage.rayAt(box.left + (column / rayColumns) * box.width, box.top + (row / rayRows) * box.height);
        directions.push(ray.direction.toArray().map((x) => Math.round(1e5 * x) / 1e5));
      }
    }
    this.command({ do: 'rays', origin: this.app.stage.camera.position.toArray(), directions });
  }

  chartData(): ChartData {
    const to = this.samples.at(-1)?.time ?? 0;
    return { runs: [this.samples], cursor: null, from: Math.max(0, to - shownSeconds), to: Math.max(to, 1) };
  }

  key(key: string): boolean {
    switch (key.length === 1 ? key.toUpperCase() : key) {
      case ' ': this.togglePlay(); return true;
      case '.': this.step(1); return true;
      case ',': this.stepSimulation(); return true;
      case 'R': this.command({ do: 'reset' }); return true;
      case 'T': this.throwBall(); return true;
      case 'A': this.add('box'); return true;
      case 'F': this.freeze(); return true;
      case 'Delete': case 'Backspace': this.remove(); return true;
      case '[': this.changeSpeed(-1); return true;
      case ']': this.changeSpeed(1); return true;
      case 'Escape': this.select(null); return true;
      default: return false;
    }
  }

  command(command: { do: string } & Record<string, unknown>): void { this.connection.send(command); }

  // --- actions ---
  togglePlay(): void { this.command({ do: this.state?.playing ? 'pause' : 'play' }); }
  step(count: number): void { this.command({ do: 'step', count }); }

  private stepSimulation(): void {
    const perSecond = Number(this.state?.settings.steps_per_second ?? 240);
    this.step(Math.max(1, Math.round(perSecond / 30)));
  }

  /** From the camera to where the pointer is, or to the middle of the picture. */
  throwBall(): void {
    const { radius, speed, material } = this.bodies.ammunition;
    const box = this.app.stage.canvas.getBoundingClientRect();
    const over = this.dragging.pointer;
    const at = over && over.x > box.left && over.x < box.right ? over : { x: box.left + box.width / 2, y: box.top + box.height / 2 };
    const { ray, panel } = this.app.stage.rayAt(at.x, at.y);
    if (!panel.roster || !panel.frame) return;
    const aim = Math.min(nearest(ray, panel.roster, panel.frame).distance, 2 * this.app.stage.camera.position.distanceTo(panel.extent.centre));
    const gravity = new Vector3(...(this.state?.gravity ?? [0, 0, 0]));
    const shot = shotAlong(ray, aim, gravity, speed, radius, planesOf(panel.roster, panel.frame));
    this.command({ do: 'throw', origin: shot.origin.toArray(), velocity: shot.velocity.toArray(), radius, material });
    this.app.shell.hideHint();
  }

  add(shape: Addable): void {
    const { size } = this.bodies.ammunition;
    const target = this.app.stage.controls.target;
    const { extent } = this.app.stage.panels[0];
    const position = [target.x, target.y, Math.max(target.z, extent.centre.z) + extent.size + size];
    this.command({ do: 'add', shape: addable[shape].shape(size), material: this.bodies.addedMaterial, position });
  }

  select(slot: number | null): void {
    const body = slot === null ? undefined : this.roster?.bodies.get(slot);
    this.command({ do: 'select', body: body ? [body.slot, body.generation] : null });
    this.app.stage.panels[0].select(body ? body.slot : null);
    this.app.stage.touch();
    if (!body) {
      this.selection = null;
      this.bodies.showNothing();
    } else if (window.innerWidth >= 760) this.app.shell.open('bodies');
  }

  private freeze(): void {
    const body = this.selection?.body;
    if (body) this.command({ do: 'freeze', body: [body.slot, body.generation], fixed: !this.selection!.fixed });
    else this.app.shell.say('Select a body first: click it.');
  }

  private remove(): void {
    const body = this.selection?.body;
    if (body) this.command({ do: 'delete', body: [body.slot, body.generation] });
    else this.app.shell.say('Select a body first: click it.');
  }

  private grab(hit: Hit): boolean {
    const body = this.roster?.bodies.get(hit.slot);
    if (!body) return false;
    this.command({ do: 'grab', body: [body.slot, body.generation], point: hit.point.toArray() });
    return true;
  }

  private changeSpeed(by: number): void {
    const now = speeds.indexOf(this.state?.speed ?? 1);
    const next = speeds[Math.min(speeds.length - 1, Math.max(0, (now < 0 ? 4 : now) + by))];
    this.command({ do: 'speed', value: next });
  }

  // --- what the server says ---
  private setWorld(message: WorldMessage): void {
    this.roster = {
      epoch: message.epoch, title: message.title, materials: message.materials,
      bodies: new Map(message.bodies.map((body) => [body.slot, body])),
      slots: message.bodies.reduce((n, body) => Math.max(n, body.slot + 1), 0),
    };
    this.app.stage.panels[0].setRoster(this.roster);
    this.bodies.setMaterials(message.materials);
    this.samples = [];
    this.latest = null;
    if (this.lastFollowed !== message.title) this.framed = false;
    this.lastFollowed = message.title;
    this.select(null);
  }

  private changeBodies(message: BodiesMessage): void {
    if (!this.roster) return;
    for (const slot of message.removed) this.roster.bodies.delete(slot);
    for (const body of message.added) this.roster.bodies.set(body.slot, body);
    this.roster = { ...this.roster, epoch: message.epoch, materials: message.materials };
    const panel = this.app.stage.panels[0];
    const extent = panel.extent;
    panel.setRoster(this.roster);
    panel.extent = extent;
    const selected = this.selection?.body;
    if (selected && this.roster.bodies.get(selected.slot)?.generation !== selected.generation) this.select(null);
  }

  private setState(state: State): void {
    this.state = state;
    this.app.shell.showPlaying(this.playButton, state.playing);
    this.settings.show(state);
    this.showScene();
    const at = speeds.indexOf(state.speed);
    if (document.activeElement !== this.speedSlider && at >= 0) this.speedSlider.value = String(at);
    setText(this.speedText, `${significant(state.speed)}×`);
    this.showClock(state.time);
    const behind = state.playing && state.realTime < 0.95 * state.speed;
    const rate = state.playing ? `${significant(state.realTime, 2)}× real time` : 'paused';
    setText(this.app.shell.status, rate);
    this.app.shell.showPictures(this.app.stage.picturesPerSecond);
    this.app.shell.status.classList.toggle('behind', behind);
    this.app.shell.status.title = behind ? `The simulation needs longer than the ${significant(state.speed)}× asked for` : 'Simulated seconds per second';
    this.app.setAbout([
      ['time', 'Time', `${state.time.toFixed(4)} s`], ['steps', 'Time steps', String(state.steps)],
      ['bodies', 'Bodies', String(this.roster?.bodies.size ?? 0)],
      ['kinetic', 'Kinetic energy', quantity(state.kinetic, 'J')], ['potential', 'Potential energy', quantity(state.potential, 'J')],
      ['clients', 'Viewers', String(state.clients)], ['quality', 'Picture quality', this.app.stage.currentQuality],
      ['hash', 'State hash', state.hash ?? 'pause to see it'],
      ...(state.faults.length > 0 ? [['faults', 'Faults', state.faults.join('; ')] as [string, string, string]] : []),
    ]);
  }

  private setSelection(selection: Selection): void {
    const wanted = selection.body && this.roster?.bodies.get(selection.body.slot)?.generation === selection.body.generation;
    if (!wanted) return;
    this.selection = selection;
    this.bodies.show(selection, true);
  }

  private showClock(time: number): void { setText(this.clock, `${time.toFixed(2)} s`); }

  private showScene(): void {
    const name = this.state?.scene ?? '';
    if (![...this.scenePicker.options].some((option) => option.value === name)) {
      this.scenePicker.prepend(h('option', { value: name, 'data-own': '' }, name));
    }
    if (document.activeElement !== this.scenePicker) this.scenePicker.value = name;
  }

  private buildBars(hello: Hello): void {
    for (const scene of hello.scenes) this.scenePicker.append(h('option', { value: scene.example, title: scene.description }, scene.example));
    this.scenePicker.addEventListener('change', () => {
      this.command({ do: 'load', scene: this.scenePicker.value });
      this.scenePicker.blur();
    });
    const upload = h('input', { type: 'file', accept: '.json,application/json', id: 'upload', hidden: true });
    upload.addEventListener('change', async () => {
      const file = upload.files?.[0];
      if (file) this.command({ do: 'upload', name: file.name, text: await file.text() });
      upload.value = '';
    });
    this.app.shell.title.replaceChildren(h('b', { class: 'brand' }, 'Cairn'), this.scenePicker,
      iconButton('file', 'Open a scene file', () => upload.click(), 'upload-button'), upload);
    this.speedSlider.addEventListener('input', () => this.command({ do: 'speed', value: speeds[Number(this.speedSlider.value)] }));
    this.app.shell.transport.replaceChildren(
      iconButton('reset', 'Reset (R)', () => this.command({ do: 'reset' }), 'reset'), this.playButton,
      iconButton('step', 'One time step (.)', () => this.step(1), 'step'), this.clock,
      h('label', { class: 'speed', title: 'Speed ([ and ])' }, this.speedSlider, this.speedText),
      h('button', { type: 'button', class: 'strong', id: 'throw', title: 'Throw a ball from the camera (T)', onclick: () => this.throwBall() }, 'Throw a ball'));
  }
}
