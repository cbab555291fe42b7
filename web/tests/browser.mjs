// Tests of the page in Chromium. Usage: node web/tests/browser.mjs, from the top of the repository,
// after `cargo xtask web` and a build of the command. Pictures of the page go to target/web/shots.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { command, encodedFiles, folder, guideway, isSame, launch } from "./harness.mjs";
import { shots, site } from "./harness.mjs";

const pageUrl = pathToFileURL(resolve("target/web/guideway.html")).href;
const browser = await launch();

/** A page at an address, whose every request beyond the file and its worker is a failure. */
async function open(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
  page.on("request", (request) => assert.match(request.url(), /^(file|blob|data):/));
  page.on("pageerror", (error) => assert.fail(`the page failed: ${error}`));
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return page;
}

async function load(page, file) {
  const drawn = await page.evaluate(() => guideway.map.drawn);
  await page.setInputFiles("#file", file);
  await page.waitForFunction((before) => guideway.map.drawn > before, drawn);
}

/** Real files of the formats: the smaller ones, as the command of tests is not optimized. */
function realFiles() {
  const all = resolve("../shared/layouts");
  if (!existsSync(all)) {
    console.log("SKIPPED: no folder shared/layouts beside the repository");
    return [];
  }
  const found = [];
  for (const format of readdirSync(all)) {
    const inside = join(all, format);
    if (!statSync(inside).isDirectory()) continue;
    const files = readdirSync(inside, { recursive: true }).map((name) => join(inside, name));
    const isLayout = (file) => spawnSync(command, ["info", "--quiet", file]).status === 0;
    const small = files.filter((file) => {
      const stat = statSync(file);
      return stat.isFile() && stat.size < 2_000_000 && !/\.(md|txt)$/.test(file);
    });
    small.sort((a, b) => statSync(b).size - statSync(a).size);
    found.push(...small.filter(isLayout).slice(0, 2));
  }
  return found;
}

// Each is read by the command once.
const real = realFiles();

async function pngOf(page, look) {
  const text = await page.evaluate(async (look) => {
    const bytes = new Uint8Array(await guideway.engine.call("png", [look]));
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    return btoa(text);
  }, look);
  return Buffer.from(text, "base64");
}

const marks = { arrows: true, nodes: true, stations: true, labels: true, scaleBar: true };
const markArgs = ["--arrows", "--nodes", "--stations", "--labels", "--scale-bar"];

async function picturesAreThoseOfTheCommand() {
  const arrow = join(folder, "site.arrow");
  guideway("convert", site, arrow, "--quiet");
  const page = await open(pageUrl);
  await load(page, arrow);
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => guideway.map.drawn), 1, "the first picture is drawn again");
  for (const file of [site, arrow, ...encodedFiles(), ...real]) {
    await load(page, file);
    const size = { width: 640, height: 400 };
    const expected = join(folder, "expected.png");
    const fixed = ["--size", "640x400", "--method", "cpu", "--shade", "color"];
    guideway("render", file, "-o", expected, "--quiet", ...fixed, ...markArgs);
    const made = await pngOf(page, { ...size, ...marks });
    if (!isSame(made, readFileSync(expected))) {
      writeFileSync(join(folder, "made.png"), made);
      assert.fail(`${file}: the picture differs: ${folder}/made.png, expected.png`);
    }
    console.log(`same picture: ${basename(file)}`);
  }
  const near = { center: [36, 8], pxPerM: 25, colorBy: "maxSpeed", legend: true };
  await load(page, site);
  const made = await pngOf(page, { width: 800, height: 500, ...near });
  const args = ["--center", "36,8", "--scale", "25", "--color-by", "maxSpeed", "--legend"];
  const expected = join(folder, "near.png");
  guideway("render", site, "-o", expected, "--quiet", "--size", "800x500", ...args);
  assert.ok(isSame(made, readFileSync(expected)), "the near picture differs");
  // The comparison must fail where the view differs.
  const other = await pngOf(page, { width: 800, height: 500, ...near, pxPerM: 25.5 });
  assert.ok(!isSame(other, readFileSync(expected)), "another view has the same picture");
  await page.context().close();
}

async function refusedFilesAreRefusedInTheWordsOfTheCommand() {
  const page = await open(pageUrl);
  const encoded = (name, bytes) => {
    const head = Buffer.from(`<?xml version="1.0" encoding="${name}"?><model name="`);
    return Buffer.concat([head, Buffer.from(bytes), Buffer.from('"/>')]);
  };
  const cases = {
    "empty.json": "",
    "cut.lif.json": '{"layouts": [',
    "notes.txt": "hello",
    // Half a letter before one of ASCII, bytes of no letter, and an encoding of nobody.
    "half.xml": encoded("GBK", [0xbb, 0xf5, 0xbb, 0x22]),
    "none.xml": encoded("shift-jis", [0x92, 0xca, 0xff, 0xff]),
    "alone.xml": encoded("windows-1253", [0x41, 0xd2]),
    "unknown.xml": encoded("klingon", [0x41]),
  };
  for (const [name, text] of Object.entries(cases)) {
    const file = join(folder, name);
    writeFileSync(file, text);
    const said = spawnSync(command, ["info", name, "--json"], { cwd: folder });
    const { message, remedy } = JSON.parse(said.stdout.toString()).error;
    await page.setInputFiles("#file", file);
    await page.waitForSelector("#notice:not([hidden])");
    assert.equal(await page.textContent("#notice-text"), `${message}.\n${remedy}.`);
    await page.click("#notice-close");
  }
  await load(page, site);
  assert.match(await page.textContent("#facts"), /326/);
  await page.context().close();
}

async function handsAndKeysWork() {
  const page = await open(pageUrl);
  await page.screenshot({ path: join(shots, "start.png") });
  await load(page, site);
  const status = () => document.querySelector("#status").textContent;
  await page.waitForFunction(`/326 \\/ 326/.test((${status})())`);
  const facts = () => document.querySelector("#facts").textContent;
  // The length follows the picture.
  await page.waitForFunction(`/length[\\d., ]*\\d k?m/.test((${facts})())`);
  await page.click("[data-tab=view]");
  const settle = async (act) => {
    const drawn = await page.evaluate(() => guideway.map.drawn);
    await act();
    await page.waitForFunction((before) => guideway.map.drawn > before, drawn);
  };
  await settle(() => page.selectOption("#color-by", "maxSpeed"));
  await page.screenshot({ path: join(shots, "desktop.png") });
  await page.click("[data-tab=find]");
  await page.fill("#query", "dock-1-002--dock-1-003");
  await page.waitForSelector("#found button");
  await settle(() => page.click("#found button"));
  await page.fill("#query", "maxSpeed < 0.5");
  await page.waitForFunction(() => document.querySelectorAll("#found button").length > 1);
  await page.click("[data-tab=layout]");
  assert.match(await page.textContent("#element"), /maxSpeed\s*0\.3 m\/s/);
  // The zoom keeps the place below the pointer.
  const box = await page.locator("#map").boundingBox();
  const corner = [box.x + 200, box.y + 150];
  const world = () => page.evaluate(() => guideway.map.world([200, 150]));
  const before = await world();
  await page.mouse.move(...corner);
  await settle(() => page.mouse.wheel(0, -300));
  const after = await world();
  assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 1e-9);
  await page.focus("#map");
  const scale = () => page.evaluate(() => guideway.map.view.pxPerM);
  const wide = await scale();
  await settle(() => page.keyboard.press("+"));
  assert.ok((await scale()) > wide);
  await settle(() => page.keyboard.press("ArrowLeft"));
  await settle(() => page.keyboard.press("0"));
  await page.click("#measure");
  await page.mouse.click(box.x + 100, box.y + 100);
  await page.mouse.click(box.x + 300, box.y + 100);
  const length = parseFloat(await page.textContent("#status"));
  assert.ok(Math.abs(length - 200 / (await scale())) < 0.01, `measured ${length}`);
  await page.keyboard.press("Escape");
  await page.click("[data-tab=find]");
  await page.fill("#from", "dock-1");
  await page.fill("#to", "nowhere");
  await page.click("#route button");
  await page.waitForFunction(() => document.querySelector("#route-text").textContent);
  await page.click("[data-tab=findings]");
  await page.waitForFunction(() => document.querySelector("#findings-count").textContent);
  await page.screenshot({ path: join(shots, "findings.png") });
  await page.click("[data-tab=export]");
  const [saved] = await Promise.all([
    page.waitForEvent("download"),
    page.click("#targets button >> text=/^DXF$/"),
  ]);
  guideway("convert", site, join(folder, "site.dxf"), "--quiet");
  const [made, expected] = [await saved.path(), join(folder, "site.dxf")];
  assert.ok(readFileSync(made).equals(readFileSync(expected)), "the DXF file differs");
  await editsAreMadeInPlace(page, settle);
  await nodesAndPathsAreDrawn(page, settle);
  // An engine that stops leaves a page that opens the next file.
  await page.evaluate(() => guideway.engine.restart("stopped by the test"));
  await load(page, site);
  await page.context().close();
}

/** Types a value of the selected element, renames and deletes elements, and takes edits back. */
async function editsAreMadeInPlace(page, settle) {
  const select = async (name) => {
    await page.click("[data-tab=find]");
    await page.fill("#query", name);
    await page.waitForSelector("#found button");
    await settle(() => page.click("#found button"));
    await page.click("[data-tab=layout]");
  };
  const type = async (label, text, key = "Enter") => {
    await page.click(`#element .value[title$=": ${label}"]`);
    await page.fill("#element input", text);
    await page.press("#element input", key);
  };
  const says = (words) =>
    page.waitForFunction((words) => {
      return document.querySelector("#element").textContent.includes(words);
    }, words);
  await select("dock-1-002--dock-1-003");
  await type("maxSpeed", "9", "Escape");
  await says("0.3 m/s");
  await settle(() => type("maxSpeed", "0.75"));
  await says("0.75 m/s");
  await type("maxSpeed", "fast");
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-text"), /step 1.*set/);
  await page.click("#notice-close");
  await select("cross-171");
  await settle(() => type("Name", "gate"));
  await says("gate");
  await settle(() => type("x", "90.5"));
  await page.screenshot({ path: join(shots, "edited.png") });
  const edited = await page.evaluate(() => guideway.engine.call("save", ["lif"]));
  assert.ok(edited.bytes, "the edited layout is saved");
  const hasAll = () => /326/.test(document.querySelector("#facts").textContent);
  assert.ok(await page.evaluate(hasAll));
  await settle(() => page.click("#element button >> text=/^Delete$/"));
  await page.waitForFunction(`!(${hasAll})()`);
  for (let i = 0; i < 4; i++) await settle(() => page.click("#undo"));
  await select("cross-171");
  await settle(() => page.keyboard.press("Control+y"));
  await select("dock-1-002--dock-1-003");
  await says("0.75 m/s");
  await settle(() => page.keyboard.press("Control+z"));
  await select("dock-1-002--dock-1-003");
  await says("0.3 m/s");
}

/** Drags a node, draws nodes and paths by clicks and keys, and takes all of it back. */
async function nodesAndPathsAreDrawn(page, settle) {
  const element = (words) =>
    page.waitForFunction((words) => {
      return document.querySelector("#element").textContent.includes(words);
    }, words);
  const counts = () =>
    page.evaluate(() => {
      const values = [...document.querySelectorAll("#facts dd")].map((of) => of.textContent);
      return { paths: Number(values[2]), nodes: Number(values[3]), stations: Number(values[4]) };
    });
  const before = await counts();
  const onScreen = async (point) => {
    const box = await page.locator("#map").boundingBox();
    const [x, y] = await page.evaluate((point) => guideway.map.pixel(point), point);
    return [box.x + x, box.y + y];
  };
  const place = (name) =>
    page.evaluate(async (name) => {
      const found = await guideway.engine.call("find", [name, 10]);
      const { row } = found.find(({ id, kind }) => id === name && kind === "node");
      return (await guideway.engine.call("element", ["node", row])).outline[0][0];
    }, name);
  await page.click("[data-tab=find]");
  await page.fill("#query", "cross-171");
  await page.waitForSelector("#found button");
  await settle(() => page.click("#found button"));
  await page.click("[data-tab=layout]");
  const from = await place("cross-171");
  const to = [from[0] + 1.5, from[1] + 0.75];
  const drag = async () => {
    await page.mouse.move(...(await onScreen(from)));
    await page.mouse.down();
    await page.mouse.move(...(await onScreen([from[0] + 1, from[1]])), { steps: 4 });
    await page.mouse.move(...(await onScreen(to)), { steps: 4 });
  };
  const view = await page.evaluate(() => guideway.map.view);
  await drag();
  await page.keyboard.press("Escape");
  await page.mouse.up();
  assert.deepEqual(await place("cross-171"), from, "Escape lets the node lie");
  await drag();
  await page.screenshot({ path: join(shots, "drag.png") });
  await settle(() => page.mouse.up());
  const dropped = await place("cross-171");
  assert.ok(Math.hypot(dropped[0] - to[0], dropped[1] - to[1]) < 0.05, `dropped at ${dropped}`);
  assert.deepEqual(await page.evaluate(() => guideway.map.view), view, "the map stays");
  const click = async (point) => page.mouse.click(...(await onScreen(point)));
  // A node, and a path from the node that was moved through a point to a place that has none.
  await page.click("#draw-node");
  await settle(() => click([to[0] + 1, to[1] + 2]));
  await element("node N");
  assert.deepEqual(await counts(), { ...before, nodes: before.nodes + 1 });
  await page.click("#draw-path");
  await click(dropped);
  await click([to[0] - 1, to[1] + 1.5]);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Enter");
  assert.deepEqual(await counts(), { ...before, nodes: before.nodes + 1 }, "Escape drops the path");
  assert.equal(await page.getAttribute("#draw-path", "aria-pressed"), "true");
  await click(dropped);
  await click([to[0] - 1, to[1] + 1.5]);
  await click([to[0] - 2, to[1] + 2.5]);
  await page.screenshot({ path: join(shots, "drawing.png") });
  await settle(() => page.keyboard.press("Enter"));
  await element("path ");
  const drawn = { paths: before.paths + 1, nodes: before.nodes + 2 };
  assert.deepEqual(await counts(), { ...before, ...drawn });
  await page.keyboard.press("Escape");
  assert.equal(await page.getAttribute("#draw-path", "aria-pressed"), "false");
  await element("one-way");
  const press = (words) => page.click(`#element button >> text=/^${words}$/`);
  await settle(() => press("Make two-way"));
  await element("two-way");
  await settle(() => press("Reverse"));
  await page.screenshot({ path: join(shots, "drawn.png") });
  await settle(() => page.click("#fit"));
  await page.click("[data-tab=find]");
  await page.fill("#query", "cross-171");
  await page.waitForSelector("#found button");
  await settle(() => page.click("#found button"));
  await page.click("[data-tab=layout]");
  await settle(() => press("Add a station"));
  await element("station ");
  assert.deepEqual(await counts(), { ...before, ...drawn, stations: before.stations + 1 });
  for (let i = 0; i < 6; i++) await settle(() => page.click("#undo"));
  assert.deepEqual(await counts(), before);
  assert.deepEqual(await place("cross-171"), from);
}

/** A layout whose names have symbols and rare letters, for which the page has fonts of their own. */
async function lettersAreThoseOfTheCommand() {
  const named = join(folder, "symbols.lif.json");
  writeFileSync(named, readFileSync(site, "utf8").replaceAll("dock-1", "⚡ Ἀθῆναι dock-1"));
  const [file, expected] = [join(folder, "symbols.html"), join(folder, "symbols.png")];
  const fixed = ["--size", "640x400", "--method", "cpu", "--shade", "color", "--labels"];
  guideway("render", named, "-o", expected, "--quiet", ...fixed);
  guideway("share", named, "-o", file, "--quiet");
  const look = { width: 640, height: 400, labels: true };
  for (const url of [pageUrl, pathToFileURL(file).href]) {
    const page = await open(url);
    if (url === pageUrl) await load(page, named);
    await page.waitForFunction(() => guideway.map.drawn > 0);
    assert.ok(isSame(await pngOf(page, look), readFileSync(expected)), `${url} has other letters`);
    await page.context().close();
  }
  // Common letters need none of them.
  guideway("share", site, "-o", file, "--quiet");
  assert.ok(!/id="(letters|symbols)"/.test(readFileSync(file, "utf8")));
}

async function floorPlansAreAddedToAnOpenPage() {
  const [drawing, image] = [join(folder, "added.dxf"), join(folder, "added.png")];
  guideway("convert", site, drawing, "--quiet");
  guideway("render", site, "-o", image, "--quiet", "--size", "300x200");
  const page = await open(pageUrl);
  await load(page, site);
  await page.click("[data-tab=view]");
  assert.ok(await page.isHidden("#floorPlan"));
  const view = ["--center", "36,8", "--scale", "12.5", "--size", "640x400", "--shade", "color"];
  const expected = join(folder, "added-expected.png");
  const look = { width: 640, height: 400, center: [36, 8], pxPerM: 12.5, floorPlan: true };
  for (const plan of [drawing, `${image}@px-per-m=4,rotate=20,offset=10,-5`]) {
    const drawn = await page.evaluate(() => guideway.map.drawn);
    await page.setInputFiles("#plan-file", plan.split("@")[0]);
    if (plan !== drawing) {
      for (const [id, value] of Object.entries({ scale: 4, rotate: 20, x: 10, y: -5 })) {
        await page.fill(`#plan-${id}`, String(value));
      }
      await page.click("#plan-place button");
    }
    await page.waitForFunction((before) => guideway.map.drawn > before, drawn);
    assert.ok(await page.isChecked("#floorPlan"));
    guideway("render", site, "-o", expected, "--quiet", "--floor-plan", plan, ...view);
    assert.ok(isSame(await pngOf(page, look), readFileSync(expected)), `${plan} differs`);
  }
  const noImage = { name: "a.png", mimeType: "image/png", buffer: Buffer.from("no") };
  await page.setInputFiles("#plan-file", noImage);
  await page.click("#plan-place button");
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-text"), /a\.png/);
  await page.click("#notice-close");
  await page.screenshot({ path: join(shots, "added-plan.png") });
  // Another layout has none.
  await load(page, site);
  assert.ok(await page.isHidden("#floorPlan"));
  await page.context().close();
}

async function memoryStaysFlatOverPans() {
  const page = await open(pageUrl);
  await load(page, site);
  const pan = (times) =>
    page.evaluate(async (times) => {
      for (let i = 0; i < times; i++) {
        const look = { ...guideway.map.look, width: 640, height: 400, center: [i % 50, 5] };
        await guideway.engine.call("render", [{ ...look, pxPerM: 10, shade: "color" }]);
      }
      return guideway.engine.call("memory", []);
    }, times);
  const first = await pan(50);
  const last = await pan(450);
  assert.ok(last <= first, `the engine grew from ${first} to ${last} bytes`);
  console.log(`engine memory after 500 pans: ${(last / 1e6).toFixed(1)} MB`);
  await page.context().close();
}

async function sharedPageOpensFromDisk() {
  const file = join(folder, "shared.html");
  guideway("share", site, "-o", file, "--title", "Hall <3>", "--color-by", "maxSpeed", "--quiet");
  const page = await open(pathToFileURL(file).href);
  await page.waitForFunction(() => guideway.map.drawn > 0);
  assert.equal(await page.textContent("#title"), "Hall <3>");
  assert.equal(await page.inputValue("#color-by"), "maxSpeed");
  assert.ok(await page.isHidden("#open"), "a shared page opens no other file");
  const sent = await page.evaluate(() => fetch("https://example.com").then(() => 1, () => 0));
  assert.equal(sent, 0, "the page may not connect");
  await page.screenshot({ path: join(shots, "shared.png") });
  const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true };
  const dark = { ...phone, isMobile: true, colorScheme: "dark", locale: "de-DE" };
  const small = await open(pathToFileURL(file).href, dark);
  await small.waitForFunction(() => guideway.map.drawn > 0);
  assert.equal(await small.textContent("#fit"), "Alles zeigen");
  await small.screenshot({ path: join(shots, "phone.png") });
  guideway("render", site, "-o", file, "--quiet", "--center", "36,8", "--scale", "25");
  const rendered = await open(pathToFileURL(file).href);
  await rendered.waitForFunction(() => guideway.map.drawn > 0);
  assert.deepEqual(await rendered.evaluate(() => guideway.map.view.center), [36, 8]);
  console.log(`shared page: ${(statSync(file).size / 1e6).toFixed(2)} MB`);
}

async function sharedLayoutsAreWhole() {
  const [file, expected] = [join(folder, "whole.html"), join(folder, "whole.png")];
  const fixed = ["--size", "640x400", "--method", "cpu", "--shade", "color"];
  for (const layout of [site, ...real]) {
    guideway("share", layout, "-o", file, "--quiet");
    guideway("render", layout, "-o", expected, "--quiet", ...fixed, ...markArgs);
    const page = await open(pathToFileURL(file).href);
    await page.waitForFunction(() => guideway.map.drawn > 0);
    const made = await pngOf(page, { width: 640, height: 400, ...marks });
    assert.ok(isSame(made, readFileSync(expected)), `${layout}: the shared picture differs`);
    for (const of of ["#undo", "#draw-node", "#draw-path"]) {
      assert.ok(await page.isHidden(of), "a shared page edits nothing");
    }
    assert.ok(await page.isHidden("#compare"), "the engine of a shared page compares nothing");
    await page.click("[data-tab=export]");
    const [saved] = await Promise.all([
      page.waitForEvent("download"),
      page.click("#targets button >> text=/^Arrow$/"),
    ]);
    guideway("info", "--quiet", await saved.path());
    await page.context().close();
  }
}

async function sharedFloorPlanAndSweptAreasAreThoseOfTheCommand() {
  const [drawing, image] = [join(folder, "plan.dxf"), join(folder, "plan.png")];
  guideway("convert", site, drawing, "--quiet");
  guideway("render", site, "-o", image, "--quiet", "--size", "300x200");
  const view = ["--center", "36,8", "--scale", "12.5"];
  const colors = ["--color-by", "maxSpeed", "--palette", "viridis", "--range", "0..3", "--legend"];
  for (const plan of [`${drawing}@offset=3,2`, `${image}@px-per-m=4,rotate=20,offset=10,-5`]) {
    const args = [...view, ...colors, "--floor-plan", plan];
    const [file, expected] = [join(folder, "plan.html"), join(folder, "plan-expected.png")];
    const size = ["--size", "700x400", "--method", "cpu", "--shade", "color"];
    args.push("--envelope", "2x1.2");
    guideway("render", site, "-o", expected, "--quiet", ...args, ...size);
    guideway("render", site, "-o", file, "--quiet", ...args);
    const page = await open(pathToFileURL(file).href);
    await page.waitForFunction(() => guideway.map.drawn > 0);
    const look = await page.evaluate(() => ({ ...guideway.map.look }));
    const off = { arrows: false, nodes: false, stations: false, labels: false, scaleBar: false };
    const fixed = { width: 700, height: 400, center: [36, 8], pxPerM: 12.5, shade: "color" };
    assert.equal(look.envelope, "2x1.2,1");
    const all = { ...look, ...off, ...fixed };
    const made = await pngOf(page, all);
    assert.ok(isSame(made, readFileSync(expected)), `${plan}: the picture differs`);
    const changes = [{ floorPlan: false }, { envelope: undefined }, { range: undefined }];
    for (const change of changes) {
      const other = await pngOf(page, { ...all, ...change });
      assert.ok(!isSame(other, made), `nothing differs with ${Object.keys(change)}`);
    }
    await page.click("[data-tab=view]");
    assert.ok(await page.isVisible("#floorPlan"));
    assert.equal(await page.inputValue("#palette"), "viridis");
    await page.fill("#envelope", "2xwide");
    await page.press("#envelope", "Enter");
    await page.waitForFunction(() => /2xwide/.test(document.body.textContent));
    assert.equal(await page.evaluate(() => guideway.map.look.envelope), undefined);
    await page.screenshot({ path: join(shots, `plan-${basename(plan).slice(5, 8)}.png`) });
    await page.context().close();
  }
}

try {
  await picturesAreThoseOfTheCommand();
  await refusedFilesAreRefusedInTheWordsOfTheCommand();
  await handsAndKeysWork();
  await lettersAreThoseOfTheCommand();
  await floorPlansAreAddedToAnOpenPage();
  await memoryStaysFlatOverPans();
  await sharedPageOpensFromDisk();
  await sharedLayoutsAreWhole();
  await sharedFloorPlanAndSweptAreasAreThoseOfTheCommand();
} finally {
  await browser.close();
}
console.log(`all tests of the page passed; look at ${shots}`);
