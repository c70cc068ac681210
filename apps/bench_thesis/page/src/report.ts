/** What results.json says of the report. */
export interface Entry {
  id: string;
  what: string;
  unit: string;
  thesis: number | null;
  ours: number | null;
  difference_percent: number | null;
  note: string;
  explanation?: string;
  /** Ours is of a part of the thesis's scene: no factor to it. */
  shortened: boolean;
}

export interface Line {
  label: string;
  y: (number | null)[];
  x?: number[];
  /** A formula beside what was measured. */
  dashed?: boolean;
}

export interface Figure {
  id: string;
  source: string;
  title: string;
  x: string;
  y: string;
  scale: 'linear' | 'log';
  x_scale?: 'linear' | 'log';
  lines: Line[];
  references: { label: string; y: number }[];
}

export interface PictureRow {
  source: string;
  caption: string;
  key: string;
  files: { time: number; file: string }[];
}

export interface Section {
  id: string;
  title: string;
  text: string;
  entries: Entry[];
  figures: Figure[];
  pictures: PictureRow[];
  goals: { what: string; reached: boolean }[];
  checks: { what: string; holds: boolean }[];
}

export interface Report {
  extent: 'full' | 'quick';
  version: string;
  date: string;
  machine: {
    processor: string;
    cores: number;
    system: string;
    compiler: string;
    rating: number | null;
    rating_source: string;
    rating_e6400: number;
    rating_i7_940: number;
  };
  sections: Section[];
  warnings: string[];
  picture_data: Record<string, string>;
}
