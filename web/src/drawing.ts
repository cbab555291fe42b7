// A path that is drawn by clicks from node to node, and new nodes.

import type { Details, EditStep, EditedStep, Info, Point } from "./answers.js";
import type { Reference, Summary } from "./answers.js";
import type { Engine } from "./engine.js";

/** Where a path begins, leads through or ends: at a node, or at a point. */
interface Place {
  at: Point;
  node: Details | undefined;
}

/** To the millimeter, so that files have short numbers. */
export const rounded = ([x, y]: Point): Point => {
  const round = (value: number) => Math.round(value * 1000) / 1000;
  return [round(x), round(y)];
};

export class Drawing {
  /** The place of the pointer, to which the path leads next. */
  pointer: Point | undefined;
  private places: Place[] = [];
  /** The path whose properties new ones take over. */
  private like: string | undefined;

  constructor(private readonly call: Engine["call"]) {}

  /** Begins anew. Paths are like the given one from now on. */
  begin(like?: Details): void {
    this.drop();
    this.like = like?.kind === "path" ? like.id : undefined;
  }

  /** Drops the path that is being drawn; returns `false` if there is none. */
  drop(): boolean {
    const hadPlaces = this.places.length > 0;
    this.places = [];
    this.pointer = undefined;
    return hadPlaces;
  }

  /** The line through the clicked places, to the pointer. */
  get line(): Point[] {
    const clicked = this.places.map(({ at }) => at);
    return clicked.length && this.pointer ? [...clicked, this.pointer] : clicked;
  }

  /** The path leads to a node next, or to a point. Returns the steps of what that completes. */
  async click(
    at: Point,
    node: Details | undefined,
    info: Info,
    level?: string,
  ): Promise<EditStep[]> {
    const place = { at: node?.outline[0]?.[0] ?? rounded(at), node };
    const last = this.places.at(-1);
    if (!last || last.at[0] !== place.at[0] || last.at[1] !== place.at[1]) this.places.push(place);
    return node && this.places.length > 1 ? this.finish(info, level) : [];
  }

  /** Ends the path at the last place. Its ends get nodes where they have none. */
  async finish(info: Info, level?: string): Promise<EditStep[]> {
    const { places } = this;
    const [first, last] = [places[0], places.at(-1)];
    this.drop();
    if (!first || !last || first === last) return [];
    const ownLevel = first.node?.cells.find(({ name }) => name === "level")?.value ?? level;
    const nodes: EditStep[] = [];
    for (const { at, node } of [first, last]) {
      if (!node) nodes.push(await this.newNode(at, info, nodes, ownLevel));
    }
    const names = nodes.map(({ id }) => id);
    const [from, to] = [first, last].map(({ node }) => node?.id ?? names.shift());
    const through = places.slice(1, -1).map(({ at }) => at);
    const like = this.like === undefined ? {} : { like: this.like };
    const shape = through.length ? { do: "create-spline", through } : { do: "create-edge" };
    return [...nodes, { ...shape, from, to, ...onLevel(ownLevel), ...like }];
  }

  /** The step that creates a node, with a name that no other has. */
  async newNode(at: Point, info: Info, made: EditStep[], level?: string) {
    let number = info.nodes + 1;
    const isTaken = async (name: string) => {
      if (made.some(({ id }) => id === name)) return true;
      const found = await this.call<Summary[]>("find", [name, 10]);
      return found.some(({ kind, id }) => kind === "node" && id === name);
    };
    while (await isTaken(`N${number}`)) number++;
    return { do: "create-node", id: `N${number}`, at: rounded(at), ...onLevel(level) } as EditStep;
  }
}

const onLevel = (level?: string) => (level === undefined ? {} : { level });

/** The element that the last step has created, if it has. */
export async function created(call: Engine["call"], last: EditStep, touched: EditedStep[]) {
  const name = touched.at(-1)?.names[0];
  if (!last.do.startsWith("create-") || name === undefined) return undefined;
  const found = await call<Summary[]>("find", [name, 10]);
  const kinds: Record<string, Reference["kind"]> = { node: "node", station: "station" };
  const kind = kinds[last.do.slice("create-".length)] ?? "path";
  return found.find((of) => of.kind === kind && of.id === name);
}

/** Draws the path that is being drawn over the picture. */
export function paintLine(
  pen: CanvasRenderingContext2D,
  at: (point: Point) => Point,
  line: Point[],
  color: string,
  scale: number,
): void {
  pen.strokeStyle = pen.fillStyle = color;
  pen.lineWidth = 2 * scale;
  pen.setLineDash([6 * scale, 4 * scale]);
  pen.beginPath();
  for (const point of line) pen.lineTo(...at(point));
  pen.stroke();
  pen.setLineDash([]);
  for (const point of line) {
    pen.beginPath();
    pen.arc(...at(point), 4 * scale, 0, 2 * Math.PI);
    pen.fill();
  }
}
