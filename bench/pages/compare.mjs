// Compares renderers of pages on the same lines: <guideway-view>, deck.gl's PathLayer, MapLibre and
// a plain canvas. Usage, from the top of the repository, after `cargo xtask web` and
// `npm install --prefix bench/pages`: node bench/pages/compare.mjs FILE.arrow...
// Files are those of `guideway generate`. Prints a table: first picture, redraw, memory. Without a
// graphics device, deck.gl and MapLibre draw on the processor, by SwiftShader.

import { readFileSync, readdirSync, writeFileSync, mkdirSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { tableFromIPC } from "apache-arrow";
import { build } from "esbuild";
import { chromium } from "playwright-core";
import { serve } from "../../web/tests/serve.mjs";

const RENDERERS = (process.env["RENDERERS"] ?? "guideway,deck,maplibre,canvas").split(",");
/** Lines per segment of a curve, for those who draw lines. */
const LINES = 2;
/** A first picture that takes longer counts as none. */
const PATIENCE_MS = 120_000;
const FRAMES = 7;
const folder = resolve("target/web/compare");
mkdirSync(folder, { recursive: true });

/** The curves of an Arrow file as lines: points as x, y; the first point of each line. */
function linesOf(file) {
  const starts = [0];
  const parts = [];
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const batch of tableFromIPC(readFileSync(file)).batches) {
    const list = batch.getChild("control_points").data[0];
    const { valueOffsets } = list;
    const coordinates = list.children[0].children[0].values;
    for (let path = 0; path < list.length; path++) {
      const [first, end] = [valueOffsets[path], valueOffsets[path + 1]];
      const count = (end - first - 3) * LINES + 1;
      const points = new Float32Array(2 * count);
      for (let i = 0; i < count; i++) {
        const segment = Math.min(Math.floor(i / LINES), end - first - 4);
        const t = i / LINES - segment;
        // Weights of the four control points of a uniform cubic B-spline.
        const weights = [(1 - t) ** 3, 3 * t ** 3 - 6 * t * t + 4, 0, t ** 3];
        weights[2] = 6 - weights[0] - weights[1] - weights[3];
        for (const axis of [0, 1]) {
          let sum = 0;
          for (let k = 0; k < 4; k++) {
            sum += weights[k] * coordinates[2 * (first + segment + k) + axis];
          }
          const value = sum / 6;
          points[2 * i + axis] = value;
          box[axis] = Math.min(box[axis], value);
          box[axis + 2] = Math.max(box[axis + 2], value);
        }
      }
      parts.push(points);
      starts.push(starts.at(-1) + count);
    }
  }
  const points = new Float32Array(2 * starts.at(-1));
  parts.forEach((part, i) => points.set(part, 2 * starts[i]));
  return { points, starts: Uint32Array.from(starts), box };
}

/** What a process and those that it started have and had: bytes, where what they share counts once,
 * and milliseconds of processors, which say the same on a busy machine as on an idle one. */
function used(pid) {
  const children = new Map();
  const ticks = new Map();
  for (const name of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const stat = readFileSync(`/proc/${name}/stat`, "utf8");
      const fields = stat.slice(stat.lastIndexOf(")") + 2).split(" ").map(Number);
      const parent = fields[1];
      children.set(parent, [...(children.get(parent) ?? []), Number(name)]);
      ticks.set(Number(name), fields[11] + fields[12] + fields[13] + fields[14]);
    } catch {
      // The process has ended.
    }
  }
  let [bytes, cpuMs] = [0, 0];
  const add = (of) => {
    for (const child of children.get(of) ?? []) add(child);
    cpuMs += (ticks.get(of) ?? 0) * 10;
    try {
      const text = readFileSync(`/proc/${of}/smaps_rollup`, "utf8");
      bytes += 1024 * Number(/^Pss:\s+(\d+)/m.exec(text)?.[1] ?? 0);
    } catch {
      // The process has ended.
    }
  };
  add(pid);
  return { bytes, cpuMs };
}

async function measure(renderer, file, url) {
  const browser = await chromium.launchServer({
    executablePath: process.env["GUIDEWAY_CHROMIUM"] ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--enable-unsafe-swiftshader"],
  });
  try {
    const client = await chromium.connect(browser.wsEndpoint());
    const page = await client.newPage({ viewport: { width: 1280, height: 720 } });
    page.setDefaultTimeout(PATIENCE_MS);
    await page.goto(`${url}target/web/compare/stage.html`);
    await page.waitForFunction(() => globalThis.renderers && customElements.get("guideway-view"));
    await page.evaluate(
      async ([renderer, name]) => {
        const bytes = async (of) => (await fetch(of)).arrayBuffer();
        if (renderer === "guideway") {
          globalThis.file = new File([await bytes(`${name}.arrow`)], `${name}.arrow`);
        } else {
          const box = await (await fetch(`${name}.box`)).json();
          const points = new Float32Array(await bytes(`${name}.points`));
          const starts = new Uint32Array(await bytes(`${name}.starts`));
          globalThis.lines = { points, starts, box };
        }
      },
      [renderer, basename(file, ".arrow")],
    );
    const before = used(browser.process().pid);
    const load = page.evaluate(async (renderer) => {
      const stage = document.getElementById("stage");
      const started = performance.now();
      await renderers[renderer].load(stage, globalThis.lines, globalThis.file);
      return performance.now() - started;
    }, renderer);
    let timer;
    const late = new Promise((_, reject) => {
      timer = setTimeout(() => reject(new Error("no picture in time")), PATIENCE_MS);
    });
    const firstMs = await Promise.race([load, late]);
    clearTimeout(timer);
    const loaded = used(browser.process().pid);
    const frames = await page.evaluate(
      async ([renderer, count]) => {
        const stage = document.getElementById("stage");
        const times = [];
        const end = performance.now() + 20_000;
        for (let i = 0; i < count && performance.now() < end; i++) {
          const started = performance.now();
          await renderers[renderer].draw(stage, 0.31 * (i + 1));
          times.push(performance.now() - started);
        }
        return times;
      },
      [renderer, FRAMES],
    );
    const after = used(browser.process().pid);
    await page.screenshot({ path: join(folder, `${renderer}-${basename(file, ".arrow")}.png`) });
    const [firstCpuMs, cpuMs] = [loaded.cpuMs - before.cpuMs, after.cpuMs - loaded.cpuMs];
    // The least: whatever else the machine does only adds.
    const redraw = [Math.min(...frames), cpuMs / frames.length];
    const bytes = after.bytes - before.bytes;
    return [firstMs, firstCpuMs, ...redraw, bytes / 1e6].map((of) => of.toFixed(0));
  } catch (error) {
    return [String(error.message).split("\n")[0], "", "", "", ""];
  } finally {
    await browser.kill();
  }
}

await build({
  entryPoints: [join(import.meta.dirname, "renderers.mjs")],
  bundle: true,
  format: "iife",
  outfile: join(folder, "renderers.js"),
  logLevel: "error",
});
writeFileSync(
  join(folder, "stage.html"),
  `<!doctype html><body style="margin: 0">
  <div id="stage" style="width: 1280px; height: 720px"></div>
  <script src="renderers.js"></script>
  <script type="module" src="../../../web/dist/guideway.js"></script>`,
);
const server = await serve(resolve("."));
console.log("| paths | renderer | first picture, ms | its CPU ms | redraw, ms | its CPU ms | MB |");
console.log("|---|---|---|---|---|---|---|");
for (const file of process.argv.slice(2)) {
  const name = basename(file, ".arrow");
  const { points, starts, box } = linesOf(file);
  writeFileSync(join(folder, `${name}.points`), points);
  writeFileSync(join(folder, `${name}.starts`), starts);
  writeFileSync(join(folder, `${name}.box`), JSON.stringify(box));
  writeFileSync(join(folder, `${name}.arrow`), readFileSync(file));
  for (const renderer of RENDERERS) {
    const row = await measure(renderer, file, server.url);
    console.log(`| ${starts.length - 1} | ${renderer} | ${row.join(" | ")} |`);
  }
}
server.close();
