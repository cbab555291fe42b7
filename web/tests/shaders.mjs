// Compiles every shader of the method `gpu` with Tint, in Chromium's WebGPU on SwiftShader. Usage:
// node web/tests/shaders.mjs, from the top of the repository, after
// cargo test --workspace --lib -- --ignored write_every_shader

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { chromium } from "playwright-core";

/** What every device of WebGPU has. */
const STORAGE_BUFFERS = 8;
/** Shaders that bind more, with their number: they need a device with higher limits. */
const BEYOND = { cover_split_tiles: 9 };

const folder = resolve("target/web/shaders");
const shaders = readdirSync(folder).map((name) => {
  const text = readFileSync(join(folder, name), "utf8");
  // Naga needs neither. The threads of a subgroup meet in loops of the same length, which a value
  // that they share bounds; the language has no way to say so.
  const head = "enable subgroups;\ndiagnostic(off, subgroup_uniformity);\n";
  const code = /\bsubgroup\w*\(/.test(text) ? head + text : text;
  return { name: name.replace(/^\d+ |\.wgsl$/g, ""), code };
});
assert.ok(shaders.length > 20, `${folder} has ${shaders.length} shaders`);
// The test must see what is wrong.
shaders.push({
  name: "wrong",
  code: `@group(0) @binding(0) var<storage, read_write> all: array<u32>;
    @compute @workgroup_size(64) fn main(@builtin(local_invocation_index) i: u32) {
      if (all[i] > 3u) { workgroupBarrier(); }
    }`,
});

const browser = await chromium.launch({
  executablePath: process.env["GUIDEWAY_CHROMIUM"] ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"],
});
const page = await browser.newPage();
// WebGPU needs an address of this machine; nothing is asked of it.
await page.route("**", (route) => route.fulfill({ contentType: "text/html", body: "" }));
await page.goto("http://localhost/");
const compiled = await page.evaluate(async (shaders) => {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return "no adapter";
  const hasSubgroups = adapter.features.has("subgroups");
  const requiredFeatures = hasSubgroups ? ["subgroups"] : [];
  const device = await adapter.requestDevice({ requiredFeatures });
  const faults = [];
  for (const { name, code } of shaders) {
    if (!hasSubgroups && code.startsWith("enable")) {
      faults.push({ name, skipped: true });
      continue;
    }
    device.pushErrorScope("validation");
    const module = device.createShaderModule({ code });
    const { messages } = await module.getCompilationInfo();
    await device.popErrorScope();
    const errors = messages.filter(({ type }) => type === "error");
    faults.push({ name, errors: errors.map(({ lineNum, message }) => `${lineNum}: ${message}`) });
  }
  return faults;
}, shaders);
await browser.close();

assert.notEqual(compiled, "no adapter", "Chromium has no SwiftShader adapter");
const wrong = compiled.pop();
assert.ok(wrong.errors.length > 0, "a shader with a barrier in a branch was taken");
const skipped = compiled.filter((shader) => shader.skipped);
const refused = compiled.filter(({ errors }) => errors?.length);
for (const { name, errors } of refused) console.log(`${name}\n  ${errors.join("\n  ")}`);
assert.equal(refused.length, 0, `Tint refuses ${refused.length} shaders`);
for (const { name, code } of shaders.slice(0, -1)) {
  const buffers = code.match(/var<storage/g)?.length ?? 0;
  const most = BEYOND[name] ?? STORAGE_BUFFERS;
  assert.ok(buffers <= most, `${name} binds ${buffers} storage buffers, limit ${most}`);
}
console.log(`Tint takes ${compiled.length - skipped.length} shaders, ${skipped.length} skipped`);
