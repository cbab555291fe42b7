// Edits of the page: properties in place, names, deletion, undo. They are steps of edit scripts.

import type { Cell, Details, EditStep } from "./answers.js";
import { t } from "./text.js";

/** Names of elements in the steps `set` and `delete`. */
const LISTS = { path: "paths", node: "nodes", station: "stations" } as const;

const named = ({ kind, id }: Details) => ({ [LISTS[kind]]: [id] });

export const rename = (of: Details, to: string): EditStep => {
  return { do: "rename", [of.kind]: of.id, to };
};

export const remove = (of: Details): EditStep => {
  const isNode = of.kind === "node";
  return { do: "delete", ...named(of), ...(isNode ? { with_paths: true } : {}) };
};

/** Steps of an element by a button, with their words. */
export function actions(of: Details): [string, EditStep][] {
  if (of.kind === "node") return [["Add a station", { do: "create-station", nodes: [of.id] }]];
  if (of.kind !== "path") return [];
  const isOneWay = of.cells.some(({ name, value }) => name === "direction" && value === "one-way");
  return [
    ["Reverse", { do: "reverse", ...named(of) }],
    isOneWay
      ? ["Make two-way", { do: "two-way", ...named(of) }]
      : ["Make one-way", { do: "one-way", ...named(of) }],
  ];
}

/** The step that gives a property what was typed; none removes it. */
export function set(of: Details, cell: Cell, typed: string): EditStep {
  const text = typed.trim();
  const value = text === "" ? null : cell.edited === "text" ? text : parsed(text);
  if (of.kind !== "node" || (cell.name !== "x" && cell.name !== "y")) {
    return { do: "set", ...named(of), property: cell.name, value };
  }
  const place = (name: string) => Number(of.cells.find((other) => other.name === name)?.value);
  const to = cell.name === "x" ? [value, place("y")] : [place("x"), value];
  return { do: "move-node", node: of.id, to };
}

/** Numbers and truth values; other text stays text, which the engine refuses by name. */
function parsed(text: string): unknown {
  const number = Number(text.replace(",", "."));
  if (Number.isFinite(number)) return number;
  return text === "true" || text === "false" ? text === "true" : text;
}

/** A value of the panel that becomes a field when it is clicked. Enter calls `onset`. */
export function field(label: string, shown: string, value: string, onset: (text: string) => void) {
  const button = document.createElement("button");
  button.className = "value";
  button.textContent = shown;
  button.title = `${t("Edit")}: ${label}`;
  button.onclick = () => {
    const input = document.createElement("input");
    input.value = value;
    input.setAttribute("aria-label", label);
    let isOver = false;
    const end = (isTaken: boolean) => {
      if (isOver) return;
      isOver = true;
      input.replaceWith(button);
      button.focus();
      if (isTaken && input.value !== value) onset(input.value);
    };
    input.onblur = () => end(false);
    input.onkeydown = (event) => {
      if (event.key !== "Enter" && event.key !== "Escape") return;
      event.stopPropagation();
      end(event.key === "Enter");
    };
    button.replaceWith(input);
    input.focus();
    input.select();
  };
  return button;
}
