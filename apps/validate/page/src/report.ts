/** What validation.json says. */
import type { Figure } from '../../../bench_thesis/page/src/report';

export interface Quantity {
  what: string;
  unit: string;
  setup: string;
  rule: 'relative' | 'absolute' | 'at most' | 'at least' | 'shown';
  expected: number | null;
  measured: number | null;
  error: number | null;
  allowed: number | null;
  passed: boolean | null;
  /** With which power of the time step the error falls, or 'rounding'; at the shortest of several ones only. */
  order: string;
  note: string;
}

export interface Convergence {
  what: string;
  unit: string;
  time_steps: number[];
  errors: (number | null)[];
  order: number | null;
}

export interface Case {
  name: string;
  group: string;
  title: string;
  source: string;
  setup: string;
  seconds: number;
  passed: boolean;
  quantities: Quantity[];
  convergences: Convergence[];
  figures: Figure[];
}

export interface Validation {
  version: string;
  extent: 'full' | 'quick';
  machine: { processor: string; cores: number; system: string; compiler: string };
  cases: Case[];
}
