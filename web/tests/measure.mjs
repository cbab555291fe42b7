// Measures page and element in Chromium, the element with one thread and with several. Usage:
// node web/tests/measure.mjs [FILE...], from the top of the repository, after `cargo xtask web`, with
// files in it. Prints a table: ready, first picture, redraw, memory.

import { pathToFileURL } from "node:url";
import { writeFileSync } from "node:fs";
import { join, relative, resolve } from "node:path";
import { folder, launch } from "./harness.mjs";
import { ISOLATED, serve } from "./serve.mjs";

const browser = await launch();
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

async function open(url) {
  const context = await browser.newContext({ viewport: { width: 1630, height: 767 } });
  const page = await context.newPage();
  page.setDefaultTimeout(300_000);
  await page.goto(url);
  return page;
}

/** Times of full redraws, and memory, of the `map` and the `engine` that a page has. */
async function redrawn(page) {
  const measured = await page.evaluate(async () => {
    const { map, engine } = window.measured;
    const { center, pxPerM } = map.view;
    const times = { paths: [], page: [], density: [] };
    for (let i = 0; i < 26; i++) {
      // Views that share no whole pixel, so that each is a full redraw.
      const view = { center: [center[0] + (0.31 * (i + 1)) / pxPerM, center[1]], pxPerM };
      const kind = i < 18 ? ["paths", "page"][i % 2] : "density";
      const size = { width: 1280, height: 720, shade: kind === "density" ? kind : "color" };
      const look = kind === "page" ? { ...map.look, ...size } : size;
      const started = performance.now();
      await engine.call("render", [{ ...look, ...view }]);
      times[kind].push(performance.now() - started);
    }
    return { times, memory: await engine.call("memory", []) };
  });
  const { paths, page: all, density } = measured.times;
  return [
    `redraw of paths alone ${median(paths).toFixed(0)} ms`,
    `with its decorations ${median(all).toFixed(0)} ms`,
    `of density ${median(density).toFixed(0)} ms`,
    `engine memory ${(measured.memory / 1e6).toFixed(0)} MB`,
  ];
}

/** A file that is chosen in the page, from disk. */
async function measurePage(file) {
  const page = await open(pathToFileURL(resolve("target/web/guideway.html")).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  const ready = await page.evaluate(() => document.documentElement.dataset.ready);
  await page.evaluate(() => {
    const note = () => (window.chosen = performance.now());
    document.querySelector("#file").addEventListener("change", note, true);
    window.measured = guideway;
  });
  await page.setInputFiles("#file", resolve(file));
  await page.waitForFunction(() => guideway.map.drawn > 0 && guideway.map.view);
  const first = await page.evaluate(() => performance.now() - window.chosen);
  const row = [`ready ${ready} ms`, `first picture ${first.toFixed(0)} ms`];
  console.log([file, "page", ...row, ...(await redrawn(page))].join(" | "));
  await page.context().close();
}

/** The same file in the element, from memory. */
async function measureElement(file, server, shade) {
  writeFileSync(
    join(folder, "measure.html"),
    `<!doctype html><body style="margin: 0">
    <guideway-view style="display: block; width: 1280px; height: 720px" shade="${shade}">
    </guideway-view>
    <script type="module">
      await import("/web/dist/guideway.js");
      window.measured = document.querySelector("guideway-view");
      await measured.engine.started;
      window.ready = performance.now();
    </script>`,
  );
  const page = await open(`${server.url}target/web/tests/measure.html`);
  await page.waitForFunction(() => window.ready);
  const of = await page.evaluate(async (path) => {
    const { map } = measured;
    const file = new File([await (await fetch(path)).arrayBuffer()], "measured");
    const started = performance.now();
    await measured.open(file);
    const opened = performance.now() - started;
    while (!map.drawn) await new Promise(requestAnimationFrame);
    return { ready, opened, first: performance.now() - started, threads: measured.threads };
  }, `/${relative(".", file)}`);
  const row = [
    `threads ${of.threads}`,
    `ready ${of.ready.toFixed(0)} ms`,
    `opened ${of.opened.toFixed(0)} ms`,
    `first picture (${shade}) ${of.first.toFixed(0)} ms`,
  ];
  console.log([file, "element", ...row, ...(await redrawn(page))].join(" | "));
  await page.context().close();
}

const servers = [await serve(resolve(".")), await serve(resolve("."), ISOLATED)];
for (const file of process.argv.slice(2)) {
  await measurePage(file);
  for (const server of servers) {
    for (const shade of ["color", "auto"]) await measureElement(file, server, shade);
  }
}
for (const server of servers) server.close();
await browser.close();
