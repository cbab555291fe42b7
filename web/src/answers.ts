// The answers of the engine, as crates/guideway-web/src and crates/guideway/src/json.rs write them.

export type Point = [number, number];
export type Box = [number, number, number, number];

export interface Info {
  name: string;
  format: string;
  formatVersion: string;
  paths: number;
  nodes: number;
  stations: number;
  refused: number;
  bounds: Box | null;
  levels: { id: string; name: string }[];
  vehicleTypes: string[];
  columns: string[];
  targets: { id: string; name: string; extension: string | null }[];
  source: string | null;
}

export interface Reference {
  kind: "path" | "node" | "station";
  row: number;
}

export interface Summary extends Reference {
  id: string;
  bounds: Box | null;
}

export interface Cell {
  name: string;
  value: string;
  unit: string | null;
  /** What a new value is, if the property can be edited. */
  edited: "number" | "bool" | "text" | null;
}

export interface Details extends Summary {
  cells: Cell[];
  outline: Point[][];
}

export interface Finding {
  code: string;
  severity: "error" | "warning" | "info";
  place: string;
  message: string;
  remedy: string;
  element: Reference | null;
}

export interface Findings {
  errors: number;
  warnings: number;
  all: number;
  findings: Finding[];
}

/** A step of an edit script, as `guideway edit --help` lists them. */
export type EditStep = { do: string; [member: string]: unknown };

/** What a step has touched: numbers of elements, and the first names. */
export interface EditedStep {
  step: number;
  do: string;
  paths: number;
  nodes: number;
  stations: number;
  names: string[];
}

export interface Report {
  center: Point;
  pxPerM: number;
  drawn: number;
  total: number;
  notes: string[];
  density: boolean;
  legend: { title: string; entries: { label: string; color: string }[] } | null;
  prepareMs: number;
  renderMs: number;
}

export interface Sample {
  alongM: number;
  x: number;
  y: number;
  /** 0 along x, counterclockwise. */
  headingRad: number;
}

export interface Route {
  lengthM: number;
  timeS: number;
  rows: { path: string; row: number; from: string; to: string; endS: number }[];
}

export interface Diff {
  counts: { element: string; change: string; count: number }[];
  changes: {
    element: string;
    id: string;
    newId: string | null;
    change: string;
    newRow: number | null;
    column: string | null;
    before: string | null;
    after: string | null;
  }[];
  groups: { what: string; example: string }[];
}

/** Where a font is: base64 of gzip, or an address. */
export type FontSource = { packed: string } | { url: string };

/** What a picture shows: crates/guideway-web/src/look.rs. */
export interface Look {
  width: number;
  height: number;
  center?: Point;
  pxPerM?: number;
  pxPerPoint?: number;
  level?: string;
  colorBy?: string;
  palette?: string;
  range?: [number, number];
  breaks?: number[];
  color?: string;
  background?: string;
  shade?: "auto" | "color" | "density";
  floorPlan?: boolean;
  envelope?: string;
  arrows?: boolean;
  nodes?: boolean;
  stations?: boolean;
  labels?: boolean;
  grid?: boolean;
  scaleBar?: boolean;
  legend?: boolean;
  title?: string;
  route?: { from: string; to: string; vehicleType?: string };
}

/** Where an image lies: its scale, its rotation about its lower left corner, and this corner. */
export interface Placement {
  pxPerM: number;
  rotateDeg: number;
  offset: Point;
}

/** The format that a layout had before it traveled as Arrow. */
export interface Origin {
  format: string;
  formatVersion: string;
}

/** What a shared file says beside its layout: crates/guideway/src/cli/share. */
export interface Shared extends Origin {
  name: string;
  title: string;
  look: Partial<Look>;
  floorPlan?: {
    name: string;
    placement: Placement | null;
  };
}

export interface Picture {
  width: number;
  height: number;
  rgba: ArrayBuffer;
  report: Report;
}
