// Drives Firefox by its own protocol, Marionette: texts of JSON with their length before them.

import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createConnection } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

const PATIENCE_MS = 120_000;
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Starts Firefox with a profile of its own. */
export async function launchFirefox() {
  const profile = mkdtempSync(join(tmpdir(), "guideway-firefox-"));
  writeFileSync(join(profile, "user.js"), 'user_pref("marionette.port", 0);\n');
  const program = process.env["GUIDEWAY_FIREFOX"] ?? "/usr/bin/firefox-esr";
  const args = ["--headless", "--marionette", "--no-remote", "--profile", profile];
  const firefox = spawn(program, args, { stdio: "ignore" });
  const portFile = join(profile, "MarionetteActivePort");
  const end = Date.now() + PATIENCE_MS;
  while (!existsSync(portFile) || !readFileSync(portFile, "utf8").trim()) {
    if (Date.now() > end) throw new Error(`${program} opens no port`);
    await wait(100);
  }
  const socket = createConnection(Number(readFileSync(portFile, "utf8")), "127.0.0.1");
  const waiting = new Map();
  let received = Buffer.alloc(0);
  socket.on("data", (data) => {
    received = Buffer.concat([received, data]);
    for (;;) {
      const colon = received.indexOf(":");
      const start = colon + 1;
      const length = Number(received.toString("latin1", 0, Math.max(colon, 0)));
      if (colon < 0 || received.length < start + length) return;
      const message = JSON.parse(received.toString("utf8", start, start + length));
      received = received.subarray(start + length);
      // The first message is a greeting.
      if (!Array.isArray(message)) continue;
      const [, id, error, result] = message;
      const { resolve, reject } = waiting.get(id);
      waiting.delete(id);
      if (error) reject(new Error(error.message));
      else resolve(result);
    }
  });
  let last = 0;
  const send = (name, parameters = {}) =>
    new Promise((resolve, reject) => {
      const id = ++last;
      waiting.set(id, { resolve, reject });
      const text = Buffer.from(JSON.stringify([0, id, name, parameters]));
      socket.write(Buffer.concat([Buffer.from(`${text.length}:`), text]));
    });
  await send("WebDriver:NewSession");
  await send("WebDriver:SetTimeouts", { script: PATIENCE_MS, pageLoad: PATIENCE_MS });
  await send("WebDriver:SetWindowRect", { width: 1280, height: 800 });
  /** What a function in the page returns, or what its promise becomes. */
  const evaluate = async (work, ...args) => {
    const script = `const done = arguments[arguments.length - 1];
      (async () => (${work})(...[...arguments].slice(0, -1)))()
        .then((value) => done({ value }), (error) => done({ error: String(error) }));`;
    const { value } = await send("WebDriver:ExecuteAsyncScript", { script, args, sandbox: null });
    if (value.error) throw new Error(value.error);
    return value.value;
  };
  return {
    evaluate,
    /** Opens a page, and waits until a function in it returns something true. */
    async open(url, isReady) {
      await send("WebDriver:Navigate", { url });
      const end = Date.now() + PATIENCE_MS;
      while (!(await evaluate(isReady))) {
        if (Date.now() > end) throw new Error(`${url} is not ready`);
        await wait(100);
      }
    },
    async screenshot(file) {
      const { value } = await send("WebDriver:TakeScreenshot", { full: false });
      writeFileSync(file, Buffer.from(value, "base64"));
    },
    async close() {
      const ended = new Promise((resolve) => firefox.once("exit", resolve));
      await send("Marionette:Quit", { flags: ["eForceQuit"] });
      await ended;
      socket.destroy();
      rmSync(profile, { recursive: true, force: true });
    },
  };
}
