/** The plots: one kind for the figures, one for the overview. */
import * as Plot from '@observablehq/plot';
import { element, formatNumber, superscript } from './dom';
import type { Figure } from './report';

const colours = ['var(--first)', 'var(--second)', 'var(--third)'];
const dashes = ['6 4', '2 3', '1 0'];

interface Point {
  x: number;
  y: number;
  title?: string;
}

/** What a logarithmic axis cannot show, and what was not measured, leaves a gap. */
function pointsOf(figure: Figure, index: number): Point[] {
  const line = figure.lines[index]!;
  return line.y.map((y, i) => ({
    x: line.x ? line.x[i]! : i + 1,
    y: y === null || (figure.scale === 'log' && y <= 0) ? NaN : y,
  }));
}

/** Of a line whose points lie elsewhere: between its neighbours; nothing beyond its ends. */
function valueAt(points: Point[], x: number): number {
  const next = points.findIndex((point) => point.x >= x);
  if (next < 0 || (next === 0 && points[0]!.x > x)) return NaN;
  const [b, a] = [points[next]!, points[Math.max(0, next - 1)]!];
  return b.x === x ? b.y : a.y + ((b.y - a.y) * (x - a.x)) / (b.x - a.x);
}

/** For the pointer: all lines' values at one place. */
function readings(figure: Figure, lines: Point[][]): Point[] {
  return lines[0]!.map((point) => {
    const values = figure.lines.map((line, k) => {
      const y = valueAt(lines[k]!, point.x);
      return `${line.label}: ${Number.isNaN(y) ? '–' : formatNumber(y)}`;
    });
    const seen = lines.map((line) => valueAt(line, point.x)).filter((y) => !Number.isNaN(y));
    const at = figure.lines[0]!.x ? `${formatNumber(point.x)}` : `step ${point.x}`;
    return { x: point.x, y: seen.length ? Math.max(...seen) : NaN, title: [at, ...values].join('\n') };
  });
}

/** Powers of ten as such, everything else as it is. */
function tick(value: number): string {
  return value !== 0 && Math.abs(value) < 1e-3 ? value.toExponential(0) : value.toLocaleString('en');
}

/** 1, 2 and 5 times powers of ten, or fewer of them, so that no more than `most_ticks` stand on an axis. */
function logTicks(least: number, most: number, most_ticks: number): number[] {
  const decades = Math.log10(most / least);
  const steps = decades * 3 <= most_ticks ? [1, 2, 5] : decades * 2 <= most_ticks ? [1, 3] : [1];
  const every = Math.max(1, Math.ceil(decades / most_ticks));
  const ticks: number[] = [];
  for (let power = Math.floor(Math.log10(least)); power <= Math.ceil(Math.log10(most)); ++power) {
    if (steps.length === 1 && power % every !== 0) continue;
    for (const step of steps) ticks.push(Number((step * 10 ** power).toPrecision(1)));
  }
  return ticks.filter((tick) => tick >= least && tick <= most);
}

/** Numbers that would need many zeros are written as powers of ten. */
function logTick(y: number): string {
  if (y >= 1e-3 && y < 1e6) return y.toLocaleString('en');
  const [digit, power] = y.toExponential(0).split('e');
  return `${digit}·10${superscript(Number(power))}`;
}

/** Of a horizontal axis: a narrow plot has room for few texts. */
function horizontalTicks(figure: Figure, lines: Point[][], width: number): number | number[] {
  const most = width < 420 ? 5 : 8;
  if (figure.x_scale !== 'log') return most;
  const values = lines.flat().map(({ x }) => x);
  return logTicks(Math.min(...values), Math.max(...values), most);
}

function draw(figure: Figure, width: number): SVGSVGElement | HTMLElement {
  const lines = figure.lines.map((_, i) => pointsOf(figure, i));
  const log = figure.scale === 'log';
  const values = [...lines.flat().map(({ y }) => y), ...figure.references.map(({ y }) => y)].filter((y) => !Number.isNaN(y));
  const ticks = log ? logTicks(Math.min(...values), Math.max(...values), 6) : [];
  const horizontal = horizontalTicks(figure, lines, width);
  return Plot.plot({
    width,
    height: Math.round(Math.min(300, Math.max(210, width * 0.5))),
    marginLeft: 58,
    marginRight: 12,
    marginTop: 26,
    marginBottom: 38,
    style: { background: 'transparent', fontSize: '12px', overflow: 'visible' },
    x: {
      label: figure.x,
      type: figure.x_scale ?? 'linear',
      nice: false,
      ticks: horizontal,
      ...(figure.x_scale === 'log' ? { tickFormat: logTick } : {}),
    },
    y: log
      ? { label: figure.y, type: 'log', domain: [Math.min(...values), Math.max(...values)] }
      : { label: figure.y, grid: true, ticks: 5, tickFormat: tick },
    marks: [
      // A logarithmic axis labels only some of the ticks it is given, unless their texts are given, too.
      log ? Plot.gridY(ticks) : Plot.ruleY([0], { stroke: 'var(--axis)' }),
      log ? Plot.axisY(ticks, { label: figure.y, text: logTick }) : null,
      ...figure.references.map((reference, i) =>
        Plot.ruleY([reference.y], {
          stroke: 'var(--reference)',
          strokeWidth: 1.4,
          strokeDasharray: dashes[i % dashes.length]!,
        }),
      ),
      ...lines.map((points, i) =>
        Plot.line(points, {
          x: 'x',
          y: 'y',
          stroke: colours[i % colours.length]!,
          strokeWidth: 1.6,
          strokeDasharray: figure.lines[i]!.dashed ? dashes[0]! : 'none',
        }),
      ),
      Plot.ruleX(readings(figure, lines), Plot.pointerX({ x: 'x', stroke: 'var(--axis)' })),
      Plot.tip(
        readings(figure, lines),
        Plot.pointerX({ x: 'x', y: 'y', title: 'title', fill: 'var(--raised)', stroke: 'var(--axis)' }),
      ),
    ],
  });
}

function swatch(colour: string, dash: string): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('width', '26');
  svg.setAttribute('height', '8');
  svg.innerHTML = `<line x1="1" x2="25" y1="4" y2="4" stroke="${colour}" stroke-width="2" stroke-dasharray="${dash}"/>`;
  return svg;
}

function legend(figure: Figure): HTMLElement {
  const items = figure.lines.map((line, i) =>
    element('span', {}, swatch(colours[i % colours.length]!, line.dashed ? dashes[0]! : 'none'), line.label),
  );
  for (const [i, reference] of figure.references.entries()) {
    items.push(element('span', {}, swatch('var(--reference)', dashes[i % dashes.length]!), reference.label));
  }
  return element('div', { class: 'legend' }, ...items);
}

/** Draws anew whenever the width changes. */
function responsive(make: (width: number) => Element): HTMLElement {
  const holder = element('div', { class: 'plot' });
  let drawn = 0;
  new ResizeObserver(([entry]) => {
    const width = Math.floor(entry!.contentRect.width);
    if (width === drawn || width === 0) return;
    drawn = width;
    holder.replaceChildren(make(width));
  }).observe(holder);
  return holder;
}

export function figureElement(figure: Figure): HTMLElement {
  const source = figure.source ? `${figure.source}: ` : '';
  return element(
    'figure',
    { class: 'chart' },
    element('figcaption', {}, element('span', { class: 'source' }, source), figure.title),
    legend(figure),
    responsive((width) => draw(figure, width)),
  );
}

/** A row of the overview. */
export interface Factor {
  section: string;
  scene: string;
  what: string;
  thesis: number;
  ours: number;
}

/** All factors of the thesis on one axis, ours beside them. */
export function overview(factors: Factor[]): HTMLElement {
  const values = factors.flatMap(({ thesis, ours }) => [thesis, ours]);
  const [least, most] = [Math.min(...values) / 1.2, Math.max(...values) * 1.2];
  const make = (width: number): Element => {
    const narrow = width < 600;
    const ticks = logTicks(least, most, narrow ? 4 : 12);
    const rows = factors.map((factor) => ({
      ...factor,
      name: narrow ? `§${factor.section} ${factor.scene}` : `§${factor.section} ${factor.scene}: ${factor.what}`,
    }));
    const longest = Math.max(...rows.map(({ name }) => name.length));
    return Plot.plot({
      width,
      height: 54 + 26 * rows.length,
      marginLeft: Math.round(Math.min(width / 2, 16 + 6.4 * longest)),
      marginRight: 16,
      marginTop: 8,
      marginBottom: 38,
      style: { background: 'transparent', fontSize: '12px', overflow: 'visible' },
      x: {
        type: 'log',
        label: 'factor',
        domain: [least, most],
      },
      y: { label: null, domain: rows.map((row) => row.name), tickSize: 0 },
      marks: [
        Plot.gridX(ticks),
        Plot.axisX(ticks, { label: 'factor', text: (x: number) => x.toLocaleString('en') }),
        Plot.ruleX([1], { stroke: 'var(--axis)' }),
        Plot.link(rows, { x1: 'thesis', x2: 'ours', y1: 'name', y2: 'name', stroke: 'var(--axis)' }),
        Plot.tickX(rows, { x: 'thesis', y: 'name', stroke: 'var(--reference)', strokeWidth: 3, inset: 4 }),
        Plot.dot(rows, { x: 'ours', y: 'name', fill: 'var(--first)', r: 5 }),
        Plot.tip(
          rows,
          Plot.pointer({
            x: 'ours',
            y: 'name',
            title: (row: (typeof rows)[number]) =>
              `§${row.section} ${row.scene}: ${row.what}\nthesis: ${formatNumber(row.thesis)}\nours: ${formatNumber(row.ours)}`,
            fill: 'var(--raised)',
            stroke: 'var(--axis)',
          }),
        ),
      ],
    });
  };
  const meanings = new Map(factors.map(({ section, what }) => [section, what]));
  const meaning = [...meanings].map(([section, what]) => `§${section} ${what}`).join('; ');
  return element(
    'figure',
    { class: 'chart' },
    element('figcaption', {}, 'Factors of the thesis and ours'),
    element('div', { class: 'legend' }, element('span', {}, element('span', { class: 'dot' }), 'ours'),
      element('span', {}, element('span', { class: 'mark' }), 'thesis')),
    responsive(make),
    element('p', { class: 'quiet' }, `${meaning}.`),
  );
}
