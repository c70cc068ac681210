/** Charts over the simulated time, drawn on canvases: one sample per simulation step of 1/30 s. */
import type { Sample } from '../model';
import { seriesHex, stageHex } from '../view/palette';
import { niceAbove } from '../view/bodies';
import { compact, h, significant } from './dom';

interface Series { label: string; colour: string; field: string; scale?: number }
interface Plan { title: string; unit: string; stacked: boolean; line?: { value: number; label: string }; series: Series[] }

/** What the charts show: the samples of one run, and of a second one for comparison (dashed). */
export interface ChartData {
  runs: Sample[][];
  /** the present moment, where it is not the last sample */
  cursor: number | null;
  from: number;
  to: number;
}

const height = 108;
const left = 40;
const bottom = 16;

class Chart {
  readonly element: HTMLElement;
  private readonly canvas = h('canvas', { class: 'chart' });
  private readonly values = h('span', { class: 'chart-values' });

  constructor(private readonly plan: Plan, private readonly columns: Map<string, number>) {
    const legend = h('div', { class: 'chart-legend' });
    for (const s of plan.series) legend.append(h('span', {}, h('i', { style: `background:${s.colour}` }), s.label));
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', `${plan.title} over time`);
    this.element = h('section', { class: 'chart-box' },
      h('header', {}, h('h3', {}, plan.title), this.values), this.canvas, legend);
  }

  draw(data: ChartData): void {
    const width = this.canvas.clientWidth;
    if (width === 0) return;
    const ratio = window.devicePixelRatio || 1;
    if (this.canvas.width !== Math.round(width * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const context = this.canvas.getContext('2d')!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const style = getComputedStyle(this.canvas);
    const ink = style.getPropertyValue('--soft').trim();
    const rule = style.getPropertyValue('--rule').trim();
    const top = niceAbove(Math.max(this.largest(data), this.plan.line ? this.plan.line.value * 1.1 : 0, this.plan.unit === 'mm' ? 0.01 : 1));
    const x = (t: number): number => left + ((t - data.from) / Math.max(1e-9, data.to - data.from)) * (width - left - 6);
    const y = (v: number): number => height - bottom - (v / top) * (height - bottom - 6);
    context.font = '10px system-ui, sans-serif';
    context.fillStyle = ink;
    context.strokeStyle = rule;
    context.lineWidth = 1;
    context.textAlign = 'right';
    for (const part of [0, 0.5, 1]) {
      const at = Math.round(y(part * top)) + 0.5;
      line(context, left, at, width - 6, at);
      context.fillText(compact(part * top), left - 5, at + 3);
    }
    context.textAlign = 'center';
    for (const t of ticks(data.from, data.to)) {
      const text = `${significant(t)} s`;
      context.fillText(text, Math.min(x(t), width - 1 - context.measureText(text).width / 2), height - 3);
    }
    context.save();
    context.beginPath();
    context.rect(left, 0, width - left - 6, height - bottom + 1);
    context.clip();
    this.drawRuns(context, data, x, y);
    context.restore();
    if (this.plan.line) {
      const at = Math.round(y(this.plan.line.value)) + 0.5;
      context.strokeStyle = context.fillStyle = style.color;
      context.setLineDash([5, 3]);
      line(context, left, at, width - 6, at);
      context.setLineDash([]);
      context.textAlign = 'left';
      if (at < height - bottom - 12) context.fillText(this.plan.line.label, left + 4, Math.max(10, at - 3));
    }
    if (data.cursor !== null) {
      context.strokeStyle = ink;
      line(context, x(data.cursor), 0, x(data.cursor), height - bottom);
    }
    this.showValues(data);
  }

  private value(sample: Sample, series: Series): number {
    return (sample.values[this.columns.get(series.field) ?? 0] || 0) * (series.scale ?? 1);
  }

  private largest(data: ChartData): number {
    let largest = 0;
    for (const run of data.runs) {
      for (const sample of run) {
        if (sample.time < data.from) continue;
        let sum = 0;
        for (const s of this.plan.series) {
          const v = this.value(sample, s);
          sum += v;
          if (!this.plan.stacked) largest = Math.max(largest, v);
        }
        if (this.plan.stacked) largest = Math.max(largest, sum);
      }
    }
    return largest;
  }

  private drawRuns(context: CanvasRenderingContext2D, data: ChartData, x: (t: number) => number, y: (v: number) => number): void {
    data.runs.forEach((run, index) => {
      if (run.length === 0) return;
      if (this.plan.stacked && index === 0) {
        this.drawStack(context, run, x, y);
        return;
      }
      context.setLineDash(index > 0 ? [4, 3] : []);
      context.lineWidth = 1.5;
      const series: (Series | null)[] = this.plan.stacked ? [null] : this.plan.series;
      for (const s of series) {
        context.strokeStyle = s ? s.colour : getComputedStyle(this.canvas).color;
        context.beginPath();
        for (const sample of run) {
          const v = s ? this.value(sample, s) : this.plan.series.reduce((sum, one) => sum + this.value(sample, one), 0);
          context.lineTo(x(sample.time), y(v));
        }
        context.stroke();
      }
      context.setLineDash([]);
    });
  }

  private drawStack(context: CanvasRenderingContext2D, run: Sample[], x: (t: number) => number, y: (v: number) => number): void {
    let base = run.map(() => 0);
    for (const s of this.plan.series) {
      const next = run.map((sample, i) => base[i] + this.value(sample, s));
      context.fillStyle = s.colour;
      context.beginPath();
      run.forEach((sample, i) => context.lineTo(x(sample.time), y(next[i])));
      for (let i = run.length - 1; i >= 0; i--) context.lineTo(x(run[i].time), y(base[i]));
      context.fill();
      base = next;
    }
  }

  private showValues(data: ChartData): void {
    const texts = data.runs.map((run) => {
      const sample = data.cursor === null ? run.at(-1) : run.findLast((s) => s.time <= data.cursor! + 1e-9) ?? run[0];
      if (!sample) return '–';
      if (this.plan.stacked) return compact(this.plan.series.reduce((sum, s) => sum + this.value(sample, s), 0));
      return this.plan.series.map((s) => compact(this.value(sample, s))).join(' · ');
    });
    this.values.textContent = `${texts.join(' | ')} ${this.plan.unit}`;
  }
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

function ticks(from: number, to: number): number[] {
  const step = niceAbove(Math.max((to - from) / 5, 1e-6));
  const out: number[] = [];
  for (let t = Math.ceil(from / step) * step; t <= to + 1e-9; t += step) out.push(t);
  return out;
}

export class Charts {
  readonly element = h('div', { class: 'charts' });
  private charts: Chart[] = [];

  /** @param fields names of the numbers of a sample @param stages names of the stages of a time step */
  setFields(fields: string[], stages: string[]): void {
    const columns = new Map(fields.map((name, i) => [name, i]));
    const [blue, orange, purple] = seriesHex;
    const plans: Plan[] = [
      {
        title: 'Time per simulation step', unit: 'ms', stacked: true, line: { value: 1000 / 30, label: 'real time: 33⅓ ms' },
        series: stages.map((name, i) => ({ label: name, colour: stageHex[i % stageHex.length], field: `${name}_ms` })),
      },
      {
        title: 'Contacts and iterations', unit: '', stacked: false, series: [
          { label: 'contacts', colour: blue, field: 'contacts' },
          { label: 'iterations', colour: orange, field: 'global_iterations' },
          { label: 'of shock propagation', colour: purple, field: 'shock_iterations' },
        ],
      },
      {
        title: 'Energy', unit: 'J', stacked: false, series: [
          { label: 'kinetic', colour: orange, field: 'kinetic_energy' },
          { label: 'potential', colour: blue, field: 'potential_energy' },
        ],
      },
      {
        title: 'Overlap', unit: 'mm', stacked: false, series: [
          { label: 'largest', colour: orange, field: 'largest_overlap', scale: 1000 },
          { label: 'mean', colour: blue, field: 'mean_overlap', scale: 1000 },
        ],
      },
      { title: 'Bodies asleep', unit: '', stacked: false, series: [{ label: 'asleep', colour: blue, field: 'asleep' }] },
    ];
    this.charts = plans.map((plan) => new Chart(plan, columns));
    this.element.replaceChildren(
      h('p', { class: 'note' }, 'Each point is one simulation step of 1/30 s; counts are sums over its time steps.'),
      ...this.charts.map((chart) => chart.element));
  }

  draw(data: ChartData): void {
    for (const chart of this.charts) chart.draw(data);
  }
}
