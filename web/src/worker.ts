// The worker: unpacks the engine, holds the open layout, answers one call after the other.

import init, { Session, add_font, has_missed_letters } from "../engine/guideway_web.js";
import type { FontSource, Origin } from "./answers.js";
import { unpacked, unpackedText } from "./gzip.js";

type Message = { id: number; call: string; args: unknown[] };

let session: Session | undefined;
let memory: WebAssembly.Memory;
let told = 0;
/** The fonts that no letter has needed, in the order in which one is sought in them. */
let fonts: FontSource[] = [];

/** Called by the engine while it reads: the finished share, at most ten times a second. */
(self as unknown as Record<string, unknown>)["guidewayProgress"] = (share: number) => {
  const now = performance.now();
  if (now - told > 100) {
    told = now;
    postMessage({ progress: share });
  }
};

async function bytesOf(font: FontSource): Promise<ArrayBuffer | undefined> {
  if ("packed" in font) return unpackedText(font.packed);
  const response = await fetch(font.url);
  return response.ok ? unpacked(await response.arrayBuffer()) : undefined;
}

/** Draws, and once more with each font until none of the letters is missing. */
async function drawn<T>(draw: () => T): Promise<T> {
  let value = draw();
  let isMissing = fonts.length > 0 && has_missed_letters();
  while (isMissing && fonts.length) {
    // Without it, boxes stand for the letters.
    const font = await bytesOf(fonts.shift()!).catch(() => undefined);
    if (!font || !add_font(new Uint8Array(font))) continue;
    value = draw();
    isMissing = has_missed_letters();
  }
  return value;
}

function render(look: { width: number; height: number }) {
  const drawn = opened().render(JSON.stringify(look));
  const report = JSON.parse(drawn.report);
  const rgba = drawn.take_rgba().buffer;
  drawn.free();
  return { width: look.width, height: look.height, rgba, report };
}

function opened(): Session {
  const remedy = "Open one";
  if (!session) throw JSON.stringify({ code: "usage", message: "No layout is open", remedy });
  return session;
}

/** Fails where the engine reads layouts, and does nothing else with files. */
function requireFiles(): void {
  if ("save" in Session.prototype) return;
  const message = "This engine reads layouts of Arrow; it edits, writes and compares none";
  throw JSON.stringify({ code: "usage", message, remedy: "Take the whole engine" });
}

/** Undoes or redoes; answers the layout that is open then, or `null` if there was nothing. */
function afterwards(act: (layout: Session) => boolean): unknown {
  requireFiles();
  return act(opened()) ? JSON.parse(opened().info()) : null;
}

function replace(name: string, bytes: Uint8Array, origin?: Origin): unknown {
  const next = new Session(name, bytes);
  if (origin) next.set_origin(origin.format, origin.formatVersion);
  session?.free();
  session = next;
  return JSON.parse(next.info());
}

export const calls: Record<string, (...args: never[]) => unknown> = {
  start: async (engine: string | WebAssembly.Module, fontsHere: FontSource[]) => {
    fonts = fontsHere;
    const source = typeof engine === "string" ? await unpackedText(engine) : engine;
    memory = (await init({ module_or_path: source })).memory;
    // The threads of an engine share it.
    return memory.buffer instanceof ArrayBuffer ? undefined : memory;
  },
  open: (name: string, bytes: ArrayBuffer) => replace(name, new Uint8Array(bytes)),
  openPacked: async (name: string, base64: string, origin: Origin) =>
    replace(name, new Uint8Array(await unpackedText(base64)), origin),
  /** The file is base64 of gzip in a shared page. */
  floorPlan: async (name: string, file: string | ArrayBuffer, placement: unknown) => {
    const bytes = new Uint8Array(typeof file === "string" ? await unpackedText(file) : file);
    opened().set_floor_plan(name, bytes, JSON.stringify(placement));
  },
  envelope: (text: string) => opened().check_envelope(text),
  render: (look: { width: number; height: number }) => drawn(() => render(look)),
  memory: () => memory.buffer.byteLength,
  length: (first: number, most: number) => opened().length_m(first, most),
  check: (most: number) => JSON.parse(opened().check(most)),
  hit: (x: number, y: number, reach: number) => JSON.parse(opened().hit(x, y, reach)),
  element: (kind: string, row: number) => JSON.parse(opened().element(kind, row)),
  find: (text: string, limit: number) => JSON.parse(opened().find(text, limit)),
  query: (text: string, limit: number) => JSON.parse(opened().query(text, limit)),
  sample: (row: number, spacing: number) => JSON.parse(opened().sample(row, spacing)),
  route: (ends: unknown) => JSON.parse(opened().route(JSON.stringify(ends))),
  edit: (steps: unknown[]) => {
    requireFiles();
    const { steps: done } = JSON.parse(opened().edit(JSON.stringify({ steps })));
    return { info: JSON.parse(opened().info()), steps: done };
  },
  undo: () => afterwards((layout) => layout.undo()),
  redo: () => afterwards((layout) => layout.redo()),
  diff: (name: string, bytes: ArrayBuffer, most: number) => {
    requireFiles();
    const other = new Session(name, new Uint8Array(bytes));
    const found = JSON.parse(opened().diff(other, most));
    other.free();
    return found;
  },
  png: (look: unknown) => drawn(() => opened().png(JSON.stringify(look)).buffer),
  curves: (look: unknown, format: string) =>
    drawn(() => opened().curves(JSON.stringify(look), format).buffer),
  save: (format: string) => {
    requireFiles();
    const saved = opened().save(format);
    const losses = JSON.parse(saved.losses);
    const bytes = saved.take_bytes().buffer;
    saved.free();
    return { bytes, losses };
  },
};

function buffersOf(value: unknown): Transferable[] {
  if (value instanceof ArrayBuffer) return [value];
  const parts = value && typeof value === "object" ? Object.values(value) : [];
  return parts.filter((part): part is ArrayBuffer => part instanceof ArrayBuffer);
}

async function answer({ id, call, args }: Message): Promise<void> {
  try {
    const value = await calls[call]!(...(args as never[]));
    postMessage({ id, value }, { transfer: buffersOf(value) });
  } catch (error) {
    // The engine throws text; anything else has broken it.
    const isBroken = typeof error !== "string";
    const thrown = isBroken ? undefined : JSON.parse(error);
    postMessage({ id, thrown, broken: isBroken ? String(error) : undefined });
  }
}

/** The answer to the last call: calls that wait for their bytes must not overtake each other. */
let last: Promise<void> = Promise.resolve();
onmessage = ({ data }: MessageEvent<Message>) => {
  last = last.then(() => answer(data));
};
