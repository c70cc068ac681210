/** Shows the validation that stands in the page. */
import { element, formatNumber, withUnit } from '../../../bench_thesis/page/src/dom';
import { figureElement } from '../../../bench_thesis/page/src/plots';
import type { Figure } from '../../../bench_thesis/page/src/report';
import type { Case, Convergence, Quantity, Validation } from './report';

const report = JSON.parse(document.getElementById('report')!.textContent!) as Validation;

function mark(passed: boolean): HTMLElement {
  return element('span', { class: passed ? 'met' : 'missed' }, passed ? 'met' : 'missed');
}

function judged(c: Case): Quantity[] {
  return c.quantities.filter((q) => q.passed !== null);
}

function metText(c: Case): string {
  const all = judged(c);
  return `${all.filter((q) => q.passed).length} of ${all.length}`;
}

function limitText(q: Quantity): string {
  if (q.allowed === null) return '';
  if (q.rule === 'relative') return `${formatNumber(q.allowed)} of it`;
  if (q.rule === 'absolute') return withUnit(q.allowed, q.unit);
  return `${q.rule} ${withUnit(q.allowed, q.unit)}`;
}

function errorText(q: Quantity): string {
  if (q.error === null || q.rule === 'at most' || q.rule === 'at least') return '';
  return q.rule === 'relative' ? formatNumber(q.error) : withUnit(q.error, q.unit);
}

function row(q: Quantity): HTMLElement {
  const what: (Node | string)[] = [q.what];
  if (q.setup) what.push(element('small', {}, q.setup));
  if (q.note) what.push(element('small', {}, q.note));
  const verdict = q.passed === null ? '' : q.passed ? 'met' : 'missed';
  return element(
    'tr',
    { class: q.passed === null ? 'shown' : '' },
    element('th', { scope: 'row' }, ...what),
    element('td', {}, q.expected === null ? '' : withUnit(q.expected, q.unit)),
    element('td', { class: 'ours' }, withUnit(q.measured, q.unit)),
    element('td', {}, errorText(q)),
    element('td', {}, q.order),
    element('td', {}, limitText(q)),
    element('td', { class: verdict }, verdict),
  );
}

function table(quantities: Quantity[]): HTMLElement {
  const head = ['', 'expected', 'measured', 'error', 'order', 'allowed', ''].map((text) =>
    element('th', { scope: 'col' }, text),
  );
  const body = element('tbody', {}, ...quantities.map(row));
  const whole = element('table', {}, element('thead', {}, element('tr', {}, ...head)), body);
  return element('div', { class: 'overflow' }, whole);
}

function orderText(c: Convergence): string {
  return c.order === null ? c.what : `${c.what} (order ${c.order.toFixed(1)})`;
}

/** Errors over the time step; what is only rounding or does not depend on the time step is left out. */
function convergenceFigure(c: Case): Figure | null {
  const falling = c.convergences.filter((one) => one.order !== null && Math.abs(one.order) > 0.1);
  if (falling.length === 0) return null;
  return {
    id: `${c.name}/convergence`,
    source: '',
    title: 'Error over the time step',
    x: 'time step [s]',
    y: 'error',
    scale: 'log',
    x_scale: 'log',
    lines: falling.map((one) => ({ label: orderText(one), x: one.time_steps, y: one.errors })),
    references: [],
  };
}

function caseElement(c: Case): HTMLElement {
  const convergence = convergenceFigure(c);
  const figures = convergence ? [...c.figures, convergence] : c.figures;
  return element(
    'section',
    { class: 'case', id: c.name },
    element('h3', {}, c.title, ' ', mark(c.passed)),
    element('p', {}, element('span', { class: 'source' }, 'Expected: '), c.source),
    element('p', { class: 'quiet' }, `${c.setup} (${c.name}, ${c.seconds < 10 ? c.seconds.toFixed(1) : Math.round(c.seconds)}\u202fs)`),
    table(c.quantities),
    element('div', { class: 'charts' }, ...figures.map(figureElement)),
  );
}

function missedItem(c: Case, q: Quantity): HTMLElement {
  const expected = q.rule === 'relative' || q.rule === 'absolute' ? `${withUnit(q.expected, q.unit)} within ` : '';
  return element(
    'li',
    {},
    element('a', { href: `#${c.name}` }, c.title),
    `: ${q.what}${q.setup ? ` (${q.setup})` : ''}: `,
    element('b', {}, withUnit(q.measured, q.unit)),
    `; wanted: ${expected}${limitText(q)}`,
    element('small', {}, q.note),
  );
}

/** Every target that is missed, with the reason that its remark gives. */
function missedList(cases: Case[]): HTMLElement[] {
  const items = cases.flatMap((c) => judged(c).filter((q) => !q.passed).map((q) => missedItem(c, q)));
  return items.length === 0 ? [] : [element('h2', {}, 'Missed, and why'), element('ul', {}, ...items)];
}

function overviewRow(c: Case): HTMLElement {
  return element(
    'tr',
    {},
    element('th', { scope: 'row' }, element('a', { href: `#${c.name}` }, c.title)),
    element('td', {}, metText(c)),
    element('td', { class: c.passed ? 'met' : 'missed' }, c.passed ? 'met' : 'missed'),
  );
}

function overview(cases: Case[]): HTMLElement {
  const head = ['', 'targets met', ''].map((text) => element('th', { scope: 'col' }, text));
  return element(
    'table',
    {},
    element('thead', {}, element('tr', {}, ...head)),
    element('tbody', {}, ...cases.map(overviewRow)),
  );
}

const { processor, cores, system, compiler } = report.machine;
const passed = report.cases.filter((c) => c.passed).length;
const main = document.getElementById('main')!;
main.append(
  element('h1', {}, 'Cairn against closed forms and experiments'),
  element(
    'p',
    {},
    `${passed} of ${report.cases.length} cases meet all their targets. What is missed stands below the overview, with its value.`,
  ),
  element(
    'p',
    { class: 'quiet' },
    `Cairn ${report.version} on ${processor}, ${cores} cores, ${system}, ${compiler}. Unless said otherwise: the accuracy ` +
      'preset with exact_flight, the resolution accelerated_sweeps run to convergence, sleeping off. Order: with which ' +
      'power of the time step the error falls; 0 where something else limits it, such as the steps of a bisection; negative where rounding adds up.',
  ),
);
if (report.extent === 'quick') {
  main.append(element('p', { class: 'banner' }, 'A quick run: coarser and shorter; for the signs, not the numbers.'));
}
main.append(overview(report.cases), ...missedList(report.cases));
for (const group of new Set(report.cases.map((c) => c.group))) {
  main.append(element('h2', {}, group), ...report.cases.filter((c) => c.group === group).map(caseElement));
}
