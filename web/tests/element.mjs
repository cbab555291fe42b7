// Tests of `<guideway-view>` in Chromium, and of its npm package. Usage, from the top of the
// repository, after `cargo xtask web` and a build of the command: node web/tests/element.mjs

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { folder, guideway, isSame, launch, shots, site } from "./harness.mjs";
import { serve } from "./serve.mjs";

const server = await serve(resolve("."));
const browser = await launch();
const desktop = { viewport: { width: 1280, height: 800 } };
const touch = { deviceScaleFactor: 2, hasTouch: true, isMobile: true };
const phone = { viewport: { width: 390, height: 844 }, ...touch };

async function open(path, options = desktop) {
  const page = await (await browser.newContext(options)).newPage();
  page.setDefaultTimeout(120_000);
  page.on("pageerror", (error) => assert.fail(`the page failed: ${error}`));
  await page.goto(server.url + path);
  return page;
}

/** A page with one element of 640 x 400 pixels, whose events are noted. */
async function openElement(attributes, module = "../../../web/dist/guideway.js") {
  const file = join(folder, "element.html");
  const style = "display: block; width: 640px; height: 400px";
  writeFileSync(
    file,
    `<!doctype html><body style="margin: 0">
    <guideway-view style="${style}" ${attributes}></guideway-view>
    <script type="module">
      window.view = document.querySelector("guideway-view");
      window.noted = [];
      for (const type of ["load", "error", "hover", "select", "viewchange"]) {
        view.addEventListener(type, ({ detail, message }) => {
          noted.push([type, detail ?? message ?? null]);
        });
      }
      window.next = (type) => new Promise((resolve) => {
        const listener = (event) => resolve(event.detail ?? event.message);
        view.addEventListener(type, listener, { once: true });
      });
      window.painted = () => new Promise((resolve) => {
        requestAnimationFrame(() => requestAnimationFrame(resolve));
      });
      window.library = await import("${module}");
    </script>`,
  );
  const page = await open("target/web/tests/element.html");
  await page.waitForFunction(() => window.library);
  return page;
}

const siteUrl = "../../../crates/guideway/examples/site.lif.json";
const noted = (page, type) =>
  page.evaluate((type) => noted.filter(([of]) => of === type).map(([, detail]) => detail), type);

/** Acts, and waits for the picture that follows. */
async function settle(page, act) {
  const drawn = await page.evaluate(() => view.map.drawn);
  await act();
  await page.waitForFunction((before) => view.map.drawn > before, drawn);
}

async function showsWhatTheCommandDraws() {
  const page = await openElement(`src="${siteUrl}" stations scale-bar color-by="maxSpeed" legend`);
  await page.waitForFunction(() => view.map.drawn > 0);
  const [info] = await noted(page, "load");
  assert.deepEqual([info.paths, info.levels.length], [326, 2]);
  const made = await page.evaluate(async () => {
    await painted();
    const file = await view.picture();
    const image = await createImageBitmap(file);
    const pen = new OffscreenCanvas(640, 400).getContext("2d");
    pen.drawImage(image, 0, 0);
    const expected = pen.getImageData(0, 0, 640, 400).data;
    const shown = view.map.canvas.getContext("2d").getImageData(0, 0, 640, 400).data;
    const isShown = expected.every((value, i) => value === shown[i]);
    // The command takes the scale of texts from the size of the picture, a page from the screen.
    const png = await view.call("png", [{ ...view.map.lookNow, pxPerPoint: undefined }]);
    return { isShown, bytes: [...new Uint8Array(png)] };
  });
  assert.ok(made.isShown, "the canvas shows another picture than it saves");
  const expected = join(folder, "element.png");
  const fixed = ["--size", "640x400", "--method", "cpu", "--shade", "color", "--quiet"];
  const marks = ["--color-by", "maxSpeed", "--stations", "--scale-bar"];
  const isThatOf = (...args) => {
    guideway("render", site, "-o", expected, ...fixed, ...marks, ...args);
    return isSame(Buffer.from(made.bytes), readFileSync(expected));
  };
  assert.ok(isThatOf("--legend"), "the picture differs");
  assert.ok(!isThatOf(), "a picture without legend is the same");
  const edited = await page.evaluate(async () => {
    const step = { do: "rename", station: "dock-1", to: "gate" };
    const [{ names }] = await view.edit(step);
    const found = (await view.find("gate"))[0].id;
    const refused = await view.edit({ ...step, to: "" }).catch((error) => error.message);
    return { names, found, refused, back: [await view.undo(), await view.undo()] };
  });
  assert.deepEqual([edited.names, edited.found, edited.back], [["gate"], "gate", [true, false]]);
  assert.match(edited.refused, /step 1/);
  const sampled = await page.evaluate(async () => {
    const points = await view.sample("dock-1-003--dock-1-002", 3);
    const refused = await view.sample("dock-1", 3).catch((error) => error.message);
    return { points: points.map(({ x, y, alongM }) => [x, y, alongM]), refused };
  });
  assert.equal(sampled.points.length, 3);
  assert.deepEqual(sampled.points[1], [36, 4, 2]);
  assert.match(sampled.refused, /a station has no points/);
  const saved = await page.evaluate(async () => (await view.save("dxf")).file.text());
  guideway("convert", site, join(folder, "element.dxf"), "--quiet");
  assert.equal(saved, readFileSync(join(folder, "element.dxf"), "utf8"));
  await page.context().close();
}

async function tellsWhatThePointerIsAt() {
  const page = await openElement(`src="${siteUrl}"`);
  await page.waitForFunction(() => view.map.drawn > 0);
  await settle(page, () => page.evaluate(() => view.flyTo("dock-1-001--dock-1-002")));
  const at = await page.evaluate(async () => {
    const { outline } = await view.details("dock-1-001--dock-1-002");
    return view.map.pixel(outline[0][Math.floor(outline[0].length / 2)]);
  });
  await page.mouse.move(at[0], at[1]);
  await page.waitForFunction(() => noted.some(([type]) => type === "hover"));
  const [hovered] = await noted(page, "hover");
  assert.equal(`${hovered.kind} ${hovered.id}`, "path dock-1-001--dock-1-002");
  const cells = hovered.cells.map(({ name, value, unit }) => `${name} ${value} ${unit}`);
  assert.ok(cells.includes("maxSpeed 0.8 m/s"), cells.join());
  await page.mouse.click(at[0], at[1]);
  await page.waitForFunction(() => noted.some(([type]) => type === "select"));
  await page.mouse.move(800, 600);
  await page.waitForFunction(() => noted.at(-1)[0] === "hover" && noted.at(-1)[1] === null);
  const [selected] = await noted(page, "select");
  assert.equal(selected.id, hovered.id);
  // The selected path is outlined in blue, and a highlighted one in its own color.
  const isOutlinedIn = (channel) =>
    page.evaluate(
      async ([[x, y], channel]) => {
        await painted();
        const pen = view.map.canvas.getContext("2d");
        const { data } = pen.getImageData(Math.round(x) - 3, Math.round(y) - 3, 7, 7);
        const pixels = Array.from({ length: 49 }, (_, i) => data.slice(4 * i, 4 * i + 3));
        return pixels.some((pixel) => pixel[channel] - Math.min(...pixel) > 100);
      },
      [at, channel],
    );
  assert.ok(await isOutlinedIn(2), "the selected path has no outline");
  await page.evaluate(() => view.select(null));
  assert.ok(!(await isOutlinedIn(2)), "the outline is still there");
  await page.evaluate(() => view.highlight(["dock-1-001--dock-1-002"], "#00ff00"));
  assert.ok(await isOutlinedIn(1), "the highlighted path has no outline");
  const unknown = await page.evaluate(() => {
    return view.highlight(["no-such"]).catch((error) => error.message);
  });
  assert.match(unknown, /no path, node or station `no-such`/);
  assert.ok((await noted(page, "viewchange")).length > 0);
  await page.context().close();
}

async function movesVehicles() {
  const page = await openElement(`src="${siteUrl}" level="hall"`);
  await page.waitForFunction(() => view.map.drawn > 0 && view.map.view);
  const colorAt = (x, y) =>
    page.evaluate(async ([x, y]) => {
      await painted();
      const [px, py] = view.map.pixel([x, y]).map(Math.round);
      const pen = view.map.canvas.getContext("2d");
      return pen.getImageData(px, py, 1, 1).data.slice(0, 3).join();
    }, [x, y]);
  const set = (x, options) =>
    page.evaluate(
      ([x, options]) =>
        view.setVehicles([{ id: "a", x, y: 70, theta: 0, color: "#ff0000", label: "" }], options),
      [x, options],
    );
  await set(20);
  assert.equal(await colorAt(20, 70), "255,0,0");
  await set(100, { durationMs: 400 });
  assert.equal(await colorAt(100, 70), "255,255,255", "the vehicle has jumped");
  await page.waitForTimeout(500);
  assert.equal(await colorAt(100, 70), "255,0,0");
  assert.equal(await colorAt(20, 70), "255,255,255", "the vehicle is in two places");
  const [x, y] = await page.evaluate(() => view.map.pixel([100, 70]));
  await page.mouse.click(x, y);
  await page.waitForFunction(() => noted.some(([type]) => type === "select"));
  const [picked] = await noted(page, "select");
  assert.deepEqual([picked.kind, picked.id, picked.vehicle.x], ["vehicle", "a", 100]);
  const upstairs = { id: "a", x: 100, y: 70, color: "#ff0000", level: "mezzanine" };
  await page.evaluate((vehicle) => view.setVehicles([vehicle]), upstairs);
  assert.equal(await colorAt(100, 70), "255,255,255", "the vehicle is on another level");
  const wrong = await page.evaluate(() => {
    try {
      view.setVehicles([{ id: "b", x: NaN, y: 0 }]);
    } catch (error) {
      return error.message;
    }
  });
  assert.match(wrong, /vehicle b: position and heading must be finite/);
  const read = (message) => page.evaluate((message) => library.vehicleOf(message) ?? null, message);
  const position = { x: 1, y: 2, theta: 3, mapId: "hall" };
  const name = { manufacturer: "m", serialNumber: "7" };
  const vehicle = { id: "m/7", label: "7", x: 1, y: 2, theta: 3, level: "hall" };
  assert.deepEqual(await read({ ...name, agvPosition: position }), vehicle);
  assert.deepEqual(await read({ ...name, mobileRobotPosition: position }), vehicle);
  const lost = { ...position, positionInitialized: false };
  assert.equal(await read({ ...name, agvPosition: lost }), null);
  assert.equal(await read(name), null);
  await page.context().close();
}

async function saysWhatIsWrong() {
  const page = await openElement(`src="${siteUrl}"`);
  await page.waitForFunction(() => view.map.drawn > 0);
  const after = (type, act) =>
    page.evaluate(
      async ([type, act]) => {
        const next = window.next(type);
        eval(act);
        return next;
      },
      [type, act],
    );
  const shown = () => page.evaluate(() => view.shadowRoot.querySelector("[part=notice]").innerText);
  assert.match(await after("error", "view.setAttribute('color-by', 'weight')"), /weight/);
  assert.match(await shown(), /weight[^]*\.$/);
  await settle(page, () => page.evaluate(() => view.setAttribute("color-by", "maxSpeed")));
  assert.equal(await shown(), "");
  const missing = await after("error", "view.setAttribute('src', 'no-such.json')");
  assert.equal(missing, "no-such.json: the server answered 404 Not Found");
  const geojson = '{"type":"LineString","coordinates":[[0,0],[1,0]]}';
  const opened = await after("load", `view.open(new File(['${geojson}'], 'one.geojson'))`);
  assert.equal(opened.paths, 1);
  // An element that moves keeps its layout; one that leaves ends its engine, and starts again.
  await settle(page, () => after("load", `view.setAttribute('src', '${siteUrl}')`));
  const loads = (await noted(page, "load")).length;
  await page.evaluate(() => document.body.append(view));
  assert.equal(await page.evaluate(() => view.info.paths), 326);
  const gone = await page.evaluate(async () => {
    view.remove();
    await new Promise((resolve) => setTimeout(resolve));
    return [view.info, await view.check().catch((error) => error.message)];
  });
  assert.deepEqual(gone, [undefined, "the element is in no document"]);
  await settle(page, () => page.evaluate(() => document.body.append(view)));
  assert.equal((await noted(page, "load")).length, loads + 1);
  // Without an engine, there is one error and no second attempt.
  const lone = await openElement("");
  const error = await lone.evaluate(async () => {
    library.GuidewayView.engineUrl = "no-such.wasm";
    const other = document.createElement("guideway-view");
    const failed = new Promise((resolve) => other.addEventListener("error", resolve));
    other.setAttribute("src", "/crates/guideway/examples/site.lif.json");
    document.body.append(other);
    return (await failed).message;
  });
  assert.equal(error, "the engine: the server answered 404 Not Found");
  await lone.context().close();
  await page.context().close();
}

/** The module whose engine reads Arrow alone. */
async function arrowEngineReadsArrow() {
  guideway("convert", site, join(folder, "element.arrow"), "--quiet");
  const page = await openElement(`src="element.arrow"`, "../../../web/dist/guideway-arrow.js");
  await page.waitForFunction(() => view.map.drawn > 0);
  const said = await page.evaluate(async (siteUrl) => {
    const refused = await view.save("lif").catch((error) => error.message);
    const { paths, targets } = view.info;
    const failed = next("error");
    view.setAttribute("src", siteUrl);
    return { paths, targets, refused, failed: await failed };
  }, siteUrl);
  assert.deepEqual([said.paths, said.targets], [326, []]);
  assert.match(said.refused, /reads layouts of Arrow/);
  assert.match(said.failed, /LIF.*this build|this build.*LIF/);
  await page.context().close();
}

async function exampleMovesVehicles() {
  for (const [name, options] of Object.entries({ desktop, phone })) {
    const page = await open("web/examples/vehicles.html", options);
    const map = () => document.querySelector("guideway-view");
    await page.waitForFunction(`(${map})().map?.drawn > 0`);
    const place = () => page.evaluate(`(${map})().fleet.get("Example/AGV-1")`);
    const before = await place();
    await page.waitForTimeout(2000);
    const after = await place();
    assert.ok(Math.hypot(after.x - before.x, after.y - before.y) > 0.5, "the vehicle stands still");
    await page.screenshot({ path: join(shots, `vehicles-${name}.png`) });
    await page.context().close();
  }
}

/** The package as npm packs and installs it: types for TypeScript, a module for bundlers. */
function packageServesOthers() {
  const place = join(folder, "package");
  rmSync(place, { recursive: true, force: true });
  mkdirSync(place, { recursive: true });
  const npm = (cwd, ...args) => execFileSync("npm", args, { cwd, stdio: "pipe" }).toString();
  const [packed] = JSON.parse(npm("web", "pack", "--json", "--pack-destination", place));
  assert.ok(packed.files.every(({ path }) => /^(dist\/|package\.json|README\.md)/.test(path)));
  writeFileSync(join(place, "package.json"), '{ "type": "module" }');
  npm(place, "install", "--offline", "--no-audit", "--no-fund", packed.filename);
  const use = (lines) => writeFileSync(join(place, "use.ts"), `import "guideway";\n${lines}`);
  const bin = (name) => resolve("web/node_modules/.bin", name);
  const flags = ["--strict", "--noEmit", "--module", "nodenext", "--target", "es2022"];
  const types = () => spawnSync(bin("tsc"), [...flags, "--types", "", "use.ts"], { cwd: place });
  use(`const view = document.querySelector("guideway-view")!;
    view.addEventListener("select", ({ detail }) => console.log(detail?.kind));
    view.setVehicles([{ id: "a", x: 1, y: 2 }], { durationMs: 100 });
    void view.flyTo("a").then(() => view.view?.pxPerM);`);
  const right = types();
  assert.equal(right.status, 0, right.stdout.toString());
  use('document.querySelector("guideway-view")!.setVehicles([{ id: 1 }]);');
  assert.notEqual(types().status, 0, "a vehicle without position has the right type");
  use("");
  execFileSync(bin("esbuild"), ["use.ts", "--bundle", "--format=esm", "--outfile=out.js"], {
    cwd: place,
    stdio: "pipe",
  });
  // A server that renders pages has no elements, and loads the module all the same.
  execFileSync("node", ["--input-type=module", "-e", 'await import("guideway")'], { cwd: place });
  console.log(`npm package: ${(packed.size / 1e6).toFixed(2)} MB`);
}

try {
  packageServesOthers();
  await showsWhatTheCommandDraws();
  await tellsWhatThePointerIsAt();
  await movesVehicles();
  await saysWhatIsWrong();
  await arrowEngineReadsArrow();
  await exampleMovesVehicles();
} finally {
  await browser.close();
  server.close();
}
console.log(`all tests of the element passed; look at ${shots}`);
