// Tests of page and element have this in common: command, browser, comparison of pictures.

import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { chromium } from "playwright-core";

export const command = resolve(process.env["GUIDEWAY"] ?? "target/debug/guideway");
export const folder = resolve("target/web/tests");
export const shots = resolve("target/web/shots");
export const site = resolve("crates/guideway/examples/site.lif.json");
for (const made of [folder, shots]) mkdirSync(made, { recursive: true });

export const guideway = (...args) => execFileSync(command, args, { stdio: "pipe" });

export function launch() {
  const executablePath = process.env["GUIDEWAY_CHROMIUM"] ?? "/usr/bin/chromium";
  return chromium.launch({ executablePath, args: ["--no-sandbox"] });
}

/** The size and the compressed pixels of a PNG file: the same pixels have the same bytes. Its texts
 * name the view, whose last digit may differ: sine and cosine are others in a browser. */
function pixels(png) {
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    const kind = png.toString("latin1", at + 4, at + 8);
    const end = at + 8 + png.readUInt32BE(at);
    if (kind === "IHDR" || kind === "IDAT") parts.push(png.subarray(at + 8, end));
  }
  return Buffer.concat(parts);
}

/** Returns `true` if two PNG files show the same. */
export const isSame = (a, b) => pixels(a).equals(pixels(b));

/** The site of openTCS with names in encodings that the engine asks the browser for. */
export function encodedFiles() {
  const whole = join(folder, "site.opentcs.xml");
  guideway("convert", site, whole, "--quiet");
  const text = readFileSync(whole, "utf8").replace(/^<\?xml.*?\?>/, "");
  // Letters that the embedded fonts have.
  const names = { GBK: [0xa7, 0xe1, 0xa7, 0xe5], "windows-1251": [0xef, 0xf3, 0xf2, 0xfc] };
  return Object.entries(names).map(([encoding, bytes]) => {
    const head = `<?xml version="1.0" encoding="${encoding}"?>`;
    const before = /(?<=(?:<(?:point|path|outgoingPath) name|(?:source|destination)Point)=")/;
    const parts = text.replace(/[^\x00-\x7f]/g, "?").split(before);
    const named = parts.flatMap((part) => [Buffer.from(part), Buffer.from(bytes)]).slice(0, -1);
    const file = join(folder, `${encoding}.xml`);
    writeFileSync(file, Buffer.concat([Buffer.from(head), ...named]));
    return file;
  });
}
