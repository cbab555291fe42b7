// `<guideway-view>`: a layout in a page of others, with events, and vehicles that move.

import type { Box, Details, EditStep, EditedStep, Findings, Info } from "./answers.js";
import type { Look, Picture, Point } from "./answers.js";
import type { Placement, Report, Route, Sample, Summary } from "./answers.js";
import { besideModule, compiled, download, nameOf } from "./download.js";
import { BrokenEngine, Engine, GuidewayError, wordsOf } from "./engine.js";
import type { ElementName, GuidewayViewEvents, Picked } from "./events.js";
import { DARK, GuidewayMap, LIGHT, paintElement, type View } from "./map.js";
import { Pointer } from "./pointer.js";
import { Shadow } from "./shadow.js";
import { t } from "./text.js";
import { type Threaded, threadCount } from "./threads.js";
import { Fleet, type Vehicle } from "./vehicles.js";

const SWITCHES = ["arrows", "nodes", "stations", "labels", "grid", "scale-bar", "legend"] as const;
const TEXTS = ["color-by", "level", "color", "background"] as const;
const HIGHLIGHT = "#d55e00";

/** `scale-bar` as `scaleBar`. */
function camel(name: string): string {
  return name.replace(/-(.)/g, (_, letter: string) => letter.toUpperCase());
}

// Servers that render pages have no elements, but may load this module.
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

export class GuidewayView extends Base {
  static readonly observedAttributes = [
    ...["src", "center", "scale", "shade", "dark", "aria-label"],
    ...TEXTS,
    ...SWITCHES,
  ];
  /** The address of the engine; set it before the first element is in a page. */
  static engineUrl: string | URL = besideModule(
    () => new URL("./engine.wasm.gz", import.meta.url),
  );
  /** The address of the font of rare letters, which is fetched when a name has one. */
  static lettersUrl: string | URL = besideModule(
    () => new URL("./letters.ttf.gz", import.meta.url),
  );
  /** The address of the font of symbols, which is fetched when a name has one. */
  static symbolsUrl: string | URL = besideModule(
    () => new URL("./symbols.ttf.gz", import.meta.url),
  );
  /** The address of the engine of several threads, for pages that are isolated; "" for none. */
  static threadedEngineUrl: string | URL = "";
  /** The source of its workers, of the npm package. */
  static threadedWorker = "";

  private readonly shadow: Shadow;
  private readonly map: GuidewayMap;
  private readonly pointer = new Pointer((...call) => this.call(...call));
  private readonly fleet = new Fleet();
  private engine: Engine | undefined;
  private opened: Info | undefined;
  private loading: AbortController | undefined;
  /** Colors or density, as the first picture of the layout needs. */
  private shade: Look["shade"] | undefined;
  private extra: Partial<Look> = {};
  private hasFloorPlan = false;
  private highlighted: Details[] = [];
  private highlightColor = HIGHLIGHT;
  /** The last call for each purpose: of two, the later one holds, whichever answer comes last. */
  private readonly last = new Map<"highlight" | "select" | "point", Promise<unknown>>();
  private hovered: Picked | undefined;
  private selectedVehicle: string | undefined;

  constructor() {
    super();
    this.shadow = new Shadow(this.attachShadow({ mode: "open" }));
    this.map = new GuidewayMap(this.shadow.canvas);
    this.map.draw = (look) => {
      if (!this.opened) return Promise.reject(new GuidewayError("usage", "", ""));
      return this.call<Picture>("render", [look]);
    };
    this.map.onreport = (report) => this.drawn(report);
    this.map.onfail = (error) => {
      if (this.opened) this.fail(error);
    };
    this.map.onview = (view) => this.tell("viewchange", this.outside(view));
    this.map.onpoint = (x, y, isClick) => void this.point([x, y], isClick);
    this.map.overlay = (pen, at) => this.paintOver(pen, at);
    this.map.canvas.addEventListener("pointerleave", () => this.hover(undefined));
    this.fleet.isShown = (level) => this.isShown(level);
    const actions = [() => this.map.zoom(1.5), () => this.map.zoom(1 / 1.5), () => this.map.fit()];
    this.shadow.buttons.forEach((button, i) => (button.onclick = actions[i]!));
  }

  connectedCallback(): void {
    if (this.engine) return;
    const { engineUrl, lettersUrl, symbolsUrl } = GuidewayView;
    const fonts = [lettersUrl, symbolsUrl].map((url) => ({ url: String(url) }));
    const engine = () => compiled(String(engineUrl));
    this.engine = new Engine(engine, fonts, GuidewayView.threaded());
    this.engine.onprogress = (share) => this.shadow.advance(share);
    this.dress();
    void this.load();
  }

  /** The engine of several threads, if this page has one and may share memory. */
  private static threaded(): Threaded | undefined {
    const { threadedEngineUrl: url, threadedWorker: worker } = GuidewayView;
    const count = threadCount();
    if (!worker || !String(url) || count === 1) return undefined;
    return { worker, engine: () => compiled(String(url)), count };
  }

  disconnectedCallback(): void {
    // An element that only moves within its page keeps its layout.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.loading?.abort();
      this.engine?.stop();
      this.engine = undefined;
      this.close();
    });
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (!this.engine || before === now) return;
    if (name === "src") void this.load();
    else if (name === "center" || name === "scale") this.view = this.attributeView();
    else this.dress();
  }

  /** The open layout: its counts, levels and columns. */
  get info(): Info | undefined {
    return this.opened;
  }

  /** How many threads draw: one, unless the page is isolated from other origins. */
  get threads(): number {
    return this.engine?.threadCount ?? 1;
  }

  /** The part that is shown, in CSS pixels per meter; assign it to show another one. */
  get view(): View | undefined {
    return this.map.view && this.outside(this.map.view);
  }

  set view(view: View | undefined) {
    if (view) {
      this.map.show(this.inside(view));
      void this.map.refresh();
    } else {
      this.map.fit();
    }
  }

  /** What pictures show beyond the attributes, such as `{ route: { from, to } }`. */
  get look(): Partial<Look> {
    return this.extra;
  }

  set look(look: Partial<Look>) {
    this.extra = look;
    this.dress();
  }

  /** Opens a file in place of `src`; its content decides the format. */
  async open(file: File): Promise<Info> {
    this.loading?.abort();
    const loading = (this.loading = new AbortController());
    return this.openBytes(file.name, await file.arrayBuffer(), loading.signal);
  }

  /**
   * Shows a file below the paths: a layout, a drawing, or an image with its place. `null` removes
   * it, as another layout does.
   */
  async setFloorPlan(file: File | null, placement?: Placement): Promise<void> {
    if (file) {
      const bytes = await file.arrayBuffer();
      await this.call("floorPlan", [file.name, bytes, placement ?? null], [bytes]);
    }
    this.hasFloorPlan = file !== null;
    this.dress();
  }

  /** Shows all of the layout. */
  fit(): void {
    this.map.fit();
  }

  /** Shows an element, a box (least x, least y, greatest x, greatest y in meters) or a view. */
  async flyTo(target: ElementName | Box | View): Promise<void> {
    if (Array.isArray(target)) this.map.flyTo(target);
    else if (typeof target === "object" && "center" in target) this.view = target;
    else {
      const { bounds } = await this.details(target);
      if (bounds) this.map.flyTo(bounds);
    }
  }

  /** Outlines elements in a color, in place of those before; an empty list ends it. */
  async highlight(of: Iterable<ElementName>, color = HIGHLIGHT): Promise<void> {
    const found = Promise.all([...of].map((name) => this.details(name)));
    await this.settle("highlight", found, (found) => {
      this.highlighted = found;
      this.highlightColor = color;
    });
  }

  /** Selects an element as a click does, without an event. */
  async select(of: ElementName | null): Promise<void> {
    const vehicle = this.vehicleNamed(of);
    await this.settle("select", this.outlined(of), (found) => {
      this.selectedVehicle = vehicle?.id;
      this.pointer.selected = found;
    });
  }

  /** Outlines an element as the pointer does, without an event. */
  async pointAt(of: ElementName | null): Promise<void> {
    await this.settle("point", this.outlined(of), (found) => {
      this.pointer.hovered = found;
    });
  }

  /** Applies an answer, unless a later call for the same purpose has begun. */
  private async settle<T>(
    purpose: "highlight" | "select" | "point",
    answer: Promise<T>,
    apply: (found: T) => void,
  ): Promise<void> {
    this.last.set(purpose, answer);
    const found = await answer;
    if (this.last.get(purpose) !== answer) return;
    apply(found);
    this.map.paint();
  }

  /** The element that gets an outline; vehicles are painted otherwise. */
  private async outlined(of: ElementName | null): Promise<Details | undefined> {
    return of === null || this.vehicleNamed(of) ? undefined : this.details(of);
  }

  private vehicleNamed(of: ElementName | null): Vehicle | undefined {
    return typeof of === "string" ? this.fleet.get(of) : undefined;
  }

  /** Replaces all vehicles. Those that are elsewhere now go there within `durationMs`. */
  setVehicles(vehicles: Iterable<Vehicle>, { durationMs = 0 } = {}): void {
    this.fleet.set(vehicles, durationMs, performance.now());
    this.map.paint();
  }

  /** Id, box, properties and outline of an element. */
  async details(of: ElementName): Promise<Details> {
    if (typeof of !== "string") return this.pointer.details(of);
    const found = (await this.find(of)).find(({ id }) => id === of);
    if (found) return this.pointer.details(found);
    const message = `the layout has no path, node or station \`${of}\``;
    throw new GuidewayError("usage", message, "Write its name as the file does");
  }

  /** Elements whose name contains a text, those that have it first. */
  find(text: string, limit = 100): Promise<Summary[]> {
    return this.call("find", [text, limit]);
  }

  /** Paths for which a condition such as `maxSpeed > 1` holds: their number, the first ones. */
  query(condition: string, limit = 100): Promise<{ all: number; elements: Summary[] }> {
    return this.call("query", [condition, limit]);
  }

  /** Points of a path from start to end, at equal distances of at most `spacingM` along it. */
  async sample(path: ElementName, spacingM: number): Promise<Sample[]> {
    const { kind, row } = await this.details(path);
    if (kind === "path") return this.call("sample", [row, spacingM]);
    throw new GuidewayError("usage", `a ${kind} has no points along it`, "Name a path");
  }

  /** The fastest route between two stations or nodes. */
  route(ends: NonNullable<Look["route"]>): Promise<Route> {
    return this.call("route", [ends]);
  }

  /** The findings about the layout, the most severe ones first. */
  check(limit = 100): Promise<Findings> {
    return this.call("check", [limit]);
  }

  /** The picture as it is shown, without vehicles, as a file. */
  async picture(format: "png" | "svg" | "pdf" = "png"): Promise<Blob> {
    const look = this.map.lookNow;
    const bytes =
      format === "png"
        ? await this.call<ArrayBuffer>("png", [look])
        : await this.call<ArrayBuffer>("curves", [look, format]);
    return new Blob([bytes]);
  }

  /** The layout in a format of `info.targets`, and what the file does not hold. */
  async save(format: string): Promise<{ file: Blob; losses: string[] }> {
    type Saved = { bytes: ArrayBuffer; losses: string[] };
    const { bytes, losses } = await this.call<Saved>("save", [format]);
    return { file: new Blob([bytes]), losses };
  }

  /** Edits the layout by steps, by all of them or by none; says what each has touched. */
  async edit(...steps: EditStep[]): Promise<EditedStep[]> {
    const before = this.opened;
    const edited = await this.call<{ info: Info; steps: EditedStep[] }>("edit", [steps]);
    this.changed(before, edited.info);
    return edited.steps;
  }

  /** Takes the last edit back; `false` if there is none. */
  async undo(): Promise<boolean> {
    return this.changed(this.opened, await this.call<Info | null>("undo"));
  }

  /** Performs an edit again that was taken back; `false` if there is none. */
  async redo(): Promise<boolean> {
    return this.changed(this.opened, await this.call<Info | null>("redo"));
  }

  /** The layout was edited, unless another one is open by now: rows may name other elements. */
  private changed(before: Info | undefined, info: Info | null): boolean {
    if (!info) return false;
    if (before !== this.opened) return true;
    this.opened = info;
    this.pointer.forget();
    this.last.clear();
    this.highlighted = [];
    void this.map.refresh();
    return true;
  }

  private call<T>(...call: Parameters<Engine["call"]>): Promise<T> {
    if (this.engine) return this.engine.call<T>(...call);
    const remedy = "Put it into the document first";
    return Promise.reject(new GuidewayError("usage", "the element is in no document", remedy));
  }

  private async load(): Promise<void> {
    this.loading?.abort();
    const src = this.getAttribute("src");
    this.close();
    if (!src) return;
    const { signal } = (this.loading = new AbortController());
    try {
      const url = new URL(src, this.baseURI);
      const name = nameOf(url) || src;
      const shown = url.protocol === "blob:" ? name : src;
      this.shadow.busy(`${shown}: ${t("reading")}`);
      await this.openBytes(name, await download(url, shown, signal), signal);
    } catch (error) {
      if (!signal.aborted) this.fail(error);
    }
  }

  private async openBytes(name: string, bytes: ArrayBuffer, signal: AbortSignal): Promise<Info> {
    this.shadow.busy(`${name}: ${t("reading")}`);
    try {
      const info = await this.call<Info>("open", [name, bytes], [bytes]);
      signal.throwIfAborted();
      this.close();
      this.opened = info;
      const view = this.attributeView();
      if (view) this.map.show(this.inside(view));
      this.dress();
      this.tell("load", info);
      return info;
    } finally {
      if (!signal.aborted) this.shadow.busy("");
    }
  }

  private close(): void {
    this.opened = this.shade = this.hovered = this.selectedVehicle = undefined;
    this.highlighted = [];
    this.hasFloorPlan = false;
    this.last.clear();
    this.pointer.forget();
    this.map.reset();
    this.map.paint();
    this.shadow.warn("");
    this.shadow.busy("");
  }

  /** The view that the attributes name. */
  private attributeView(): View | undefined {
    const [x, y] = (this.getAttribute("center") ?? "").split(",").map(parseFloat);
    const pxPerM = parseFloat(this.getAttribute("scale") ?? "");
    const isView = [x, y, pxPerM].every(Number.isFinite) && pxPerM > 0;
    return isView ? { center: [x!, y!], pxPerM } : undefined;
  }

  /** A view in pixels of the canvas, and in CSS pixels. */
  private inside({ center, pxPerM }: View): View {
    return { center, pxPerM: pxPerM * this.map.scale };
  }

  private outside({ center, pxPerM }: View): View {
    return { center, pxPerM: pxPerM / this.map.scale };
  }

  /** Takes colors and decorations from the attributes. */
  private dress(): void {
    const look: Record<string, unknown> = { ...(this.hasAttribute("dark") ? DARK : LIGHT) };
    for (const name of TEXTS) {
      const value = this.getAttribute(name)?.replace(/^#/, "");
      if (value) look[camel(name)] = value;
    }
    for (const name of SWITCHES) look[camel(name)] = this.hasAttribute(name);
    const shade = this.getAttribute("shade") ?? "auto";
    look["floorPlan"] = this.hasFloorPlan;
    look["shade"] = shade === "auto" ? (this.shade ?? shade) : shade;
    this.map.look = { ...look, ...this.extra };
    this.shadow.label(this.getAttribute("aria-label"));
    void this.map.refresh();
  }

  private drawn(report: Report): void {
    this.shadow.warn("");
    if (this.map.look.shade !== "auto") return;
    // Once per layout: a view that changed its shading by itself would confuse.
    this.shade = this.map.look.shade = report.density ? "density" : "color";
  }

  private async point(at: Point, isClick: boolean): Promise<void> {
    if (!this.opened || !this.map.view) return;
    const { scale, view } = this.map;
    const vehicle = this.fleet.hit(this.map.world(at), view, scale, performance.now());
    try {
      if (!vehicle && !(await this.pointer.point(at, isClick, scale))) return;
    } catch (error) {
      this.fail(error);
      return;
    }
    const element = vehicle
      ? ({ kind: "vehicle", id: vehicle.id, vehicle } as const)
      : this.pointer.hovered;
    if (vehicle) this.pointer.hovered = undefined;
    this.hover(element);
    if (!isClick) return;
    this.selectedVehicle = vehicle?.id;
    if (vehicle) this.pointer.selected = undefined;
    this.tell("select", element ?? null);
    this.map.paint();
  }

  private hover(element: Picked | undefined): void {
    const isSame = this.hovered?.kind === element?.kind && this.hovered?.id === element?.id;
    this.hovered = element;
    if (isSame) return;
    this.map.canvas.style.cursor = element ? "pointer" : "";
    if (!element) this.pointer.hovered = undefined;
    this.tell("hover", element ?? null);
    this.map.paint();
  }

  private isShown(level: string | undefined): boolean {
    const shown = this.map.look.level;
    if (!shown || !level || level === shown) return true;
    const of = this.opened?.levels.find(({ id }) => id === level);
    return of?.name === shown;
  }

  private paintOver(pen: CanvasRenderingContext2D, at: (point: Point) => Point): void {
    const { view, scale, look } = this.map;
    const style = getComputedStyle(this);
    const accent = style.getPropertyValue("--guideway-accent").trim() || "#0b63b5";
    for (const of of this.highlighted) paintElement(pen, at, of, this.highlightColor, scale);
    for (const of of [this.pointer.hovered, this.pointer.selected]) {
      if (of) paintElement(pen, at, of, accent, scale);
    }
    if (!view) return;
    const [paper, ink] = [`#${look.background}`, `#${look.color}`];
    const nowMs = performance.now();
    const sheet = { pen, at, view, scale, paper, ink, accent };
    this.fleet.paint(sheet, this.selectedVehicle, nowMs);
    if (this.fleet.isMoving(nowMs)) this.map.paint();
  }

  private fail(error: unknown): void {
    this.shadow.busy("");
    // The engine that starts in its place has no layout.
    if (error instanceof BrokenEngine) this.close();
    this.shadow.warn(wordsOf(error));
    const message = error instanceof Error ? error.message : String(error);
    this.dispatchEvent(new ErrorEvent("error", { error, message }));
  }

  private tell(event: keyof GuidewayViewEvents, detail: unknown): void {
    this.dispatchEvent(new CustomEvent(event, { detail }));
  }
}

export interface GuidewayView {
  addEventListener<K extends keyof GuidewayViewEvents>(
    type: K,
    listener: (this: GuidewayView, event: GuidewayViewEvents[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject | null,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

declare global {
  interface HTMLElementTagNameMap {
    "guideway-view": GuidewayView;
  }
}
