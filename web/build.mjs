// Builds the page, one HTML file with style and script into which engine and layout are put, and the
// npm package with the element. Usage: node build.mjs FOLDER PAGE SYMBOLS, a font. The whole page
// goes to FOLDER/guideway.html, its parts go as gzip to PAGE, from where the command takes them,
// with the font and the module of the widget for notebooks. The package goes to dist beside this
// file; it alone has the engine of several threads.

import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { copyFile, mkdir, readFile, rm, stat, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const [folder, pageFolder, symbolsFile] = process.argv.slice(2);
const source = (name) => join(import.meta.dirname, "src", name);

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

// The worker's engine comes by message, never by address.
const worker = await bundle("worker.ts", { define: { "import.meta.url": '""' } });
// The same of the engine of several threads.
const threadsEngine = {
  name: "threads-engine",
  setup({ onResolve }) {
    onResolve({ filter: /^\.\.\/engine\// }, ({ path, resolveDir }) => {
      return { path: join(resolveDir, path.replace("../engine/", "../engine-threads/")) };
    });
  },
};
const workerOfThreads = await bundle("worker-threads.ts", {
  define: { "import.meta.url": '""' },
  plugins: [threadsEngine],
});
const elementStyle = await readFile(source("element.css"), "utf8");
/** Modules whose content is a text. */
const texts = {
  "worker-source": worker,
  "worker-threads-source": workerOfThreads,
  "element-style": elementStyle,
};
const textModules = {
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
const plugins = [textModules];
// A script must not contain the end of its own element.
const script = (await bundle("main.ts", { plugins })).replaceAll("</script", "<\\/script");
const style = await readFile(source("style.css"), "utf8");
const page = (await readFile(source("page.html"), "utf8"))
  .replace("/*STYLE*/", () => style)
  .replace("/*SCRIPT*/", () => script);

const optimizer = join(import.meta.dirname, "node_modules/.bin/wasm-opt");
const wasmFeatures = ["--enable-simd", "--enable-bulk-memory", "--enable-nontrapping-float-to-int"];
const moreFeatures = ["--enable-sign-ext", "--enable-mutable-globals", "--enable-reference-types"];
const changed = async (file) => (await stat(file).catch(() => ({ mtimeMs: 0 }))).mtimeMs;
/** Optimizes what `wasm-bindgen` made. It takes half a minute, so only a new engine is optimized. */
async function optimized(name, features = []) {
  const [from, to] = [join(import.meta.dirname, name, "guideway_web_bg.wasm"), join(folder, name)];
  const args = [from, "-o", `${to}.wasm`, "-O1", "--strip-debug", "--strip-producers"];
  const all = [...wasmFeatures, ...moreFeatures, "--enable-multivalue", ...features];
  if ((await changed(`${to}.wasm`)) < (await changed(from))) {
    execFileSync(optimizer, [...args, ...all]);
  }
  return readFile(`${to}.wasm`);
}

// Without the time of day, so that the same sources give the same bytes.
const packed = gzipSync(await optimized("engine"), { level: 9 });
const threads = gzipSync(await optimized("engine-threads", ["--enable-threads"]), { level: 9 });
await mkdir(pageFolder, { recursive: true });
await writeFile(join(pageFolder, "engine.wasm.gz"), packed);
const symbols = gzipSync(await readFile(symbolsFile), { level: 9 });
await writeFile(join(pageFolder, "symbols.ttf.gz"), symbols);
await writeFile(join(pageFolder, "page.html.gz"), gzipSync(page, { level: 9 }));
// The widget's engine comes from Python, never by address.
const noUrl = { "import.meta.url": '""' };
const widget = await bundle("widget.ts", { plugins, format: "esm", define: noUrl });
await writeFile(join(pageFolder, "widget.js.gz"), gzipSync(widget, { level: 9 }));
const part = (id, bytes) => {
  return `<script type="text/plain" id="${id}">${bytes.toString("base64")}</script>\n`;
};
const parts = part("engine", packed) + part("symbols", symbols);
await writeFile(join(folder, "guideway.html"), page.replace("<!--ENGINE-->", () => parts));

const dist = join(import.meta.dirname, "dist");
await rm(dist, { recursive: true, force: true });
await mkdir(dist);
await writeFile(join(dist, "guideway.js"), await bundle("package.ts", { plugins, format: "esm" }));
await writeFile(join(dist, "engine.wasm.gz"), packed);
await writeFile(join(dist, "engine-threads.wasm.gz"), threads);
await writeFile(join(dist, "symbols.ttf.gz"), symbols);
for (const license of ["LICENSE-APACHE", "LICENSE-MIT"]) {
  await copyFile(join(import.meta.dirname, "..", license), join(dist, license));
}
const compiler = join(import.meta.dirname, "node_modules/.bin/tsc");
const types = ["--noEmit", "false", "--declaration", "--emitDeclarationOnly", "--rootDir", "src"];
const project = ["--project", import.meta.dirname, "--outDir", join(dist, "types")];
execFileSync(compiler, [...project, ...types], { cwd: import.meta.dirname, stdio: "inherit" });
