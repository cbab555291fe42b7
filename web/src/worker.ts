// The worker: unpacks the engine, holds the open layout, answers one call after the other.

import init, { Session } from "../engine/guideway_web.js";

type Message = { id: number; call: string; args: unknown[] };

let session: Session | undefined;
let memory: WebAssembly.Memory;
let told = 0;

/** Called by the engine while it reads: the finished share, at most ten times a second. */
(self as unknown as Record<string, unknown>)["guidewayProgress"] = (share: number) => {
  const now = performance.now();
  if (now - told > 100) {
    told = now;
    postMessage({ progress: share });
  }
};

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function unpacked(base64: string): Promise<ArrayBuffer> {
  const packed = new Blob([bytesOf(base64)]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

function opened(): Session {
  if (!session) throw JSON.stringify({ code: "usage", message: "No layout is open", remedy: "" });
  return session;
}

function replace(name: string, bytes: Uint8Array): unknown {
  const next = new Session(name, bytes);
  session?.free();
  session = next;
  return JSON.parse(next.info());
}

const calls: Record<string, (...args: never[]) => unknown> = {
  start: async (engine: string | WebAssembly.Module) => {
    const source = typeof engine === "string" ? await unpacked(engine) : engine;
    memory = (await init({ module_or_path: source })).memory;
  },
  open: (name: string, bytes: ArrayBuffer) => replace(name, new Uint8Array(bytes)),
  openPacked: async (name: string, base64: string) =>
    replace(name, new Uint8Array(await unpacked(base64))),
  floorPlan: async (name: string, base64: string, placement: unknown) => {
    const bytes = new Uint8Array(await unpacked(base64));
    opened().set_floor_plan(name, bytes, JSON.stringify(placement));
  },
  envelope: (text: string) => opened().check_envelope(text),
  render: (look: { width: number; height: number }) => {
    const drawn = opened().render(JSON.stringify(look));
    const report = JSON.parse(drawn.report);
    const rgba = drawn.take_rgba().buffer;
    drawn.free();
    return { width: look.width, height: look.height, rgba, report };
  },
  memory: () => memory.buffer.byteLength,
  length: (first: number, most: number) => opened().length_m(first, most),
  check: (most: number) => JSON.parse(opened().check(most)),
  hit: (x: number, y: number, reach: number) => JSON.parse(opened().hit(x, y, reach)),
  element: (kind: string, row: number) => JSON.parse(opened().element(kind, row)),
  find: (text: string, limit: number) => JSON.parse(opened().find(text, limit)),
  query: (text: string, limit: number) => JSON.parse(opened().query(text, limit)),
  route: (ends: unknown) => JSON.parse(opened().route(JSON.stringify(ends))),
  diff: (name: string, bytes: ArrayBuffer, most: number) => {
    const other = new Session(name, new Uint8Array(bytes));
    const found = JSON.parse(opened().diff(other, most));
    other.free();
    return found;
  },
  png: (look: unknown) => opened().png(JSON.stringify(look)).buffer,
  curves: (look: unknown, format: string) => opened().curves(JSON.stringify(look), format).buffer,
  save: (format: string) => {
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
