// What the element fetches from servers: layouts, and the engine, which all elements share.

import { GuidewayError } from "./engine.js";
import { unpacked } from "./gzip.js";

/**
 * The address of a file beside a module, which has no address of its own in a notebook. Bundlers
 * find the file where `address` is written out with its name.
 */
export function besideModule(address: () => URL): string | URL {
  try {
    return address();
  } catch {
    return "";
  }
}

/** The name of the file at an address; bytes of this page (`blob:`) have it as their fragment. */
export function nameOf({ protocol, hash, pathname }: URL): string {
  const isOfPage = protocol === "blob:";
  return decodeURIComponent((isOfPage ? hash.slice(1) : pathname.split("/").pop()) ?? "");
}

/** Fetches a file. `name` is how errors call it. */
export async function download(
  url: string | URL,
  name: string,
  signal?: AbortSignal,
): Promise<ArrayBuffer> {
  let response: Response;
  try {
    response = await fetch(url, signal ? { signal } : {});
  } catch (error) {
    if (signal?.aborted) throw error;
    const remedy = "Check the address, and that its server lets this page read the file (CORS)";
    throw new GuidewayError("read", `${name}: cannot fetch the file: ${String(error)}`, remedy);
  }
  if (!response.ok) {
    const answer = `${response.status} ${response.statusText}`.trim();
    const message = `${name}: the server answered ${answer}`;
    throw new GuidewayError("read", message, "Check the address and its permissions");
  }
  return response.arrayBuffer();
}

const engines = new Map<string, Promise<WebAssembly.Module>>();

/** The engine at an address, compiled once per page. */
export function compiled(url: string): Promise<WebAssembly.Module> {
  const known = engines.get(url);
  if (known) return known;
  const engine = download(url, "the engine").then(unpacked).then(WebAssembly.compile);
  engines.set(url, engine);
  // The next element tries again.
  engine.catch(() => engines.delete(url));
  return engine;
}
