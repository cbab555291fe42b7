// Tests of the widget for notebooks in Chromium, with a model as anywidget has it. Usage, from the
// top of the repository, after `cargo xtask web` and a build of the command:
// node web/tests/widget.mjs

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { gunzipSync } from "node:zlib";
import { folder, guideway, isSame, launch, shots, site } from "./harness.mjs";
import { serve } from "./serve.mjs";

const server = await serve(resolve("."));
const browser = await launch();
const packed = readFileSync("crates/guideway/page/widget.js.gz");
writeFileSync(join(folder, "widget.js"), gunzipSync(packed));
writeFileSync(join(folder, "empty.geojson"), '{"type":"FeatureCollection","features":[]}');

/** A page with the widget of a layout, as a notebook shows it: the module has no address. */
async function open(traits = {}, layout = site) {
  // As Python sends it.
  const sent = join(folder, "widget.arrow");
  guideway("convert", layout, sent, "--quiet");
  writeFileSync(
    join(folder, "widget.html"),
    `<!doctype html><body style="margin: 0"><div id="out" style="width: 640px"></div>
    <script type="module">
      const bytes = async (url) => new DataView(await (await fetch(url)).arrayBuffer());
      class Model {
        traits = { ${["_target", "selected", "hovered", "center", "scale", "color_by", "level"]
          .map((name) => `${name}: null`)
          .join(", ")}, error: null, highlight: [], site: false, dark: false, height: 400,
          _fleet: { vehicles: [], durationMs: 0 }, _name: "layout.arrow",
          ...${JSON.stringify(traits)} };
        listeners = [];
        saved = 0;
        get(name) { return this.traits[name]; }
        /** All values first, then the events, as a message of Python does. */
        setAll(values) {
          const changed = Object.keys(values).filter((name) => this.traits[name] !== values[name]);
          Object.assign(this.traits, values);
          for (const name of changed) {
            for (const [event, act] of [...this.listeners]) if (event === "change:" + name) act();
          }
        }
        set(name, value) { this.setAll({ [name]: value }); }
        save_changes() { this.saved++; }
        on(...of) { this.listeners.push(of); }
        off(event, act) {
          this.listeners = this.listeners.filter((of) => of[0] !== event || of[1] !== act);
        }
      }
      const text = await (await fetch("widget.js")).text();
      const address = () => URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
      window.model = new Model();
      model.traits._engine = await bytes("/crates/guideway/page/engine-arrow.wasm.gz");
      model.traits._letters = await bytes("/web/dist/letters.ttf.gz");
      model.traits._symbols = await bytes("/web/dist/symbols.ttf.gz");
      model.traits._layout = await bytes("/target/web/tests/widget.arrow");
      window.mount = async (el) => (await import(address())).default.render({ model, el });
      window.painted = () => new Promise((resolve) => {
        requestAnimationFrame(() => requestAnimationFrame(resolve));
      });
      window.end = await mount(document.querySelector("#out"));
      window.view = document.querySelector("guideway-view");
    </script>`,
  );
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
  page.on("pageerror", (error) => assert.fail(`the page failed: ${error}`));
  page.on("request", (request) => {
    const isLocal = request.url().startsWith(server.url) || /^(blob|data):/.test(request.url());
    assert.ok(isLocal, `the widget asks the network for ${request.url()}`);
  });
  await page.goto(`${server.url}target/web/tests/widget.html`);
  await page.waitForFunction(() => window.view?.map.drawn > 0);
  return page;
}

const traits = (page) =>
  page.evaluate(() => {
    const { _engine, _symbols, _layout, ...others } = model.traits;
    return others;
  });
/** Sets traits as Python does, and waits until a trait has a value. */
const set = (page, values) => page.evaluate((values) => model.setAll(values), values);
const until = (page, name, value) =>
  page.waitForFunction(
    ([name, value]) => JSON.stringify(model.traits[name]) === JSON.stringify(value),
    [name, value],
  );

async function showsWhatTheCommandDraws() {
  const view = { center: [30, 20], scale: 12.5 };
  const page = await open({ color_by: "maxSpeed", site: true, ...view });
  const picture = () =>
    page.evaluate(async () => {
      await painted();
      const shown = view.map.canvas.getContext("2d").getImageData(0, 0, 640, 400).data;
      const image = await createImageBitmap(await view.picture());
      const pen = new OffscreenCanvas(640, 400).getContext("2d");
      pen.drawImage(image, 0, 0);
      const saved = pen.getImageData(0, 0, 640, 400).data;
      // The command takes the scale of texts from the size of the picture, a page from the screen.
      const png = await view.call("png", [{ ...view.map.lookNow, pxPerPoint: undefined }]);
      const isShown = shown.every((value, i) => value === saved[i]);
      return { isShown, bytes: [...new Uint8Array(png)] };
    });
  const made = await picture();
  assert.ok(made.isShown, "the canvas shows another picture than it saves");
  const expected = join(folder, "widget.png");
  const fixed = ["--size", "640x400", "--method", "cpu", "--shade", "color", "--quiet"];
  const marks = ["arrows", "nodes", "stations", "labels", "scale-bar", "legend"];
  const isThatOf = (bytes, ...args) => {
    const options = [...fixed, ...marks.map((mark) => `--${mark}`), "--color-by", "maxSpeed"];
    guideway("render", site, "-o", expected, ...options, ...args);
    return isSame(Buffer.from(bytes), readFileSync(expected));
  };
  const place = ["--center", "30,20", "--scale", "12.5"];
  assert.ok(isThatOf(made.bytes, ...place), "the picture differs");
  const elsewhere = ["--center", "31,20", "--scale", "12.5"];
  assert.ok(!isThatOf(made.bytes, ...elsewhere), "any picture is the same");
  await page.screenshot({ path: join(shots, "widget.png") });
  // Another view of Python, and another level.
  const drawn = await page.evaluate(() => view.map.drawn);
  await set(page, { center: [40, 25], level: "hall" });
  await page.waitForFunction((drawn) => view.map.drawn > drawn && !view.map.wants, drawn);
  await page.waitForFunction(() => !view.map.isDrawing);
  const next = ["--center", "40,25", "--scale", "12.5", "--level", "hall"];
  assert.ok(isThatOf((await picture()).bytes, ...next), "the second picture differs");
  await page.context().close();
}

async function sharesTheTraits() {
  const page = await open({ selected: "dock-1" });
  // The map tells where it is.
  await page.waitForFunction(() => model.traits.scale > 0 && model.traits.center.length === 2);
  assert.equal((await traits(page)).error, null);
  const path = "dock-1-001--dock-1-002";
  await set(page, { center: null, scale: null, _target: { number: 1, element: path } });
  await page.waitForFunction(() => model.traits.center !== null);
  // A click arrives in the model, and so does what the pointer is at.
  const at = await page.evaluate(async (path) => {
    const { outline } = await view.details(path);
    return view.map.pixel(outline[0][Math.floor(outline[0].length / 2)]);
  }, path);
  await page.mouse.move(at[0], at[1]);
  await until(page, "hovered", path);
  const saved = await page.evaluate(() => model.saved);
  await page.mouse.click(at[0], at[1]);
  await until(page, "selected", path);
  assert.ok((await page.evaluate(() => model.saved)) > saved, "the model was not sent");
  // JupyterLab leaves the keys of an element with this attribute to it.
  const focused = await page.evaluate(() => document.activeElement.outerHTML);
  assert.match(focused, /^<guideway-view [^>]*data-lm-suppress-shortcuts="true"/);
  await page.mouse.move(at[0], 700);
  await until(page, "hovered", null);
  // What Python selects is outlined.
  await set(page, { selected: "dock-1" });
  await page.waitForFunction(() => view.pointer.selected?.id === "dock-1");
  await set(page, { highlight: ["dock-2", "dock-3"], hovered: "dock-2" });
  await page.waitForFunction(() => view.highlighted.length === 2 && view.pointer.hovered);
  // Boxes, all of it, and gestures of a person.
  await set(page, { center: null, scale: null, _target: { number: 2, box: [10, 10, 30, 20] } });
  await until(page, "center", [20, 15]);
  const { scale } = await traits(page);
  await set(page, { center: null, scale: null, _target: { number: 3 } });
  await page.waitForFunction((scale) => model.traits.scale && model.traits.scale < scale, scale);
  const before = (await traits(page)).center;
  await page.mouse.move(300, 200);
  await page.mouse.down();
  await page.mouse.move(360, 200, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction((x) => model.traits.center[0] < x - 0.1, before[0]);
  // Vehicles, which a click selects.
  const vehicle = { id: "a", x: 60, y: 40, label: "" };
  await set(page, { _fleet: { vehicles: [vehicle], durationMs: 0 } });
  const [x, y] = await page.evaluate(async () => {
    await painted();
    return view.map.pixel([60, 40]);
  });
  await page.mouse.click(x, y);
  await until(page, "selected", "a");
  // As a second view of the widget hears of it: a vehicle is no element of the layout.
  await set(page, { selected: null });
  await set(page, { selected: "a" });
  await page.waitForFunction(() => view.selectedVehicle === "a");
  assert.equal((await traits(page)).error, null);
  await page.context().close();
}

async function saysWhatIsWrong() {
  const page = await open();
  // Python refuses these; a program that writes the traits itself gets an error, and the map lives.
  const drawn = await page.evaluate(() => view.map.drawn);
  await set(page, { color_by: "weight" });
  await page.waitForFunction(() => model.traits.error?.includes("weight"));
  await set(page, { color_by: null });
  await page.waitForFunction((drawn) => view.map.drawn > drawn, drawn);
  await set(page, { selected: "no-such" });
  await page.waitForFunction(() => model.traits.error?.includes("`no-such`"));
  await set(page, { _fleet: { vehicles: [{ id: "b", x: null, y: 0 }], durationMs: 0 } });
  await page.waitForFunction(() => model.traits.error?.includes("vehicle b"));
  // A second view of the same model has the same engine; a closed one ends, with all its listeners.
  const listeners = await page.evaluate(async () => {
    const before = model.listeners.length;
    const second = document.body.appendChild(document.createElement("div"));
    const end = await mount(second);
    const other = second.querySelector("guideway-view");
    while (!other.map.drawn) await painted();
    end();
    return [before, model.listeners.length, second.childElementCount];
  });
  assert.deepEqual(listeners.slice(1), [listeners[0], 0]);
  const left = await page.evaluate(async () => {
    end();
    await new Promise((resolve) => setTimeout(resolve, 300));
    const { saved } = model;
    model.setAll({ selected: "dock-1", center: [1, 1], color_by: "maxSpeed" });
    await new Promise((resolve) => setTimeout(resolve, 300));
    return [model.listeners.length, model.saved - saved, view.isConnected];
  });
  assert.deepEqual(left, [0, 0, false]);
  await page.context().close();
}

async function showsAnEmptyLayout() {
  const page = await open({ site: true }, join(folder, "empty.geojson"));
  await set(page, { _target: { number: 1 } });
  await page.evaluate(() => painted());
  assert.equal((await traits(page)).error, null);
  await page.context().close();
}

try {
  await showsWhatTheCommandDraws();
  await sharesTheTraits();
  await saysWhatIsWrong();
  await showsAnEmptyLayout();
} finally {
  await browser.close();
  server.close();
}
console.log(`all tests of the widget passed; look at ${shots}`);
