/** Small helpers to build the page without a framework. */

type Child = Node | string | null | undefined | false;

/** Makes an element. Keys that begin with "on" are listeners, `class` and others attributes. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Record<string, unknown> = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === false || value === null) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value as EventListener);
    else element.setAttribute(key, value === true ? '' : String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

const paths: Record<string, string> = {
  play: 'M8 5.5v13l11-6.5z',
  pause: 'M7 5h3.5v14H7zM13.5 5H17v14h-3.5z',
  step: 'M6 5.5v13l9-6.5zM16 5.5h2.6v13H16z',
  reset: 'M12 5V2L7 6.5 12 11V8a5 5 0 1 1-5 5H4a8 8 0 1 0 8-8z',
  throw: 'M15.5 3a5.5 5.5 0 1 1 0 11 5.5 5.5 0 0 1 0-11zM2 20.3l6.3-6.3 1.7 1.7L3.7 22zM2 15.8l4-4 1.5 1.5-4 4z',
  help: 'M11 17h2.4v2.4H11zM12.2 4a5 5 0 0 1 5 4.9c0 3.5-3.7 3.7-3.8 6.6H11c0-4.3 3.6-4.6 3.6-6.6A2.4 2.4 0 0 0 9.8 9H7.2a5 5 0 0 1 5-5z',
  theme: 'M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 2v14a7 7 0 0 1 0-14z',
  camera: 'M4 9V4h5v2H6v3zM15 4h5v5h-2V6h-3zM4 15h2v3h3v2H4zM18 15h2v5h-5v-2h3z',
  panel: 'M3 5h18v14H3zm2 2v10h8V7zm10 0v10h4V7z',
  add: 'M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z',
  file: 'M12 4l5 5h-3.5v6h-3V9H7zM5 17h14v3H5z',
  close: 'M6.4 5L12 10.6 17.6 5 19 6.4 13.4 12l5.6 5.6-1.4 1.4-5.6-5.6L6.4 19 5 17.6l5.6-5.6L5 6.4z',
  picture: 'M4 7h3l2-2.5h6L17 7h3v12H4zm8 2.5a3.8 3.8 0 1 0 0 7.6 3.8 3.8 0 0 0 0-7.6z',
};

export function icon(name: string): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', paths[name]);
  path.setAttribute('fill-rule', 'evenodd');
  svg.append(path);
  return svg;
}

/** @param hint what it does and, in parentheses, its key */
export function iconButton(name: string, hint: string, onclick: () => void, id?: string): HTMLButtonElement {
  return h('button', { class: 'icon', title: hint, 'aria-label': hint, onclick, id, type: 'button' }, icon(name));
}

export function setIcon(button: HTMLButtonElement, name: string, hint: string): void {
  if (button.title === hint) return;
  button.replaceChildren(icon(name));
  button.title = hint;
  button.setAttribute('aria-label', hint);
}

/** Sets text only where it differs, so that the page does not lay itself out anew. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** A number with three significant digits and a prefix that fits the unit. */
export function quantity(value: number, unit: string): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return `0 ${unit}`;
  const size = Math.abs(value);
  const prefixes: [number, string][] = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n']];
  const [factor, prefix] = prefixes.find(([f]) => size >= f * 0.9995) ?? prefixes[prefixes.length - 1];
  return `${significant(value / factor)} ${prefix}${unit}`;
}

export function significant(value: number, digits = 3): string {
  if (value === 0) return '0';
  const text = Math.abs(value) >= 1e5 || Math.abs(value) < 1e-4 ? value.toExponential(digits - 1) : value.toPrecision(digits);
  return text.includes('e') ? text : String(Number(text));
}

/** A number in few characters, for people: 0.00833, 2·10⁻⁵, 10⁶. */
export function readable(value: number): string {
  const text = significant(value, 6);
  if (!text.includes('e')) return text;
  const [mantissa, exponent] = text.split('e');
  const raised = [...exponent.replace('+', '')].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)])).join('');
  const factor = Number(mantissa);
  return factor === 1 ? `10${raised}` : `${factor}·10${raised}`;
}

/** A number for an axis: short, with k and M. */
export function compact(value: number): string {
  if (Math.abs(value) >= 1e6) return `${significant(value / 1e6)}M`;
  if (Math.abs(value) >= 1e4) return `${significant(value / 1e3)}k`;
  if (Math.abs(value) >= 1000) return String(Math.round(value));
  return significant(value);
}
