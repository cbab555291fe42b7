// Elements under the pointer: asks the engine about one place at a time, keeps the answers.

import type { Details, Point, Reference } from "./answers.js";
import type { Engine } from "./engine.js";

/** Reach of the pointer, in points. */
export const REACH = 8;

export class Pointer {
  hovered: Details | undefined;
  selected: Details | undefined;
  private isAsking = false;
  /** Counts the layouts and their edits: an answer about another one is late. */
  private layouts = 0;

  constructor(private readonly call: Engine["call"]) {}

  /** The layout is another one, or was edited. */
  forget(): void {
    this.layouts++;
    this.hovered = this.selected = undefined;
  }

  details(of: Reference): Promise<Details> {
    return this.call<Details>("element", [of.kind, of.row]);
  }

  /** The node at a pixel of the last picture. */
  async nodeAt([x, y]: Point, scale: number): Promise<Details | undefined> {
    const hit = await this.call<Reference | null>("hit", [x, y, REACH * scale]);
    return hit?.kind === "node" ? this.details(hit) : undefined;
  }

  /** Hovers, or selects, what is at a pixel of the last picture; `scale` is pixels per point.
   * Returns `false` if the answer is late, or the last question is not answered yet. */
  async point([x, y]: Point, isClick: boolean, scale: number): Promise<boolean> {
    if (this.isAsking && !isClick) return false;
    this.isAsking = true;
    try {
      const { layouts } = this;
      const hit = await this.call<Reference | null>("hit", [x, y, REACH * scale]);
      const isKnown = (of?: Details) => of?.kind === hit?.kind && of?.row === hit?.row;
      const known = [this.hovered, this.selected].find(isKnown);
      const element = hit ? (known ?? (await this.details(hit))) : undefined;
      if (layouts !== this.layouts) return false;
      this.hovered = element;
      if (isClick) this.selected = element;
      return true;
    } finally {
      this.isAsking = false;
    }
  }
}
