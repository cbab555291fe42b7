// Tests of the shared page and the element in Firefox ESR. Usage: node web/tests/firefox.mjs, from
// the top of the repository, after `cargo xtask web` and a build of the command.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { folder, guideway, isSame, shots, site } from "./harness.mjs";
import { launchFirefox } from "./marionette.mjs";
import { ISOLATED, serve } from "./serve.mjs";

const firefox = await launchFirefox();

async function sharedPageIsThatOfTheCommand() {
  const file = join(folder, "firefox.html");
  guideway("share", site, "-o", file, "--color-by", "maxSpeed", "--quiet");
  await firefox.open(pathToFileURL(file).href, () => window.guideway?.map.drawn > 0);
  const look = { width: 640, height: 400, colorBy: "maxSpeed", stations: true, labels: true };
  const text = await firefox.evaluate(async (look) => {
    const bytes = new Uint8Array(await guideway.engine.call("png", [look]));
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  }, look);
  const expected = join(folder, "firefox.png");
  const fixed = ["--size", "640x400", "--method", "cpu", "--shade", "color", "--quiet"];
  const isThatOf = (...args) => {
    guideway("render", site, "-o", expected, ...fixed, "--color-by", "maxSpeed", ...args);
    return isSame(Buffer.from(text, "base64"), readFileSync(expected));
  };
  assert.ok(isThatOf("--stations", "--labels"), "the picture differs");
  assert.ok(!isThatOf("--stations"), "a picture without labels is the same");
  const isShown = await firefox.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const { map, engine } = guideway;
    const { width, height } = map.canvas;
    const look = { ...map.look, width, height, pxPerPoint: map.scale };
    const expected = new Uint8Array((await engine.call("render", [look])).rgba);
    const shown = map.canvas.getContext("2d").getImageData(0, 0, width, height).data;
    return expected.every((value, i) => value === shown[i]);
  });
  assert.ok(isShown, "the canvas shows other pixels");
  const sent = await firefox.evaluate(() => fetch("https://example.com").then(() => 1, () => 0));
  assert.equal(sent, 0, "the page may not connect");
  await firefox.screenshot(join(shots, "firefox-shared.png"));
}

/** The element with one thread, and with all that an isolated page has. */
async function elementMovesVehicles() {
  const pictures = [];
  for (const headers of [{}, ISOLATED]) {
    const server = await serve(resolve("."), headers);
    const isDrawn = () => document.querySelector("guideway-view")?.map?.drawn > 0;
    await firefox.open(`${server.url}web/examples/vehicles.html`, isDrawn);
    const place = () =>
      firefox.evaluate(() => {
        const vehicle = document.querySelector("guideway-view").fleet.get("Example/AGV-1");
        return [vehicle.x, vehicle.y];
      });
    const before = await place();
    await new Promise((resolve) => setTimeout(resolve, 2000));
    assert.notDeepEqual(await place(), before, "the vehicle stands still");
    const [isAll, picture] = await firefox.evaluate(async () => {
      const view = document.querySelector("guideway-view");
      const look = { width: 640, height: 400, stations: true, labels: true };
      const bytes = new Uint8Array(await view.engine.call("png", [look]));
      const all = crossOriginIsolated ? Math.min(navigator.hardwareConcurrency, 8) : 1;
      return [view.threads === all, Array.from(bytes).join()];
    });
    assert.ok(isAll, "not all threads draw");
    pictures.push(picture);
    await firefox.screenshot(join(shots, "firefox-vehicles.png"));
    server.close();
  }
  assert.equal(pictures[0], pictures[1], "several threads draw another picture than one");
}

try {
  await sharedPageIsThatOfTheCommand();
  await elementMovesVehicles();
} finally {
  await firefox.close();
}
console.log("all tests in Firefox passed");
