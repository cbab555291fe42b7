// The map: shows the last picture where the view wants it, asks for a sharp one, takes gestures.

import type { Box, Details, Look, Picture, Point, Report } from "./answers.js";

export interface View {
  center: Point;
  pxPerM: number;
}

/** Colors of paper and ink, as those of the page: style.css. */
export const LIGHT = { background: "ffffff", color: "000000" };
export const DARK = { background: "16181d", color: "e6e6e6" };
/** Widest part of a view that bounds fill. */
const FIT = 0.9;

export class GuidewayMap {
  /** Draws a picture of a look. */
  draw: (look: Look) => Promise<Picture> = () => Promise.reject(new Error("no layout"));
  onreport: (report: Report) => void = () => {};
  onfail: (error: unknown) => void = () => {};
  onview: (view: View) => void = () => {};
  onpoint: (x: number, y: number, isClick: boolean) => void = () => {};
  /** Returns `true` if a press at a place takes up what lies there, instead of the map. */
  onlift: (at: Point) => boolean = () => false;
  /** What was taken up is at a place, or dropped there; without a place it goes back. */
  ondrag: (at: Point | undefined, isDropped: boolean) => void = () => {};
  /** What the page draws over the paths. */
  overlay: (pen: CanvasRenderingContext2D, at: (point: Point) => Point) => void = () => {};
  /** Colors and decorations, without view and size. */
  look: Partial<Look> = {};
  /** Pictures that were drawn, for tests. */
  drawn = 0;
  /** `undefined` fits all. */
  view: View | undefined;
  /** The view shows all, and goes on to do so when the map gets another size. */
  private isFit = true;
  private shown: { image: ImageBitmap; view: View } | undefined;
  private isDrawing = false;
  private wants = false;
  private isPainting = false;
  private painted: View | undefined;
  private pointers = new Map<number, Point>();
  private moved = 0;
  private isLifted = false;

  constructor(readonly canvas: HTMLCanvasElement) {
    new ResizeObserver(() => this.takeSize() && void this.refresh()).observe(canvas);
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, (event) => this.up(event));
    }
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  get scale(): number {
    return window.devicePixelRatio || 1;
  }

  /** The picture that the map shows. A map of all asks for all: its lines are wider. */
  get lookNow(): Look {
    const { width, height } = this.canvas;
    const view = this.isFit ? undefined : this.view;
    return { ...this.look, width, height, pxPerPoint: this.scale, ...view };
  }

  /** Forgets the picture of another layout. */
  reset(): void {
    this.shown?.image.close();
    this.shown = undefined;
    this.view = undefined;
    this.isFit = true;
  }

  /** Shows a view that somebody else saw. */
  show(view: View): void {
    this.view = { center: view.center, pxPerM: view.pxPerM };
    this.isFit = false;
  }

  /** Draws a new picture as soon as the last one is there. */
  async refresh(): Promise<void> {
    // The observer tells of a new size only once this picture has begun.
    this.takeSize();
    this.paint();
    this.wants = true;
    if (this.isDrawing || !this.canvas.width || !this.canvas.height) return;
    this.isDrawing = true;
    try {
      while (this.wants) {
        this.wants = false;
        await this.redraw();
      }
    } catch (error) {
      this.onfail(error);
    } finally {
      this.isDrawing = false;
    }
  }

  private async redraw(): Promise<void> {
    const look = this.lookNow;
    const { width, height } = look;
    const asked = this.view;
    const picture = await this.draw(look);
    const pixels = new Uint8ClampedArray(picture.rgba);
    const image = await createImageBitmap(new ImageData(pixels, width, height));
    this.shown?.image.close();
    const { center, pxPerM } = picture.report;
    this.shown = { image, view: { center, pxPerM } };
    const isSize = width === this.canvas.width && height === this.canvas.height;
    if (!this.view && !asked && isSize) this.view = { center, pxPerM };
    this.drawn++;
    this.paint();
    this.onreport(picture.report);
  }

  /** Shows all. */
  fit(): void {
    this.view = undefined;
    this.isFit = true;
    void this.refresh();
  }

  /** Shows a box, no nearer than 60 pixels per meter. */
  flyTo([minX, minY, maxX, maxY]: Box): void {
    const { width, height } = this.canvas;
    const near = 60 * this.scale;
    const fit = Math.min(width / (maxX - minX), height / (maxY - minY)) * FIT * 0.6;
    this.isFit = false;
    this.view = {
      center: [(minX + maxX) / 2, (minY + maxY) / 2],
      pxPerM: Math.min(Number.isFinite(fit) ? fit : near, near),
    };
    void this.refresh();
  }

  /** The world point at a place of the canvas, in its pixels. */
  world([x, y]: Point): Point {
    const { center, pxPerM } = this.view ?? { center: [0, 0], pxPerM: 1 };
    const { width, height } = this.canvas;
    return [center[0]! + (x - width / 2) / pxPerM, center[1]! - (y - height / 2) / pxPerM];
  }

  /** The place of a world point on the canvas, in its pixels. */
  pixel([x, y]: Point): Point {
    const { center, pxPerM } = this.view ?? { center: [0, 0], pxPerM: 1 };
    const { width, height } = this.canvas;
    return [width / 2 + (x - center[0]!) * pxPerM, height / 2 - (y - center[1]!) * pxPerM];
  }

  zoom(factor: number, at?: Point): void {
    if (!this.view) return;
    const { width, height } = this.canvas;
    const place = at ?? [width / 2, height / 2];
    const kept = this.world(place);
    const pxPerM = Math.min(Math.max(this.view.pxPerM * factor, 1e-6), 1e6);
    this.isFit = false;
    this.view = {
      center: [
        kept[0] - (place[0] - width / 2) / pxPerM,
        kept[1] + (place[1] - height / 2) / pxPerM,
      ],
      pxPerM,
    };
    void this.refresh();
  }

  pan(dx: number, dy: number): void {
    if (!this.view) return;
    this.isFit = false;
    const { center, pxPerM } = this.view;
    this.view = { center: [center[0] - dx / pxPerM, center[1] + dy / pxPerM], pxPerM };
    void this.refresh();
  }

  /** Paints the last picture with the next frame of the screen. */
  paint(): void {
    if (this.isPainting) return;
    this.isPainting = true;
    requestAnimationFrame(() => {
      this.isPainting = false;
      this.paintNow();
    });
  }

  private paintNow(): void {
    const pen = this.canvas.getContext("2d", { alpha: false })!;
    const { width, height } = this.canvas;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = `#${this.look.background ?? "ffffff"}`;
    pen.fillRect(0, 0, width, height);
    if (!this.shown) return;
    const { image, view } = this.shown;
    const [x, y] = this.view ? this.pixel(view.center) : [width / 2, height / 2];
    const ratio = this.view ? this.view.pxPerM / view.pxPerM : 1;
    const [w, h] = [image.width * ratio, image.height * ratio];
    // Whole pixels where nothing is scaled, so that what is shown is what was drawn.
    const round = ratio === 1 ? Math.round : (value: number) => value;
    pen.drawImage(image, round(x - w / 2), round(y - h / 2), w, h);
    this.overlay(pen, (point) => this.pixel(point));
    if (this.view === this.painted) return;
    this.painted = this.view;
    if (this.view) this.onview(this.view);
  }

  /** Takes the size that the page gives the canvas; returns `true` if it is another one. */
  private takeSize(): boolean {
    const { clientWidth, clientHeight } = this.canvas;
    const [width, height] = [clientWidth * this.scale, clientHeight * this.scale].map(Math.round);
    if (width === this.canvas.width && height === this.canvas.height) return false;
    this.canvas.width = width!;
    this.canvas.height = height!;
    if (this.isFit) this.view = undefined;
    return true;
  }

  private at(event: MouseEvent): Point {
    return [event.offsetX * this.scale, event.offsetY * this.scale];
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    this.zoom(Math.exp(-event.deltaY * lines * 0.002), this.at(event));
  }

  private down(event: PointerEvent): void {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, this.at(event));
    if (this.pointers.size > 1) {
      this.putBack();
      return;
    }
    this.moved = 0;
    this.isLifted = this.onlift(this.at(event));
  }

  /** What is being dragged goes back to where it was; returns `false` if nothing is. */
  putBack(): boolean {
    if (!this.isLifted) return false;
    this.isLifted = false;
    this.ondrag(undefined, false);
    return true;
  }

  private move(event: PointerEvent): void {
    const now = this.at(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.onpoint(now[0], now[1], false);
      return;
    }
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
    this.pointers.set(event.pointerId, now);
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    this.moved += Math.hypot(dx, dy);
    if (others.length === 0) {
      if (this.moved <= 4 * this.scale) return;
      if (this.isLifted) this.ondrag(now, false);
      else this.pan(dx, dy);
      return;
    }
    // Two fingers: the world points below them stay there.
    const other = others[0]![1];
    const ratio = distance(now, other) / Math.max(distance(before, other), 1);
    this.zoom(ratio, other);
    this.pan(dx / 2, dy / 2);
  }

  private up(event: PointerEvent): void {
    const isTap = this.pointers.size === 1 && this.moved <= 4 * this.scale;
    this.pointers.delete(event.pointerId);
    const [x, y] = this.at(event);
    const isUp = event.type === "pointerup";
    if (this.isLifted && !isTap && isUp) {
      this.isLifted = false;
      this.ondrag([x, y], true);
      return;
    }
    this.putBack();
    if (isTap && isUp) this.onpoint(x, y, true);
  }

  private key(event: KeyboardEvent): void {
    const step = 80 * this.scale;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.pan(step, 0),
      ArrowRight: () => this.pan(-step, 0),
      ArrowUp: () => this.pan(0, step),
      ArrowDown: () => this.pan(0, -step),
      "+": () => this.zoom(1.25),
      "-": () => this.zoom(0.8),
      "0": () => this.fit(),
      Home: () => this.fit(),
    };
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  }
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/** Draws the outline of an element over the picture. */
export function paintElement(
  pen: CanvasRenderingContext2D,
  at: (point: Point) => Point,
  element: Details,
  color: string,
  scale: number,
): void {
  pen.strokeStyle = color;
  pen.lineCap = pen.lineJoin = "round";
  for (const points of element.outline) {
    pen.beginPath();
    if (points.length === 1) {
      const [x, y] = at(points[0]!);
      pen.lineWidth = 3 * scale;
      pen.arc(x, y, 9 * scale, 0, 2 * Math.PI);
    } else {
      pen.lineWidth = 5 * scale;
      points.forEach((point, i) => {
        const [x, y] = at(point);
        if (i) pen.lineTo(x, y);
        else pen.moveTo(x, y);
      });
    }
    pen.globalAlpha = 0.75;
    pen.stroke();
    pen.globalAlpha = 1;
  }
}
