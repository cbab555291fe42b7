// The tools of the page: measure, draw nodes and paths, drag nodes. One is taken up at a time.

import type { Details, EditStep, Info, Point } from "./answers.js";
import { type Drawing, paintLine, rounded } from "./drawing.js";
import { type GuidewayMap, paintElement } from "./map.js";
import { type Pointer, REACH } from "./pointer.js";
import { meters, t } from "./text.js";

/** The tools, by the buttons of the page. */
export const TOOLS = ["measure", "draw-node", "draw-path"] as const;
export type Tool = (typeof TOOLS)[number];

export class Tools {
  tool: Tool | undefined;
  /** Performs edits, and selects what was edited; pages that only show have none. */
  onedit: ((steps: EditStep[], of?: Details) => Promise<void>) | undefined;
  onstatus: (text: string) => void = () => {};
  /** The open layout. */
  info: () => Info | undefined = () => undefined;
  private measured: Point[] = [];
  /** Clicks and keys of a tool act in their order: each waits for the answers to those before. */
  private queue = Promise.resolve();
  private waiting = 0;
  /** Where the selected node is dragged to. */
  private dragged: Point | undefined;

  constructor(
    private readonly map: GuidewayMap,
    private readonly pointer: Pointer,
    private readonly drawing: Drawing,
  ) {
    map.onlift = (at) => this.lift(at);
    map.ondrag = (at, isDropped) => this.drag(at, isDropped);
  }

  /** Takes up a tool in place of the one before; none puts it down. */
  takeUp(tool: Tool | undefined): void {
    this.tool = tool;
    this.measured = [];
    this.drawing.begin(tool === "draw-path" ? this.pointer.selected : undefined);
    for (const of of TOOLS) {
      document.getElementById(of)?.setAttribute("aria-pressed", String(tool === of));
    }
    this.onstatus(tool ? t(HINTS[tool]) : "");
    this.map.canvas.style.cursor = tool ? "crosshair" : "";
    this.map.paint();
  }

  /** The pointer is at a pixel, or clicks there; returns `true` if that was for a tool. */
  point(at: Point, isClick: boolean): boolean {
    if (!this.tool) return false;
    const place = this.map.world(at);
    if (this.tool === "measure") {
      if (isClick) this.measure(place);
      return true;
    }
    this.drawing.pointer = place;
    this.map.paint();
    if (isClick) this.perform((info) => this.draw(at, place, info));
    return true;
  }

  /** Ends the path that is being drawn where the last click was. */
  endPath(): void {
    if (this.tool === "draw-path") this.perform((info) => this.drawing.finish(info, this.level(info)));
  }

  /** Ends one thing: a drag, a path, a tool. Returns `false` if there is none. */
  endOne(): boolean {
    if (this.map.putBack()) return true;
    if (this.waiting || this.drawing.line.length) {
      this.perform(async () => (this.drawing.drop(), []));
    } else if (this.tool) this.takeUp(undefined);
    else return false;
    return true;
  }

  paint(pen: CanvasRenderingContext2D, at: (point: Point) => Point, accent: string): void {
    const { scale } = this.map;
    const from = this.pointer.selected?.outline[0]?.[0];
    if (this.dragged && from) paintLine(pen, at, [from, this.dragged], accent, scale);
    paintLine(pen, at, this.drawing.line, accent, scale);
    if (!this.measured.length) return;
    const outline = [this.measured];
    const line = { kind: "path", row: 0, id: "", bounds: null, cells: [], outline } as Details;
    paintElement(pen, at, line, "#d55e00", scale);
  }

  private measure(point: Point): void {
    this.measured.push(point);
    let length = 0;
    this.measured.forEach(([x, y], i) => {
      const [lastX, lastY] = this.measured[i - 1] ?? [x, y];
      length += Math.hypot(x - lastX, y - lastY);
    });
    this.onstatus(`${meters(length)} (${point.map((value) => value.toFixed(2)).join(", ")})`);
    this.map.paint();
  }

  private async draw(at: Point, place: Point, info: Info): Promise<EditStep[]> {
    const node = await this.pointer.nodeAt(at, this.map.scale);
    if (this.tool === "draw-path") return this.drawing.click(place, node, info, this.level(info));
    return node ? [] : [await this.drawing.newNode(place, info, [], this.level(info))];
  }

  /** Performs the edits that a tool asks for, unless another layout is open by then. */
  private perform(steps: (info: Info) => Promise<EditStep[]>): void {
    const { tool } = this;
    this.waiting++;
    this.queue = this.queue
      .then(async () => {
        const info = this.info();
        if (!info || this.tool !== tool) return;
        const asked = await steps(info);
        this.map.paint();
        if (asked.length && this.info() === info) await this.onedit?.(asked);
      })
      .catch(this.map.onfail)
      .finally(() => this.waiting--);
  }

  private lift(at: Point): boolean {
    const { selected } = this.pointer;
    if (!this.onedit || this.tool || selected?.kind !== "node") return false;
    const [x, y] = this.map.pixel(selected.outline[0]![0]!);
    return Math.hypot(x - at[0], y - at[1]) <= REACH * this.map.scale;
  }

  private drag(at: Point | undefined, isDropped: boolean): void {
    const { selected } = this.pointer;
    this.dragged = at && !isDropped ? this.map.world(at) : undefined;
    this.map.paint();
    if (!at || !isDropped || !selected) return;
    const to = rounded(this.map.world(at));
    void this.onedit?.([{ do: "move-node", node: selected.id, to }], selected);
  }

  /** The level that is shown alone, or the first one. */
  private level(info: Info): string | undefined {
    return this.map.look.level ?? info.levels[0]?.id;
  }
}

const HINTS: Record<Tool, string> = {
  "measure": "Click points to measure; Escape ends.",
  "draw-node": "Click places for nodes; Escape ends.",
  "draw-path":
    "Click from node to node, or places between; Enter ends the path, Escape drops it.",
};
