/** Shows the report that stands in the page. */
import { element, formatDifference, formatNumber, withUnit } from './dom';
import { figureElement, overview, type Factor } from './plots';
import type { Entry, PictureRow, Report, Section } from './report';

const report = JSON.parse(document.getElementById('report')!.textContent!) as Report;

function machineText(): string {
  const { processor, cores, system, compiler } = report.machine;
  return `Measured on ${processor}, ${cores} cores, ${system}, ${compiler}. Cairn ${report.version}, ${report.date}.`;
}

function factorText(): string {
  const { rating, rating_source, rating_e6400, rating_i7_940 } = report.machine;
  const theirs = `${rating_e6400} for the Core 2 Duo E6400 and ${rating_i7_940} for the Core i7 940`;
  if (rating === null) {
    return `Processors compare by PassMark's single-thread ratings, rounded: ${theirs}. That of this one is not known; give it with --rating.`;
  }
  const factors = [rating / rating_e6400, rating / rating_i7_940].map((f) => f.toFixed(1));
  return (
    `How much of the gain is the processor's? An estimate by PassMark's single-thread ratings (cpubenchmark.net, user-submitted averages, ` +
    `rounded): ${theirs}; this one has ${rating} (${rating_source}). A core is thus about ${factors[0]} times as fast as one of the ` +
    `E6400 and ${factors[1]} times as fast as one of the i7. The ratios of §5.2 to §5.5 depend on the machine far less.`
  );
}

function explanationCell(entry: Entry): (Node | string)[] {
  const cells: (Node | string)[] = [entry.what];
  if (entry.note) cells.push(element('small', {}, entry.note));
  if (entry.explanation) cells.push(element('small', { class: 'why' }, entry.explanation));
  return cells;
}

function row(entry: Entry): HTMLElement {
  const difference = entry.difference_percent;
  return element(
    'tr',
    {},
    element('th', { scope: 'row' }, ...explanationCell(entry)),
    element('td', {}, withUnit(entry.thesis, entry.unit)),
    element('td', { class: 'ours' }, withUnit(entry.ours, entry.unit)),
    element('td', {}, entry.shortened ? 'shortened' : difference === null ? '' : formatDifference(difference)),
  );
}

function table(entries: Entry[]): HTMLElement {
  const head = ['', 'thesis', 'ours', 'difference'].map((text) => element('th', { scope: 'col' }, text));
  return element(
    'table',
    {},
    element('thead', {}, element('tr', {}, ...head)),
    element('tbody', {}, ...entries.map(row)),
  );
}

function enlarge(image: HTMLImageElement): void {
  const dialog = element('dialog', {}, element('img', { src: image.src, alt: image.alt }));
  dialog.addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

function pictures(rowOfPictures: PictureRow): HTMLElement | string {
  if (rowOfPictures.files.length === 0) return '';
  const shown = rowOfPictures.files.map(({ time, file }) => {
    const alt = `${rowOfPictures.caption}, after ${formatNumber(time)} s`;
    const image = element('img', { src: report.picture_data[file]!, alt, loading: 'lazy' });
    const button = element('button', { type: 'button', title: 'Enlarge' }, image);
    button.addEventListener('click', () => enlarge(image));
    return element('figure', {}, button, element('figcaption', {}, `${formatNumber(time)} s`));
  });
  return element(
    'div',
    { class: 'pictures' },
    element('h3', {}, element('span', { class: 'source' }, `${rowOfPictures.source}: `), rowOfPictures.caption),
    element('div', { class: 'row' }, ...shown),
  );
}

function list(items: { what: string; good: boolean }[], words: [string, string]): HTMLElement {
  return element(
    'ul',
    { class: 'verdicts' },
    ...items.map(({ what, good }) =>
      element('li', { class: good ? 'good' : 'bad' }, element('b', {}, good ? words[0] : words[1]), ` ${what}`),
    ),
  );
}

function sectionElement(section: Section): HTMLElement {
  const checks = section.checks.map(({ what, holds }) => ({ what, good: holds }));
  const held = checks.filter((check) => check.good).length;
  const details = element(
    'details',
    held === checks.length ? {} : { open: '' },
    element('summary', {}, `${held} of ${checks.length} checks hold`),
    list(checks, ['✓', '✗']),
  );
  return element(
    'section',
    { id: section.id },
    element('h2', {}, `§${section.id} ${section.title}`),
    element('p', {}, section.text),
    table(section.entries),
    element('div', { class: 'charts' }, ...section.figures.map(figureElement)),
    ...section.pictures.map(pictures),
    details,
  );
}

const factorNames: Record<string, string> = {
  best_response: 'response alone on several threads, best step',
  speedup: '',
};
const speedups: Record<string, string> = {
  '5.3': 'speed-up by gravity damping',
  '5.4': 'speed-up by the highest closing speed',
  '5.5': 'speed-up of performance over accuracy',
};

/** The entries that are factors, and the thesis gives a number of the same scene for. */
function factors(): Factor[] {
  const rows: Factor[] = [];
  for (const { id: section, entries } of report.sections) {
    for (const { id, thesis, ours, shortened } of entries) {
      if (shortened || thesis === null || ours === null || thesis <= 0 || ours <= 0) continue;
      const [, scene, quantity] = id.split('/') as [string, string, string];
      if (section === '5.1' && quantity === 'average') {
        rows.push({ section, scene, what: 'speed over the thesis', thesis: 1, ours: thesis / ours });
      } else if (quantity in factorNames) {
        rows.push({ section, scene, what: factorNames[quantity] || speedups[section]!, thesis, ours });
      }
    }
  }
  return rows;
}

function show(): void {
  const goals = report.sections.flatMap((s) => s.goals.map(({ what, reached }) => ({ what: `§${s.id} ${what}`, good: reached })));
  const links = report.sections.map((s) => element('a', { href: `#${s.id}` }, `§${s.id} ${s.title}`));
  const main = document.getElementById('main')!;
  main.append(
    element(
      'header',
      {},
      element('h1', {}, 'The thesis’s benchmarks, repeated with Cairn'),
      element(
        'p',
        {},
        'F. Schornbaum, A Real-time Capable Impulse-based Collision Response Algorithm for Rigid Body Dynamics, ' +
          'Diplomarbeit, FAU Erlangen-Nürnberg, 2010, §5: every table and figure with the thesis’s own settings.',
      ),
      element('p', { class: 'quiet' }, machineText()),
      element('p', { class: 'quiet' }, factorText()),
      ...(report.extent === 'quick'
        ? [element('p', { class: 'banner' }, 'A quick run: scenes are shortened and measured once. The signs count, not the numbers; beside those of a part of a scene stands no factor to the thesis.')]
        : []),
      ...report.warnings.map((text) => element('p', { class: 'banner' }, text)),
      element('nav', {}, ...links),
    ),
  );
  if (factors().length) main.append(overview(factors()));
  if (goals.length) {
    main.append(element('h2', {}, 'Aims of this project'), list(goals, ['reached', 'missed']));
  }
  main.append(...report.sections.map(sectionElement));
}

show();
