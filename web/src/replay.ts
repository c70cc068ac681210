/** One or two recordings: scrub, play at any speed, side by side in step. */
import type { App, Mode } from './app';
import type { Clip } from './clip';
import { asleep, fixed, type Frame } from './model';
import type { Selection } from './protocol';
import { BodiesPanel } from './ui/bodies';
import type { ChartData } from './ui/charts';
import { Dragging } from './ui/drag';
import { h, iconButton, quantity, setText, significant } from './ui/dom';
import { WorldPanel } from './view/panel';

const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8];

export class Replay implements Mode {
  time = 0;
  playing = true;
  speed = 1;
  selected: { panel: number; slot: number } | null = null;
  private shown = -1;
  private readonly duration: number;
  private readonly bodies: BodiesPanel;
  private readonly playButton: HTMLButtonElement;
  private readonly clock = h('output', { class: 'clock', id: 'clock' });
  private readonly scrub: HTMLInputElement;
  private readonly speedSlider = h('input', { type: 'range', id: 'speed', min: 0, max: speeds.length - 1, step: 1, value: 4, 'aria-label': 'Speed' });
  private readonly speedText = h('output', { for: 'speed' }, '1×');

  constructor(private readonly app: App, readonly clips: Clip[], names: string[]) {
    this.duration = Math.max(...clips.map((clip) => clip.duration));
    this.scrub = h('input', { type: 'range', id: 'scrub', class: 'scrub', min: 0, max: this.duration, step: 'any', value: 0, 'aria-label': 'Time' });
    this.playButton = iconButton('pause', 'Pause (Space)', () => this.togglePlay(), 'play');
    this.bodies = new BodiesPanel({
      throwBall: () => undefined, add: () => undefined, freeze: () => undefined, remove: () => undefined, deselect: () => this.select(null),
    });
    this.bodies.setReplay();
    new Dragging(app.stage, {
      grab: () => false, drag: () => undefined, release: () => undefined,
      select: (hit) => this.select(hit ? hit.slot : null),
    });
    app.stage.setPanels(clips.length);
    clips.forEach((clip, i) => app.stage.panels[i].setRoster(clip.roster));
    this.buildBars(names);
    app.charts.setFields(clips[0].header.sampleFields, clips[0].header.stages);
    const pages = clips.some((clip) => clip.samples.length > 0) ? { charts: app.charts.element } : {};
    app.setPages({ ...pages, bodies: this.bodies.element }, { contacts: clips.every((clip) => clip.header.contacts) });
    app.setAbout([
      ['title', 'Scene', clips.map((clip) => clip.header.title).join(' | ')],
      ['bodies', 'Bodies', clips.map((clip) => clip.header.bodies.length).join(' | ')],
      ['duration', 'Duration', `${significant(this.duration)} s`],
      ['frames', 'Frames', clips.map((clip) => clip.frames).join(' | ')],
      ['steps', 'Steps per second', clips.map((clip) => String(clip.header.settings.steps_per_second ?? '–')).join(' | ')],
      ['version', 'Cairn', clips.map((clip) => clip.header.version).join(' | ')],
      ['machine', 'Machine', clips[0].header.machine],
    ]);
    this.show();
    app.stage.frameAll();
  }

  advance(seconds: number): void {
    if (this.playing) {
      this.time = Math.min(this.duration, this.time + seconds * this.speed);
      if (this.time >= this.duration) this.setPlaying(false);
    }
    if (this.time !== this.shown) this.show();
    setText(this.app.shell.status, this.playing ? `${significant(this.speed)}× real time` : 'paused');
    this.app.shell.showPictures(this.app.stage.picturesPerSecond);
  }

  optionsChanged(): void { this.shown = -1; }

  chartData(): ChartData {
    return { runs: this.clips.map((clip) => clip.samples), cursor: this.time, from: 0, to: Math.max(this.duration, 0.1) };
  }

  key(key: string): boolean {
    switch (key.length === 1 ? key.toUpperCase() : key) {
      case ' ': this.togglePlay(); return true;
      case 'ArrowRight': case '.': this.stepFrame(1); return true;
      case 'ArrowLeft': case ',': this.stepFrame(-1); return true;
      case 'R': case 'Home': this.seek(0); return true;
      case 'End': this.seek(this.duration); return true;
      case '[': this.setSpeed(this.nearbySpeed(-1)); return true;
      case ']': this.setSpeed(this.nearbySpeed(1)); return true;
      case 'Escape': this.select(null); return true;
      default: return false;
    }
  }

  seek(time: number): void {
    this.time = Math.min(this.duration, Math.max(0, time));
    this.show();
  }

  setPlaying(playing: boolean): void {
    this.playing = playing;
    this.app.shell.showPlaying(this.playButton, playing);
  }

  select(slot: number | null): void {
    this.selected = slot === null ? null : { panel: 0, slot };
    for (const panel of this.app.stage.panels) panel.select(slot);
    this.app.stage.touch();
    if (slot === null) this.bodies.showNothing();
    else if (window.innerWidth >= 760) this.app.shell.open('bodies');
    this.showSelection();
  }

  private togglePlay(): void {
    if (!this.playing && this.time >= this.duration) this.time = 0;
    this.setPlaying(!this.playing);
  }

  private stepFrame(by: number): void {
    this.setPlaying(false);
    const clip = this.clips[0];
    this.seek(clip.times[Math.min(clip.frames - 1, Math.max(0, clip.indexAt(this.time) + by))]);
  }

  private nearbySpeed(by: number): number {
    return speeds[Math.min(speeds.length - 1, Math.max(0, speeds.indexOf(this.speed) + by))];
  }

  private setSpeed(speed: number): void {
    this.speed = speed;
    this.speedSlider.value = String(speeds.indexOf(speed));
    setText(this.speedText, `${significant(speed)}×`);
  }

  private show(): void {
    this.shown = this.time;
    this.clips.forEach((clip, i) => this.app.stage.panels[i].setFrame(clip.frameAt(Math.min(this.time, clip.duration)), this.app.options));
    this.app.stage.touch();
    if (document.activeElement !== this.scrub || this.playing) this.scrub.value = String(this.time);
    setText(this.clock, `${this.time.toFixed(2)} s`);
    this.showSelection();
  }

  private showSelection(): void {
    if (!this.selected) return;
    const selection = describe(this.clips[0], this.app.stage.panels[0], this.time, this.selected.slot);
    if (selection) this.bodies.show(selection, false);
  }

  private buildBars(names: string[]): void {
    this.app.shell.title.replaceChildren(h('b', { class: 'brand' }, 'Cairn'), h('span', { class: 'scene-name' }, this.clips[0].header.title));
    this.scrub.addEventListener('input', () => this.seek(Number(this.scrub.value)));
    this.speedSlider.addEventListener('input', () => this.setSpeed(speeds[Number(this.speedSlider.value)]));
    this.app.shell.transport.classList.add('replay');
    this.app.shell.transport.replaceChildren(
      iconButton('reset', 'Back to the beginning (R)', () => this.seek(0), 'reset'), this.playButton, this.scrub, this.clock,
      h('label', { class: 'speed', title: 'Speed ([ and ])' }, this.speedSlider, this.speedText));
    if (this.clips.length > 1) this.app.shell.labels.replaceChildren(...names.map((name) => h('span', {}, name)));
  }
}

function describe(clip: Clip, panel: WorldPanel, time: number, slot: number): Selection | null {
  const body = clip.roster.bodies.get(slot);
  const frame: Frame | null = panel.frame;
  if (!body || !frame) return null;
  const at = (values: Float32Array, n: number): number[] => [...values.subarray(n * slot, n * (slot + 1))];
  const [x, y, z, w] = at(frame.orientation, 4);
  return {
    type: 'selection', body: { slot, generation: 0 }, name: body.name || `body ${slot}`, shape: describeShape(body.shape),
    material: clip.roster.materials[body.material]?.name ?? '', mass: body.mass, position: at(frame.position, 3), orientation: [w, x, y, z],
    ...clip.motionAt(time, slot), asleep: (frame.flags[slot] & asleep) !== 0, fixed: (frame.flags[slot] & fixed) !== 0,
    batch: null, contacts: [], joints: [],
  };
}

function describeShape(shape: { type: string; radius?: number; length?: number; size?: number[]; points?: unknown[]; parts?: unknown[]; indices?: unknown[] }): string {
  if (shape.points) return `hull of ${shape.points.length} corners`;
  if (shape.indices) return `mesh of ${shape.indices.length} triangles`;
  if (shape.parts) return `compound of ${shape.parts.length} parts`;
  if (shape.size) return `box ${shape.size.map((edge) => quantity(edge, 'm')).join(' × ')}`;
  return `${shape.type}${shape.radius ? `, radius ${quantity(shape.radius, 'm')}` : ''}${shape.length ? `, length ${quantity(shape.length, 'm')}` : ''}`;
}
