// Measures the page in Chromium. Usage: node web/tests/measure.mjs [FILE...], from the top of the
// repository, after `cargo xtask web`. Prints a table: ready, first picture, redraw, memory.

import { pathToFileURL } from "node:url";
import { resolve } from "node:path";
import { chromium } from "playwright-core";

const files = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env["GUIDEWAY_CHROMIUM"] ?? "/usr/bin/chromium",
  args: ["--no-sandbox"],
});
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

for (const file of files) {
  const context = await browser.newContext({ viewport: { width: 1630, height: 767 } });
  const page = await context.newPage();
  page.setDefaultTimeout(300_000);
  await page.goto(pathToFileURL(resolve("target/web/guideway.html")).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  const ready = await page.evaluate(() => document.documentElement.dataset.ready);
  await page.evaluate(() => {
    const note = () => (window.chosen = performance.now());
    document.querySelector("#file").addEventListener("change", note, true);
  });
  await page.setInputFiles("#file", resolve(file));
  await page.waitForFunction(() => guideway.map.drawn > 0 && guideway.map.view);
  const answer = await page.evaluate(async () => {
    const first = performance.now() - window.chosen;
    const { map, engine } = guideway;
    const { center, pxPerM } = map.view;
    const times = { paths: [], page: [] };
    for (let i = 0; i < 18; i++) {
      // Views that share no whole pixel, so that each is a full redraw.
      const view = { center: [center[0] + (0.31 * (i + 1)) / pxPerM, center[1]], pxPerM };
      const size = { width: 1280, height: 720, shade: "color" };
      const look = i % 2 ? { ...map.look, ...size } : size;
      const started = performance.now();
      await engine.call("render", [{ ...look, ...view }]);
      times[i % 2 ? "page" : "paths"].push(performance.now() - started);
    }
    return { first, times, memory: await engine.call("memory", []) };
  });
  const row = [
    file,
    `ready ${ready} ms`,
    `first picture ${answer.first.toFixed(0)} ms`,
    `redraw of paths alone ${median(answer.times.paths).toFixed(0)} ms`,
    `redraw with its decorations ${median(answer.times.page).toFixed(0)} ms`,
    `engine memory ${(answer.memory / 1e6).toFixed(0)} MB`,
  ];
  console.log(row.join(" | "));
  await context.close();
}
await browser.close();
