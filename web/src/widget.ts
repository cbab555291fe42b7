// The widget for notebooks: shows `<guideway-view>` and keeps it in step with the traits of
// python/guideway/_widget.py. Its default export is a module of anywidget.

import type { Box } from "./answers.js";
import { wordsOf } from "./engine.js";
import type { GuidewayView } from "./element.js";
import type { View } from "./map.js";
import "./exports.js";
import type { Vehicle } from "./vehicles.js";

/** The model of anywidget: traits by name. */
interface Model {
  get(trait: string): unknown;
  set(trait: string, value: unknown): void;
  save_changes(): void;
  on(event: string, listener: () => void): void;
  off(event: string, listener: () => void): void;
}

/** Where Python has sent the view last; `number` counts its wishes. */
interface Target {
  number: number;
  element?: string;
  box?: Box;
}

/** The vehicles of Python, and the time that they take to their places. */
interface Fleet {
  vehicles: Vehicle[];
  durationMs: number;
}

/** Switches of the element that show a site as it is. */
const SITE = ["arrows", "nodes", "stations", "labels", "scale-bar"];
/** Time between two reports of a moving view, in milliseconds. */
const REPORT_MS = 100;

/** A trait of bytes, as an address of this page. */
function addressOf(bytes: unknown): string {
  return URL.createObjectURL(new Blob([bytes as DataView<ArrayBuffer>]));
}

/** Gives the element its engine and fonts. Each widget loads this module anew, but the
 * first one defines the element, which compiles one engine for all. */
function provideEngine(model: Model): void {
  const element = customElements.get("guideway-view") as typeof GuidewayView;
  element.engineUrl ||= addressOf(model.get("_engine"));
  element.lettersUrl ||= addressOf(model.get("_letters"));
  element.symbolsUrl ||= addressOf(model.get("_symbols"));
}

/** Shows the model in `el`; returns what ends that. */
function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  provideEngine(model);
  const layout = addressOf(model.get("_layout"));
  const view = document.createElement("guideway-view");
  const trait = <T>(name: string) => model.get(name) as T;
  const isPlaced = () => trait("center") !== null && trait("scale") !== null;
  let isTelling = false;
  let isOpen = false;
  let reached = 0;

  const tell = (traits: Record<string, unknown>) => {
    isTelling = true;
    for (const [name, value] of Object.entries(traits)) model.set(name, value);
    isTelling = false;
    model.save_changes();
  };
  const fail = (error: unknown) => {
    // A view that is removed stops its engine; one that returns takes all traits again.
    if (view.isConnected) tell({ error: wordsOf(error).replaceAll("\n", " ") });
  };

  const dress = () => {
    const attribute = (name: string, value: string | null) => {
      if (value === null) view.removeAttribute(name);
      else if (view.getAttribute(name) !== value) view.setAttribute(name, value);
    };
    const isOn = (name: string, on: boolean) => attribute(name, on ? "" : null);
    const colorBy = trait<string | null>("color_by");
    attribute("color-by", colorBy);
    attribute("level", trait("level"));
    isOn("legend", colorBy !== null);
    isOn("dark", trait("dark"));
    for (const name of SITE) isOn(name, trait("site"));
    view.style.cssText = `display: block; width: 100%; height: ${trait<number>("height")}px`;
  };

  /** Goes where Python wants: to its last target, or to its center and scale. */
  const go = () => {
    const target = trait<Target | null>("_target");
    const now = view.view;
    if (!isOpen || isTelling) return;
    if (target && target.number !== reached) {
      reached = target.number;
      const goal = target.element ?? target.box;
      if (goal === undefined) view.fit();
      else view.flyTo(goal).catch(fail);
      return;
    }
    const center = trait<View["center"] | null>("center") ?? now?.center;
    const pxPerM = trait<number | null>("scale") ?? now?.pxPerM;
    if (!center || pxPerM === undefined) return;
    const isThere = now?.pxPerM === pxPerM && String(now.center) === String(center);
    if (!isThere) view.view = { center, pxPerM };
  };
  const select = () => {
    if (isOpen && !isTelling) view.select(trait("selected")).catch(fail);
  };
  const hover = () => {
    if (isOpen && !isTelling) view.pointAt(trait("hovered")).catch(fail);
  };
  const highlight = () => {
    if (isOpen) view.highlight(trait<string[]>("highlight")).catch(fail);
  };
  const move = () => {
    const { vehicles, durationMs } = trait<Fleet>("_fleet");
    try {
      view.setVehicles(vehicles, { durationMs });
    } catch (error) {
      fail(error);
    }
  };

  view.addEventListener("load", () => {
    isOpen = true;
    tell({ error: null });
    if (isPlaced()) reached = trait<Target | null>("_target")?.number ?? 0;
    go();
    select();
    hover();
    highlight();
  });
  view.addEventListener("error", ({ error, message }) => fail(error ?? message));
  view.addEventListener("select", ({ detail }) => tell({ selected: detail?.id ?? null }));
  view.addEventListener("hover", ({ detail }) => tell({ hovered: detail?.id ?? null }));
  let report: ReturnType<typeof setTimeout> | undefined;
  view.addEventListener("viewchange", () => {
    report ??= setTimeout(() => {
      report = undefined;
      if (view.view) tell({ center: view.view.center, scale: view.view.pxPerM });
    }, REPORT_MS);
  });

  const listeners: [() => void, string[]][] = [
    [dress, ["color_by", "level", "dark", "site", "height"]],
    [go, ["center", "scale", "_target"]],
    [select, ["selected"]],
    [hover, ["hovered"]],
    [highlight, ["highlight"]],
    [move, ["_fleet"]],
  ];
  const each = (act: (event: string, listener: () => void) => void) => {
    for (const [of, names] of listeners) names.forEach((name) => act(`change:${name}`, of));
  };
  each((event, of) => model.on(event, of));
  dress();
  if (isPlaced()) {
    view.setAttribute("center", String(trait("center")));
    view.setAttribute("scale", String(trait("scale")));
  }
  view.setAttribute("controls", "");
  view.setAttribute("src", `${layout}#${encodeURIComponent(trait<string>("_name"))}`);
  move();
  // Keys are for the map while it has the focus, not for the notebook: JupyterLab looks here.
  view.dataset["lmSuppressShortcuts"] = "true";
  el.append(view);

  return () => {
    clearTimeout(report);
    each((event, of) => model.off(event, of));
    view.remove();
    URL.revokeObjectURL(layout);
  };
}

export default { render };
