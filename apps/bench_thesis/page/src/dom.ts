/** Elements and numbers. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const superscripts: Record<string, string> = {
  '-': '⁻', '0': '⁰', '1': '¹', '2': '²', '3': '³', '4': '⁴', '5': '⁵', '6': '⁶', '7': '⁷', '8': '⁸', '9': '⁹',
};

export function superscript(power: number): string {
  return [...String(power)].map((c) => superscripts[c]).join('');
}

/** Four digits at most; a narrow space between thousands; powers of ten where they are needed. */
export function formatNumber(value: number): string {
  const size = Math.abs(value);
  if (value === 0) return '0';
  if (size < 1e-3) {
    const [digits, power] = value.toExponential(1).split('e');
    return `${digits}\u00a0×\u00a010${superscript(Number(power))}`.replace('-', '−');
  }
  const [whole, rest] = String(Number(value.toPrecision(4))).split('.');
  const grouped = whole!.replace(/\B(?=(\d{3})+$)/g, '\u202f').replace('-', '−');
  return rest ? `${grouped}.${rest}` : grouped;
}

export function withUnit(value: number | null, unit: string): string {
  if (value === null) return '–';
  return unit ? `${formatNumber(value)}\u202f${unit}` : formatNumber(value);
}

export function formatDifference(percent: number): string {
  const rounded = Math.round(percent);
  return `${rounded > 0 ? '+' : rounded < 0 ? '−' : '±'}${Math.abs(rounded)}\u202f%`;
}
