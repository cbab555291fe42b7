// The page: opens files and the shared layout, joins map, panels and engine.

import type { Details, Finding, Info, Picture, Placement } from "./answers.js";
import type { EditStep, EditedStep, Reference, Shared } from "./answers.js";
import { Drawing, created } from "./drawing.js";
import { BrokenEngine, Engine, GuidewayError, wordsOf } from "./engine.js";
import { unpackedText } from "./gzip.js";
import { GuidewayMap, paintElement } from "./map.js";
import { Panels, byId, cells, item } from "./panels.js";
import { connectPlan } from "./plan.js";
import { Pointer } from "./pointer.js";
import { count, language, meters, t } from "./text.js";
import { TOOLS, Tools } from "./tools.js";

/** Largest file that fits into the memory of a page beside its layout. */
const MAX_BYTES = 1_500_000_000;
/** Paths whose length one call adds up: 40 ms on a slow processor. */
const LENGTH_ROWS = 50_000;

const packedEngine = byId("engine").textContent!.trim();
const shared: Shared | undefined = readShared();
/** The fonts that are in the page, in the order in which a letter is sought in them. */
const fonts = ["letters", "symbols"].flatMap((id) => {
  const packed = document.getElementById(id)?.textContent?.trim();
  return packed ? [{ packed }] : [];
});
const engine = new Engine(() => packedEngine, fonts);
const map = new GuidewayMap(byId<HTMLCanvasElement>("map"));
const panels = new Panels();
const pointer = new Pointer((...call) => engine.call(...call));
const tools = new Tools(map, pointer, new Drawing((...call) => engine.call(...call)));

let info: Info | undefined;
/** The layout whose length is known or being added up. */
let summed: Info | undefined;

/** A file that is in the page. */
function packed(id: string): string {
  return byId(id).textContent!.trim();
}

function readShared(): Shared | undefined {
  const text = document.getElementById("shared")?.textContent;
  return text ? JSON.parse(text) : undefined;
}

function notice(error: unknown): void {
  byId("notice-text").textContent = wordsOf(error);
  byId("notice").hidden = false;
  if (error instanceof BrokenEngine) close();
}

/** Shows the start again, where a file may be opened. */
function close(): void {
  info = undefined;
  document.body.classList.add("empty");
  forget();
  map.reset();
  byId("start").hidden = shared !== undefined;
}

function forget(): void {
  pointer.forget();
  tools.takeUp(undefined);
  // They name elements and areas of the layout that was open.
  delete map.look.route;
  delete map.look.envelope;
  panels.clear();
}

async function busy<T>(text: string, work: () => Promise<T>): Promise<T | undefined> {
  byId("busy-text").textContent = text;
  byId<HTMLProgressElement>("progress").removeAttribute("value");
  byId("busy").hidden = false;
  try {
    return await work();
  } catch (error) {
    notice(error);
    return undefined;
  } finally {
    byId("busy").hidden = true;
  }
}

async function open(file: File): Promise<void> {
  byId("notice").hidden = true;
  if (file.size > MAX_BYTES) {
    const words = `${file.name} ${t("is larger than this page can hold")}`;
    notice(new GuidewayError("limit", words, t("Use the command `guideway`")));
    return;
  }
  const opened = await busy(`${file.name}: ${t("reading")}`, async () => {
    const bytes = await file.arrayBuffer();
    return engine.call<Info>("open", [file.name, bytes], [bytes]);
  });
  if (!opened) return;
  // A plan belongs to the layout that it was added to.
  for (const id of ["floor-plan-of", "plan-place"]) byId(id).hidden = true;
  show(opened);
}

/** Shows a file below the paths. */
async function addPlan(file: File, placement: Placement | null): Promise<void> {
  const isRead = await busy(`${file.name}: ${t("reading")}`, async () => {
    const bytes = await file.arrayBuffer();
    await engine.call("floorPlan", [file.name, bytes, placement], [bytes]);
    return true;
  });
  if (!isRead) return;
  byId("floor-plan-of").hidden = false;
  byId<HTMLInputElement>("floorPlan").checked = true;
  panels.readLook(map.look);
  void map.refresh();
}

function show(opened: Info): void {
  forget();
  if (shared) opened.targets = [{ id: "arrow", name: "Arrow", extension: ".arrow" }];
  info = opened;
  document.body.classList.remove("empty");
  map.reset();
  byId("start").hidden = true;
  byId("title").textContent = shared?.title || info.name;
  document.title = `${shared?.title || info.name} - Guideway`;
  panels.showInfo(info);
  const look = shared?.look ?? {};
  panels.setLook({ shade: "auto", ...look });
  panels.readLook(map.look);
  // Whoever shared it has checked it.
  if (look.envelope) map.look.envelope = look.envelope;
  if (look.center && look.pxPerM) {
    // A shared view shows at least as much as its sender saw.
    const ratio = Math.min(
      map.canvas.width / (look.width || map.canvas.width),
      map.canvas.height / (look.height || map.canvas.height),
    );
    map.show({ center: look.center, pxPerM: look.pxPerM * ratio });
  }
  void map.refresh();
}

/** Adds up the length of all paths, some at a time: a picture never waits long for it. */
async function sumLength(of: Info): Promise<void> {
  let lengthM = 0;
  for (let first = 0; first < of.paths; first += LENGTH_ROWS) {
    lengthM += await engine.call<number>("length", [first, LENGTH_ROWS]);
    if (info !== of) return;
  }
  panels.showLength(lengthM);
}

tools.onstatus = (text) => panels.status(text);
tools.info = () => info;
map.draw = (look) => {
  if (!info) return Promise.reject(new GuidewayError("usage", "", ""));
  return engine.call<Picture>("render", [look]);
};
map.onreport = (report) => {
  if (map.look.shade === "auto") {
    // Once per layout: a view that changed its shading by itself would confuse.
    const shade = report.density ? "density" : "color";
    map.look.shade = shade;
    const envelope = byId<HTMLInputElement>("envelope").value;
    panels.setLook({ ...map.look, shade, envelope });
  }
  if (info && info !== summed) {
    summed = info;
    sumLength(info).catch(map.onfail);
  }
  const drawn = `${count(report.drawn)} / ${count(report.total)} ${t("paths")}`;
  // What to do next stays there.
  if (!tools.tool) panels.status(drawn);
};
map.onfail = (error) => {
  if (info) notice(error);
};

map.overlay = (pen, at) => {
  const accent = getComputedStyle(document.documentElement).getPropertyValue("--accent");
  for (const element of [pointer.hovered, pointer.selected]) {
    if (element) paintElement(pen, at, element, accent, map.scale);
  }
  tools.paint(pen, at, accent);
};

map.onpoint = async (x, y, isClick) => {
  if (!info) return;
  if (tools.point([x, y], isClick)) return;
  // What is being typed stays where it is.
  if (!isClick && byId("element").querySelector("input")) return;
  try {
    if (!(await pointer.point([x, y], isClick, map.scale))) return;
    if (isClick && pointer.selected) panels.tab("layout");
    panels.showElement(pointer.hovered ?? pointer.selected);
    map.paint();
  } catch (error) {
    map.onfail(error);
  }
};

async function flyTo(of: Reference): Promise<void> {
  try {
    pointer.selected = await pointer.details(of);
    pointer.hovered = undefined;
    panels.showElement(pointer.selected);
    if (pointer.selected.bounds) map.flyTo(pointer.selected.bounds);
  } catch (error) {
    notice(error);
  }
}

async function find(text: string): Promise<void> {
  panels.showFound([], "");
  if (!info || !text.trim()) return;
  try {
    if (/[<>=~]|\b(and|or|not|in)\b/.test(text)) {
      const found = await engine.call<{ all: number; elements: Details[] }>("query", [text, 100]);
      panels.showFound(found.elements, `${count(found.all)} ${t("found")}`, flyTo);
    } else {
      const found = await engine.call<Details[]>("find", [text, 100]);
      panels.showFound(found, `${count(found.length)} ${t("found")}`, flyTo);
    }
  } catch (error) {
    if (!(error instanceof GuidewayError)) throw error;
    panels.showFound([], `${error.message}: ${error.remedy}`);
  }
}

async function showRoute(): Promise<void> {
  const [from, to] = ["from", "to"].map((id) => byId<HTMLInputElement>(id).value.trim());
  const vehicleType = byId<HTMLSelectElement>("vehicle-type").value || undefined;
  const ends = { from: from!, to: to!, ...(vehicleType ? { vehicleType } : {}) };
  try {
    const route = await engine.call<{ lengthM: number; timeS: number }>("route", [ends]);
    byId("route-text").textContent = `${meters(route.lengthM)}, ${count(route.timeS)} s`;
    map.look.route = ends;
  } catch (error) {
    if (!(error instanceof GuidewayError)) throw error;
    byId("route-text").textContent = `${error.message}. ${error.remedy}`;
    delete map.look.route;
  }
  void map.refresh();
}

async function showEnvelope(text: string): Promise<void> {
  delete map.look.envelope;
  byId("envelope-text").textContent = "";
  const isLate = () => byId<HTMLInputElement>("envelope").value.trim() !== text;
  try {
    if (text) {
      await engine.call("envelope", [text]);
      if (isLate()) return;
      map.look.envelope = text;
    }
  } catch (error) {
    if (!(error instanceof GuidewayError)) return notice(error);
    if (isLate()) return;
    byId("envelope-text").textContent = `${error.message}. ${error.remedy}.`;
  }
  void map.refresh();
}

async function edit(steps: EditStep[], of = pointer.hovered ?? pointer.selected): Promise<void> {
  const last = steps.at(-1)!;
  const edited = await busy(t("editing"), async () => {
    type Edited = { info: Info; steps: EditedStep[] };
    const { info, steps: touched } = await engine.call<Edited>("edit", [steps]);
    return { info, made: await created((...call) => engine.call(...call), last, touched) };
  });
  if (edited) await showEdited(edited.info, last.do === "delete" ? undefined : edited.made ?? of);
}

async function takeBack(call: "undo" | "redo"): Promise<void> {
  if (!info) return;
  const before = await busy(t("editing"), () => engine.call<Info | null>(call));
  if (before) await showEdited(before);
}

/** Shows the layout after an edit; the element keeps its row. */
async function showEdited(edited: Info, of?: Reference): Promise<void> {
  info = edited;
  panels.showFacts(info);
  panels.readLook(map.look);
  pointer.forget();
  if (of) pointer.selected = await pointer.details(of).catch(() => undefined);
  panels.showElement(pointer.selected);
  // What was found may be gone, and the ends of a route too.
  panels.clearFound();
  await find(byId<HTMLInputElement>("query").value);
  if (map.look.route) await showRoute();
  if (map.look.envelope) await showEnvelope(map.look.envelope);
  await map.refresh();
}

async function check(): Promise<void> {
  if (!info || panels.hasFindings) return;
  const found = await busy(t("checking"), () =>
    engine.call<{ errors: number; warnings: number; all: number; findings: Finding[] }>("check", [
      500,
    ]),
  );
  if (found) panels.showFindings(found, (of) => void flyTo(of));
}

async function compare(file: File): Promise<void> {
  const found = await busy(`${file.name}: ${t("reading")}`, async () => {
    const bytes = await file.arrayBuffer();
    return engine.call<import("./answers.js").Diff>("diff", [file.name, bytes, 300], [bytes]);
  });
  if (found) panels.showChanges(found);
}

function download(name: string, bytes: ArrayBuffer): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function stem(): string {
  return info!.name.replace(/\.[^/]*$/, "") || "layout";
}

async function savePicture(format: string): Promise<void> {
  const look = map.lookNow;
  const call = format === "png" ? "png" : "curves";
  const bytes = await busy(t("Picture"), () => engine.call<ArrayBuffer>(call, [look, format]));
  if (bytes) download(`${stem()}.${format}`, bytes);
}

/** Saves the layout in a format, or the file that is in the page. */
async function saveAs(target: Info["targets"][number]): Promise<void> {
  if (shared) return download(shared.name, await unpackedText(packed("layout")));
  type Saved = { bytes: ArrayBuffer; losses: string[] };
  const saved = await busy(target.name, () => engine.call<Saved>("save", [target.id]));
  if (!saved) return;
  download(stem() + (target.extension ?? `.${target.id}.json`), saved.bytes);
  const losses = saved.losses.join("; ");
  byId("losses").textContent = losses && `${t("not in the file")}: ${losses}`;
}

function connect(): void {
  const chosen = byId<HTMLInputElement>("file");
  for (const id of ["open", "choose"]) byId(id).onclick = () => chosen.click();
  chosen.onchange = () => {
    if (chosen.files?.[0]) void open(chosen.files[0]);
    chosen.value = "";
  };
  const other = byId<HTMLInputElement>("other-file");
  byId("compare").onclick = () => other.click();
  other.onchange = () => {
    if (other.files?.[0]) void compare(other.files[0]);
    other.value = "";
  };
  addEventListener("dragover", (event) => {
    event.preventDefault();
    byId("start").classList.add("over");
  });
  addEventListener("dragleave", () => byId("start").classList.remove("over"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    byId("start").classList.remove("over");
    const file = event.dataTransfer?.files[0];
    if (file && !shared) void open(file);
  });
  byId("fit").onclick = () => map.fit();
  byId("zoom-in").onclick = () => map.zoom(1.5);
  byId("zoom-out").onclick = () => map.zoom(1 / 1.5);
  for (const tool of TOOLS) {
    // A page that only shows draws nothing.
    byId(tool).hidden = shared !== undefined && tool !== "measure";
    byId(tool).onclick = () => tools.takeUp(tools.tool === tool ? undefined : tool);
  }
  byId("cancel").onclick = () => {
    engine.restart(t("Cancel"));
    close();
  };
  byId("notice-close").onclick = () => (byId("notice").hidden = true);
  byId<HTMLInputElement>("query").oninput = (event) =>
    void find((event.target as HTMLInputElement).value);
  byId<HTMLFormElement>("route").onsubmit = (event) => {
    event.preventDefault();
    void showRoute();
  };
  byId<HTMLFormElement>("route").onreset = () => {
    delete map.look.route;
    byId("route-text").textContent = "";
    void map.refresh();
  };
  byId("envelope").onchange = (event) =>
    void showEnvelope((event.target as HTMLInputElement).value.trim());
  for (const button of document.querySelectorAll<HTMLElement>("[data-picture]")) {
    button.onclick = () => void savePicture(button.dataset["picture"]!);
  }
  connectPlan((file, placement) => void addPlan(file, placement));
  panels.onlook = () => {
    panels.readLook(map.look);
    void map.refresh();
  };
  panels.ontab = (tab) => {
    if (tab === "findings") void check();
  };
  panels.ontarget = (target) => void saveAs(target);
  if (!shared) {
    panels.onedit = (step) => void edit([step]);
    tools.onedit = edit;
    for (const call of ["undo", "redo"] as const) {
      byId(call).hidden = false;
      byId(call).onclick = () => void takeBack(call);
    }
  }
  addEventListener("keydown", (event) => {
    const { target } = event;
    const isTyping = target instanceof HTMLInputElement && target.type !== "checkbox";
    if (event.key === "Escape") {
      // Each press ends one thing.
      if (tools.endOne()) return;
      pointer.selected = pointer.hovered = undefined;
      panels.showElement(undefined);
    } else if (event.key === "Enter" && target === map.canvas) {
      tools.endPath();
    } else if (event.key === "/" && !isTyping) {
      event.preventDefault();
      panels.tab("find");
      byId("query").focus();
    } else if (!shared && !isTyping && (event.ctrlKey || event.metaKey)) {
      const key = event.key.toLowerCase();
      if (key !== "z" && key !== "y") return;
      event.preventDefault();
      void takeBack(key === "y" || event.shiftKey ? "redo" : "undo");
    }
  });
  engine.onprogress = (share) => (byId<HTMLProgressElement>("progress").value = share);
}

/** Opens the layout and the floor plan that are in the page. */
async function openShared(shared: Shared): Promise<Info> {
  const { name, floorPlan } = shared;
  const info = await engine.call<Info>("openPacked", [name, packed("layout"), shared]);
  if (floorPlan) {
    const { name, placement } = floorPlan;
    await engine.call("floorPlan", [name, packed("floor-plan"), placement]);
    byId("floor-plan-of").hidden = false;
  }
  return info;
}

async function start(): Promise<void> {
  document.documentElement.lang = language;
  panels.translate();
  const isDark = shared?.look.background
    ? parseInt(shared.look.background.slice(0, 2), 16) < 128
    : matchMedia("(prefers-color-scheme: dark)").matches;
  panels.setDark(isDark);
  panels.readLook(map.look);
  connect();
  panels.tab("layout");
  await engine.started;
  document.documentElement.dataset["ready"] = String(Math.round(performance.now()));
  if (!shared) return;
  // A shared page opens no other file.
  for (const id of ["open", "start", "compare"]) byId(id).hidden = true;
  const opened = await busy(`${shared.name}: ${t("reading")}`, () => openShared(shared));
  if (opened) show(opened);
}

// For tests, and for those who try things in the console.
Object.assign(window, { guideway: { engine, map, open, cells, item } });
start().catch(notice);
