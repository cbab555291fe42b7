// Builds the page, one HTML file with style and script into which engine and layout are put, and the
// npm package with the element. Usage: node build.mjs FOLDER PAGE FONTS. The whole page
// goes to FOLDER/guideway.html. The parts of a shared page go as gzip to PAGE, from where the command
// takes them, with the module of the widget for notebooks. The package goes to dist beside this file.
// FONTS is the folder with the fonts that few names need.
//
// There are three engines in folders beside this file: the whole one, one for fewer bytes, which reads
// layouts of Arrow, and one of several threads, in the npm package alone. Each has its own worker.

import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { copyFile, mkdir, readFile, rm, stat, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const [folder, pageFolder, fontsFolder] = process.argv.slice(2);
const source = (name) => join(import.meta.dirname, "src", name);
// Without the time of day, so that the same sources give the same bytes.
const packed = (content) => gzipSync(content, { level: 9 });
const noUrl = { define: { "import.meta.url": '""' } };

async function bundle(entry, options) {
  const built = await build({
    entryPoints: [source(entry)],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    legalComments: "none",
    ...options,
  });
  return built.outputFiles[0].text;
}

/** The source of the worker of an engine, which comes by message, never by address. */
function workerOf(engine, entry = "worker.ts") {
  const calls = {
    name: "calls",
    setup({ onResolve }) {
      const path = join(import.meta.dirname, engine, "guideway_web.js");
      onResolve({ filter: /\/engine(-threads)?\/guideway_web\.js$/ }, () => ({ path }));
    },
  };
  return bundle(entry, { plugins: [calls], ...noUrl });
}

const threadsSource = await workerOf("engine-threads", "worker-threads.ts");
const elementStyle = await readFile(source("element.css"), "utf8");

/** Workers and the style of the element as modules whose content is a text. */
async function textsOf(engine) {
  const texts = {
    "worker-source": await workerOf(engine),
    "worker-threads-source": threadsSource,
    "element-style": elementStyle,
  };
  const modules = {
    name: "texts",
    setup({ onResolve, onLoad }) {
      onResolve({ filter: /^(worker-source|worker-threads-source|element-style)$/ }, ({ path }) => {
        return { path, namespace: "texts" };
      });
      onLoad({ filter: /.*/, namespace: "texts" }, ({ path }) => {
        return { contents: texts[path], loader: "text" };
      });
    },
  };
  return { plugins: [modules] };
}

async function page(texts) {
  // A script must not contain the end of its own element.
  const script = (await bundle("main.ts", texts)).replaceAll("</script", "<\\/script");
  const style = await readFile(source("style.css"), "utf8");
  return (await readFile(source("page.html"), "utf8"))
    .replace("/*STYLE*/", () => style)
    .replace("/*SCRIPT*/", () => script);
}

/** Optimizes and packs an engine. */
async function packedEngine(engine, more = []) {
  const to = join(folder, `${engine}.wasm`);
  const optimizer = join(import.meta.dirname, "node_modules/.bin/wasm-opt");
  const from = join(import.meta.dirname, engine, "guideway_web_bg.wasm");
  const needed = ["simd", "bulk-memory", "nontrapping-float-to-int", "sign-ext"];
  const features = [...needed, "mutable-globals", "reference-types", "multivalue", ...more];
  const enabled = features.map((feature) => `--enable-${feature}`);
  const args = [from, "-o", to, "-O1", "--strip-debug", "--strip-producers", ...enabled];
  const changed = async (file) => (await stat(file).catch(() => ({ mtimeMs: 0 }))).mtimeMs;
  // It takes half a minute, so only a new engine is optimized.
  if ((await changed(to)) < (await changed(from))) execFileSync(optimizer, args);
  return packed(await readFile(to));
}

const [whole, ofArrow] = [await textsOf("engine"), await textsOf("engine-arrow")];
const wholeEngine = await packedEngine("engine");
const arrowEngine = await packedEngine("engine-arrow");
const threadsEngine = await packedEngine("engine-threads", ["threads"]);
const packedFont = async (name) => packed(await readFile(join(fontsFolder, `${name}.ttf`)));
const fonts = { letters: await packedFont("letters"), symbols: await packedFont("symbols") };

await mkdir(pageFolder, { recursive: true });
await writeFile(join(pageFolder, "engine-arrow.wasm.gz"), arrowEngine);
await writeFile(join(pageFolder, "page.html.gz"), packed(await page(ofArrow)));
// The widget's engine comes from Python, never by address.
const widget = await bundle("widget.ts", { ...ofArrow, format: "esm", ...noUrl });
await writeFile(join(pageFolder, "widget.js.gz"), packed(widget));
const part = (id, bytes) => {
  return `<script type="text/plain" id="${id}">${bytes.toString("base64")}</script>\n`;
};
const parts = Object.entries({ engine: wholeEngine, ...fonts }).map((of) => part(...of)).join("");
const wholePage = (await page(whole)).replace("<!--ENGINE-->", () => parts);
await writeFile(join(folder, "guideway.html"), wholePage);

const dist = join(import.meta.dirname, "dist");
await rm(dist, { recursive: true, force: true });
await mkdir(dist);
for (const [name, texts] of Object.entries({ package: whole, "package-arrow": ofArrow })) {
  const module = await bundle(`${name}.ts`, { ...texts, format: "esm" });
  await writeFile(join(dist, `${name.replace("package", "guideway")}.js`), module);
}
await writeFile(join(dist, "engine.wasm.gz"), wholeEngine);
await writeFile(join(dist, "engine-arrow.wasm.gz"), arrowEngine);
await writeFile(join(dist, "engine-threads.wasm.gz"), threadsEngine);
for (const [name, font] of Object.entries(fonts)) {
  await writeFile(join(dist, `${name}.ttf.gz`), font);
}
for (const license of ["LICENSE-APACHE", "LICENSE-MIT"]) {
  await copyFile(join(import.meta.dirname, "..", license), join(dist, license));
}
const compiler = join(import.meta.dirname, "node_modules/.bin/tsc");
const types = ["--noEmit", "false", "--declaration", "--emitDeclarationOnly", "--rootDir", "src"];
const project = ["--project", import.meta.dirname, "--outDir", join(dist, "types")];
execFileSync(compiler, [...project, ...types], { cwd: import.meta.dirname, stdio: "inherit" });
