// Tests of the engine of several threads in Chromium. Usage, from the top of the repository, after
// `cargo xtask web` and a build of the command: node web/tests/threads.mjs

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join, relative, resolve } from "node:path";
import { encodedFiles, folder, guideway, isSame, launch } from "./harness.mjs";
import { ISOLATED, serve } from "./serve.mjs";

const isolated = await serve(resolve("."), ISOLATED);
const plain = await serve(resolve("."));
const browser = await launch();

/** A page with the element; `before` runs in it before the module, and may make workers fail. */
async function open(server, { cores = 2, before = "" } = {}) {
  writeFileSync(
    join(folder, "threads.html"),
    `<!doctype html><body style="margin: 0">
    <script>
      Object.defineProperty(navigator, "hardwareConcurrency", { get: () => ${cores} });
      ${before}
    </script>
    <guideway-view style="display: block; width: 640px; height: 400px"></guideway-view>
    <script type="module">
      window.view = document.querySelector("guideway-view");
      window.shares = [];
      window.library = await import("../../../web/dist/guideway.js");
      const { onprogress } = view.engine;
      view.engine.onprogress = (share) => (shares.push(share), onprogress(share));
    </script>`,
  );
  const page = await browser.newPage();
  page.setDefaultTimeout(120_000);
  page.on("pageerror", (error) => before || assert.fail(`the page failed: ${error}`));
  page.asked = [];
  page.said = [];
  page.on("request", (request) => page.asked.push(new URL(request.url()).pathname));
  page.on("console", (message) => page.said.push(message.text()));
  await page.goto(`${server.url}target/web/tests/threads.html`);
  await page.waitForFunction(() => window.library);
  return page;
}

/** Opens a file of the repository, and returns the number of its paths. */
const openFile = (page, path) =>
  page.evaluate(async (path) => {
    const name = path.split("/").pop();
    const bytes = await (await fetch(`/${path}`)).arrayBuffer();
    return (await view.open(new File([bytes], name))).paths;
  }, path);

const picture = async (page, look) => {
  const bytes = await page.evaluate(
    async (look) => [...new Uint8Array(await view.engine.call("png", [look]))],
    look,
  );
  return Buffer.from(bytes);
};

const threads = (page) => page.evaluate(async () => (await view.engine.started, view.threads));
const fetched = (page) => page.asked.filter((path) => path.includes("engine"));
const SITE = "crates/guideway/examples/site.lif.json";

async function picturesAreThoseOfOneThread() {
  const [many, one] = [await open(isolated), await open(plain)];
  assert.deepEqual([await threads(many), await threads(one)], [2, 1]);
  assert.deepEqual(fetched(many), ["/web/dist/engine-threads.wasm.gz"]);
  assert.deepEqual(fetched(one), ["/web/dist/engine.wasm.gz"]);
  const large = "target/web/tests/threads.arrow";
  guideway("generate", "d1", "--paths", "30000", "-o", large);
  for (const path of [large, ...encodedFiles().map((file) => relative(".", file)), SITE]) {
    const look = { width: 1280, height: 720, stations: true, scaleBar: true };
    const counts = await Promise.all([many, one].map((page) => openFile(page, path)));
    assert.equal(counts[0], counts[1]);
    const shown = await Promise.all([many, one].map((page) => picture(page, look)));
    assert.ok(shown[0].equals(shown[1]), `${path}: two threads draw another picture than one`);
    const expected = join(folder, "expected.png");
    guideway("render", path, "-o", expected, "--size", "1280x720", "--stations", "--scale-bar");
    assert.ok(isSame(shown[0], readFileSync(expected)), `${path}: the command draws another one`);
  }
  // A picture of a gesture: from one view to the next, parts of the last picture are kept.
  for (let i = 0; i < 20; i++) {
    const look = { width: 640, height: 400, center: [30 + i * 0.7, 20], pxPerM: 8 + i };
    const shown = await Promise.all([many, one].map((page) => picture(page, look)));
    assert.ok(shown[0].equals(shown[1]), `view ${i}`);
  }
  const findings = (page) => page.evaluate(() => view.check());
  assert.deepEqual(await findings(many), await findings(one));
  const shares = await many.evaluate(() => shares);
  assert.ok(shares.length > 0, "no progress was heard");
  await many.close();
  await one.close();
}

/** One thread is used, and its engine is fetched, where workers cannot share memory. */
async function oneThreadWhereMemoryIsNotShared() {
  for (const options of [{ before: "delete globalThis.SharedArrayBuffer;" }, { cores: 1 }]) {
    const page = await open(isolated, options);
    assert.equal(await threads(page), 1);
    assert.deepEqual(fetched(page), ["/web/dist/engine.wasm.gz"]);
    assert.equal(await openFile(page, SITE), 326);
    await page.close();
  }
  const page = await open(isolated, { cores: 64 });
  assert.equal(await threads(page), 8);
  assert.equal(await openFile(page, SITE), 326);
  await page.close();
}

/** Runs a script first in some workers of a page, which are counted from 0 on. */
const inWorkers = (which, script) => `
  let started = 0;
  const Real = Worker;
  window.Worker = class extends Real {
    constructor(url) {
      const isIt = ${JSON.stringify(which)}.includes(started++);
      const source = isIt ? \`${script}; importScripts("\${url}");\` : "";
      super(isIt ? URL.createObjectURL(new Blob([source])) : url);
    }
  };`;

async function oneThreadWhereThreadsDoNotStart() {
  const fails = 'throw new Error("no worker")';
  const noEngine = `window.fetch = ((fetch) => (url, ...rest) =>
    fetch(String(url).replace("engine-threads", "no-engine"), ...rest))(fetch);`;
  const noMemory = "WebAssembly.Memory = class { constructor() { throw RangeError('no memory') } }";
  for (const [before, said] of [
    [inWorkers([0], fails), /no worker/],
    [inWorkers([1], fails), /no worker/],
    [inWorkers([2], fails), /no worker/],
    [inWorkers([0], noMemory), /no memory/],
    [noEngine, /404/],
  ]) {
    const page = await open(isolated, { before });
    assert.equal(await openFile(page, SITE), 326);
    assert.equal(await threads(page), 1, before);
    const warned = page.said.filter((text) => text.startsWith("guideway draws by one thread"));
    assert.equal(warned.length, 1);
    assert.match(warned[0], said);
    await page.close();
  }
}

/** A thread that dies would leave the others waiting for it: all are started anew. */
async function threadThatDiesIsSaid() {
  const dies = "performance.now = () => { throw new Error('the thread died') }";
  // Either may draw.
  const page = await open(isolated, { before: inWorkers([1, 2], dies) });
  const failed = page.evaluate(
    () => new Promise((resolve) => view.addEventListener("error", (e) => resolve(e.message))),
  );
  await openFile(page, SITE).catch(() => {});
  assert.match(await failed, /the thread died/);
  assert.equal(await openFile(page, SITE), 326);
  await page.waitForFunction(() => view.map.drawn > 0);
  assert.equal(await threads(page), 2);
  await page.close();
}

/** Workers end with the element, and with a restart. */
async function workersEnd() {
  const page = await open(isolated);
  await threads(page);
  assert.equal(page.workers().length, 3);
  await page.evaluate(() => view.engine.restart());
  await threads(page);
  const workers = async (count) => {
    for (let i = 0; i < 50 && page.workers().length !== count; i++) await page.waitForTimeout(100);
    assert.equal(page.workers().length, count);
  };
  await workers(3);
  await page.evaluate(() => view.remove());
  await workers(0);
  await page.close();
}

try {
  await picturesAreThoseOfOneThread();
  await oneThreadWhereMemoryIsNotShared();
  await oneThreadWhereThreadsDoNotStart();
  await threadThatDiesIsSaid();
  await workersEnd();
} finally {
  await browser.close();
  isolated.close();
  plain.close();
}
console.log("all tests of several threads passed");
