// The panels beside the map: facts, settings, lists. They know the page, and no engine.

import type { Details, Diff, EditStep, Finding, Findings, Info, Look } from "./answers.js";
import type { Reference, Summary } from "./answers.js";
import { actions, field, remove, rename, set } from "./editing.js";
import { DARK, LIGHT } from "./map.js";
import { count, meters, t } from "./text.js";

const SWITCHES = [
  "arrows",
  "nodes",
  "stations",
  "labels",
  "grid",
  "scaleBar",
  "legend",
  "floorPlan",
] as const;
/** Switches that are on in every layout. */
const ALWAYS = ["scaleBar", "floorPlan"];
/** The palettes of the command. */
const PALETTES = ["warm", "viridis", "plasma", "cividis", "gray"];
/** Paths above which the marks of all of them are off at first. */
const MANY = 20_000;

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

export function item(list: HTMLElement, text: string, kind: string, onclick?: () => void): void {
  const button = document.createElement("button");
  button.textContent = text;
  if (kind) button.className = kind;
  if (onclick) button.onclick = onclick;
  else button.disabled = true;
  const line = document.createElement("li");
  line.append(button);
  list.append(line);
}

export function cells(list: HTMLElement, pairs: [string, string][]): void {
  list.replaceChildren();
  for (const [name, value] of pairs) {
    const [term, text] = [document.createElement("dt"), document.createElement("dd")];
    term.textContent = name;
    text.textContent = value;
    list.append(term, text);
  }
}

/** Gives a choice its options; what was chosen stays where it can. */
function options(id: string, pairs: [string, string][]): void {
  const choice = byId<HTMLSelectElement>(id);
  const { value: chosen } = choice;
  choice.replaceChildren(...pairs.map(([value, text]) => new Option(text, value)));
  if (pairs.some(([value]) => value === chosen)) choice.value = chosen;
}

export class Panels {
  onlook: () => void = () => {};
  ontab: (tab: string) => void = () => {};
  /** Edits an element; pages that only show have none. */
  onedit: ((step: EditStep) => void) | undefined;
  ontarget: (target: Info["targets"][number]) => void = () => {};
  hasFindings = false;
  /** The numbers at the ends of the palette, or between classes, of whoever shared the layout. */
  private range: Look["range"];
  private breaks: Look["breaks"];

  constructor() {
    options(
      "palette",
      PALETTES.map((name) => [name, name]),
    );
    for (const tab of this.tabs()) {
      tab.onclick = () => this.tab(tab.dataset["tab"]!);
      tab.onkeydown = (event) => this.tabKey(event, tab);
    }
    for (const id of ["level", "color-by", "palette", "shade", ...SWITCHES]) {
      byId(id).onchange = () => {
        if (id === "color-by") {
          // Colors by a column mean little without their legend.
          this.check("legend", this.value("color-by") !== "");
          this.range = undefined;
          this.breaks = undefined;
          this.showPalette();
        }
        this.onlook();
      };
    }
    byId("dark").onchange = () => {
      this.setDark(byId<HTMLInputElement>("dark").checked);
      this.onlook();
    };
  }

  /** Puts the words of the page into the language of the browser. */
  translate(): void {
    for (const place of document.querySelectorAll<HTMLElement>("[data-t]")) {
      place.textContent = t(place.dataset["t"] || place.textContent!);
    }
    for (const place of document.querySelectorAll<HTMLElement>("[data-label]")) {
      place.title = t(place.dataset["label"]!);
      place.setAttribute("aria-label", place.title);
    }
    for (const place of document.querySelectorAll<HTMLInputElement>("[data-hint]")) {
      place.placeholder = t(place.dataset["hint"]!);
      place.setAttribute("aria-label", place.placeholder);
    }
    byId("map").removeAttribute("title");
  }

  tab(name: string): void {
    for (const tab of this.tabs()) {
      const isChosen = tab.dataset["tab"] === name;
      tab.setAttribute("aria-selected", String(isChosen));
      tab.tabIndex = isChosen ? 0 : -1;
      byId(`tab-${tab.dataset["tab"]}`).hidden = !isChosen;
    }
    this.ontab(name);
  }

  setDark(isDark: boolean): void {
    byId<HTMLInputElement>("dark").checked = isDark;
    document.documentElement.classList.toggle("dark", isDark);
  }

  /** Writes what is chosen into a look. */
  readLook(look: Partial<Look>): void {
    Object.assign(look, byId<HTMLInputElement>("dark").checked ? DARK : LIGHT);
    for (const name of SWITCHES) look[name] = byId<HTMLInputElement>(name).checked;
    for (const [name, id] of [["level", "level"], ["colorBy", "color-by"]] as const) {
      if (this.value(id)) look[name] = this.value(id);
      else delete look[name];
    }
    look.shade = this.value("shade") as NonNullable<Look["shade"]>;
    look.palette = this.value("palette");
    if (this.range) look.range = this.range;
    else delete look.range;
    if (this.breaks) look.breaks = this.breaks;
    else delete look.breaks;
  }

  /** Chooses what a look says. */
  setLook(look: Partial<Look>): void {
    for (const name of SWITCHES) {
      if (look[name] !== undefined) this.check(name, look[name]);
    }
    byId<HTMLSelectElement>("level").value = look.level ?? "";
    byId<HTMLSelectElement>("color-by").value = look.colorBy ?? "";
    byId<HTMLSelectElement>("palette").value = look.palette ?? PALETTES[0]!;
    byId<HTMLInputElement>("envelope").value = look.envelope ?? "";
    this.range = look.range;
    this.breaks = look.breaks;
    this.showPalette();
    const shade = byId<HTMLSelectElement>("shade");
    shade.querySelector("[value=auto]")?.remove();
    if (look.shade === "auto") shade.add(new Option("", "auto"));
    shade.value = look.shade ?? "color";
  }

  clear(): void {
    this.hasFindings = false;
    for (const id of ["facts", "element", "found", "findings", "changes", "targets"]) {
      byId(id).replaceChildren();
    }
    for (const id of ["found-count", "findings-count", "route-text", "envelope-text", "losses", "status"]) {
      byId(id).textContent = "";
    }
    for (const id of ["query", "from", "to", "envelope"]) byId<HTMLInputElement>(id).value = "";
  }

  showInfo(info: Info): void {
    this.showFacts(info);
    for (const name of SWITCHES) this.check(name, ALWAYS.includes(name) || info.paths < MANY);
    this.check("grid", false);
    for (const target of info.targets) {
      item(byId("targets"), target.name, "", () => this.ontarget(target));
    }
  }

  /** Empties the lists of elements, whose rows are others after an edit. */
  clearFound(): void {
    this.hasFindings = false;
    for (const id of ["findings", "changes"]) byId(id).replaceChildren();
    byId("findings-count").textContent = "";
    if (!byId("tab-findings").hidden) this.ontab("findings");
  }

  /** What may differ after an edit. */
  showFacts(info: Info): void {
    const [minX, minY, maxX, maxY] = info.bounds ?? [0, 0, 0, 0];
    const facts: [string, string][] = [
      [t("File"), info.name],
      ["Format", `${info.format} ${info.formatVersion}`],
      [t("paths"), count(info.paths)],
      [t("nodes"), count(info.nodes)],
      [t("stations"), count(info.stations)],
      [t("length"), ""],
      [t("size"), `${meters(maxX - minX)} × ${meters(maxY - minY)}`],
    ];
    if (info.vehicleTypes.length) facts.push([t("vehicle types"), info.vehicleTypes.join(", ")]);
    if (info.refused) facts.push([t("refused"), count(info.refused)]);
    cells(byId("facts"), facts);
    const levels = info.levels.map(({ id, name }): [string, string] => [id, name]);
    options("level", [["", t("all levels")], ...levels]);
    const columns = info.columns.map((name): [string, string] => [name, name]);
    options("color-by", [["", t("nothing")], ...columns]);
    const types = info.vehicleTypes.map((name): [string, string] => [name, name]);
    options("vehicle-type", types);
    byId("vehicle-type").hidden = types.length < 2;
  }

  /** The length of all paths, which is known after all else. */
  showLength(lengthM: number): void {
    const terms = [...byId("facts").querySelectorAll("dt")];
    const value = terms.find((term) => term.textContent === t("length"))?.nextElementSibling;
    if (value) value.textContent = meters(lengthM);
  }

  showElement(element: Details | undefined): void {
    const place = byId("element");
    place.replaceChildren();
    if (!element) return;
    const [title, list] = [document.createElement("h2"), document.createElement("dl")];
    title.textContent = `${element.kind} ${element.id}`;
    cells(
      list,
      element.cells.map(({ name, value, unit }) => [name, unit ? `${value} ${unit}` : value]),
    );
    place.append(title, list);
    const { onedit } = this;
    if (!onedit) return;
    title.replaceChildren(
      `${element.kind} `,
      field(t("Name"), element.id, element.id, (to) => onedit(rename(element, to))),
    );
    element.cells.forEach((cell, at) => {
      const text = list.querySelectorAll("dd")[at]!;
      const onset = (typed: string) => onedit(set(element, cell, typed));
      if (cell.edited) text.replaceChildren(field(cell.name, text.textContent!, cell.value, onset));
    });
    const buttons = document.createElement("p");
    buttons.className = "row";
    for (const [words, step] of [...actions(element), ["Delete", remove(element)] as const]) {
      const button = document.createElement("button");
      button.textContent = t(words);
      button.onclick = () => onedit(step);
      buttons.append(button, " ");
    }
    place.append(buttons);
  }

  showFound(found: Summary[], words: string, fly: (of: Reference) => void = () => {}): void {
    byId("found").replaceChildren();
    byId("found-count").textContent = words;
    for (const of of found) item(byId("found"), `${of.kind} ${of.id}`, "", () => fly(of));
  }

  showFindings(found: Findings, fly: (of: Reference) => void): void {
    this.hasFindings = true;
    const [errors, warnings] = [count(found.errors), count(found.warnings)];
    const words = `${errors} ${t("errors")}, ${warnings} ${t("warnings")}`;
    byId("findings-count").textContent = found.all ? words : t("no findings");
    const line = (of: Finding) => `${of.code}: ${of.place}: ${of.message}. ${of.remedy}.`;
    for (const of of found.findings) {
      const { element } = of;
      item(byId("findings"), line(of), of.severity, element ? () => fly(element) : undefined);
    }
  }

  showChanges(found: Diff): void {
    const list = byId("changes");
    list.replaceChildren();
    if (!found.counts.length && !found.groups.length) item(list, t("no difference"), "");
    for (const of of found.counts) item(list, `${of.element} ${of.change}: ${of.count}`, "");
    for (const of of found.groups) item(list, of.what, "");
    for (const of of found.changes) {
      const values = of.column ? ` ${of.column}: ${of.before ?? "-"} → ${of.after ?? "-"}` : "";
      item(list, `${of.element} ${of.id} ${of.change}${values}`, "");
    }
  }

  status(text: string): void {
    byId("status").textContent = text;
  }

  private tabs(): HTMLElement[] {
    return [...document.querySelectorAll<HTMLElement>("[role=tab]")];
  }

  private tabKey(event: KeyboardEvent, tab: HTMLElement): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    const tabs = this.tabs();
    const next = tabs[(tabs.indexOf(tab) + step + tabs.length) % tabs.length]!;
    this.tab(next.dataset["tab"]!);
    next.focus();
  }

  /** Only colors by a column have a palette. */
  private showPalette(): void {
    byId("palette-of").hidden = this.value("color-by") === "";
  }

  private check(id: string, isOn: boolean): void {
    byId<HTMLInputElement>(id).checked = isOn;
  }

  private value(id: string): string {
    return byId<HTMLSelectElement>(id).value;
  }
}
