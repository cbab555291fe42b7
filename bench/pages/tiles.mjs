// MapLibre shows the tiles of the command: raster tiles pixel by pixel, vector tiles as the same
// lines with attributes. Usage, from the top of the repository, after a build of the command and
// `npm install --prefix bench/pages`: node bench/pages/tiles.mjs. Pictures go to target/web/tiles.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { chromium } from "playwright-core";
import { serve } from "../../web/tests/serve.mjs";

const command = resolve(process.env["GUIDEWAY"] ?? "target/debug/guideway");
const folder = "target/web/tiles";
const modules = "/bench/pages/node_modules";
const [WIDTH, HEIGHT] = [1024, 768];
/** Zoom of the raster tiles that are shown; the map's own is one less, as its tiles are larger. */
const ZOOM = 3;

/** Runs in the page: shows an archive in the middle of the world, and returns its pixels. */
async function show({ file, isVector, zoom, tile }) {
  const archive = new pmtiles.PMTiles(file);
  const protocol = new pmtiles.Protocol();
  protocol.add(archive);
  const nothing = document.createElement("canvas");
  const blank = await new Promise((resolve) => nothing.toBlob(resolve));
  maplibregl.addProtocol("pmtiles", async (request, abort) => {
    const answer = await protocol.tile(request, abort);
    // Without data of a tile that the archive leaves out, MapLibre waits for it and is never idle.
    return answer.data ? answer : { data: await blank.arrayBuffer() };
  });
  const kind = isVector ? "vector" : "raster";
  const size = { tileSize: tile };
  const line = { type: "line", "source-layer": "paths", paint: { "line-width": 2 } };
  const exact = { "raster-fade-duration": 0, "raster-resampling": "nearest" };
  const picture = { type: "raster", paint: exact };
  const map = new maplibregl.Map({
    container: "map",
    center: [0, 0],
    zoom: zoom - 1,
    pixelRatio: 1,
    fadeDuration: 0,
    renderWorldCopies: false,
    canvasContextAttributes: { preserveDrawingBuffer: true },
    style: {
      version: 8,
      sources: { tiles: { type: kind, url: `pmtiles://${file}`, ...(isVector ? {} : size) } },
      layers: [
        { id: "paper", type: "background", paint: { "background-color": "#fff" } },
        { id: "tiles", source: "tiles", ...(isVector ? line : picture) },
      ],
    },
  });
  await new Promise((resolve, reject) => {
    map.once("idle", resolve);
    map.on("error", ({ error }) => reject(error));
  });
  const { width, height } = map.getCanvas();
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const pen = canvas.getContext("2d");
  pen.drawImage(map.getCanvas(), 0, 0);
  const shown = pen.getImageData(0, 0, width, height).data;
  globalThis.pictures = { ...globalThis.pictures, [kind]: shown };
  if (isVector) {
    const features = map.queryRenderedFeatures({ layers: ["tiles"] });
    return { properties: features.map((feature) => feature.properties) };
  }
  // The same window, of the tiles of the archive without a map program.
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, width, height);
  const middle = (tile << zoom) / 2;
  for (let x = 0; x < 1 << zoom; x++) {
    for (let y = 0; y < 1 << zoom; y++) {
      const png = await archive.getZxy(zoom, x, y);
      if (!png) continue;
      const bitmap = await createImageBitmap(new Blob([png.data]));
      pen.drawImage(bitmap, x * tile - middle + width / 2, y * tile - middle + height / 2);
    }
  }
  const expected = pen.getImageData(0, 0, width, height).data;
  return { different: shown.reduce((sum, value, i) => sum + (value !== expected[i]), 0) };
}

/** Runs in the page: share of the dark pixels of one picture that have one of the other beside. */
function covered([of, by, width]) {
  const isDark = (picture, at) => picture[4 * at] + picture[4 * at + 1] + picture[4 * at + 2] < 384;
  const [a, b] = [globalThis.pictures[of], globalThis.pictures[by]];
  let [dark, found] = [0, 0];
  for (let at = width + 1; at < a.length / 4 - width - 1; at++) {
    if (!isDark(a, at)) continue;
    dark++;
    const beside = [-width, 0, width].flatMap((row) => [at + row - 1, at + row, at + row + 1]);
    found += beside.some((near) => isDark(b, near));
  }
  return { dark, share: found / dark };
}

mkdirSync(folder, { recursive: true });
writeFileSync(
  join(folder, "page.html"),
  `<!doctype html><link rel="stylesheet" href="${modules}/maplibre-gl/dist/maplibre-gl.css">
  <div id="map" style="width: ${WIDTH}px; height: ${HEIGHT}px"></div>
  <script src="${modules}/maplibre-gl/dist/maplibre-gl.js"></script>
  <script src="${modules}/pmtiles/dist/pmtiles.js"></script>`,
);
const server = await serve(resolve("."));
const browser = await chromium.launch({
  executablePath: process.env["GUIDEWAY_CHROMIUM"] ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader"],
});
try {
  const page = await browser.newPage({ viewport: { width: WIDTH, height: HEIGHT } });
  page.on("pageerror", (error) => assert.fail(`the page failed: ${error}`));
  await page.goto(`${server.url}${folder}/page.html`);
  for (const content of ["raster", "vector"]) {
    const file = join(folder, `${content}.pmtiles`);
    const site = "crates/guideway/examples/site.lif.json";
    const options = ["--content", content, "--zoom", "0-4", "--quiet"];
    execFileSync(command, ["tiles", site, "-o", file, ...options]);
    const isVector = content === "vector";
    const shown = { file: `${server.url}${file}`, isVector, zoom: ZOOM, tile: 256 };
    const found = await page.evaluate(show, shown);
    await page.screenshot({ path: join(folder, `${content}.png`) });
    if (isVector) {
      const ids = new Set(found.properties.map(({ id }) => id));
      assert(ids.size > 50, `${ids.size} paths`);
      assert(found.properties.every(({ maxSpeed }) => maxSpeed > 0), "a path without a speed");
    } else {
      assert.equal(found.different, 0, "the map differs from the tiles");
    }
    await page.evaluate(() => document.getElementById("map").replaceChildren());
  }
  for (const [of, by] of [["raster", "vector"], ["vector", "raster"]]) {
    const { dark, share } = await page.evaluate(covered, [of, by, WIDTH]);
    assert(dark > 1000 && share > 0.95, `${of} in ${by}: ${share} of ${dark}`);
    console.log(`${dark} dark pixels of ${of}: ${(100 * share).toFixed(1)} % beside ${by}`);
  }
  console.log("MapLibre shows raster tiles to the pixel, and vector tiles as the same lines");
} finally {
  await browser.close();
  server.close();
}
