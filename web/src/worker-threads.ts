// The worker of an engine of several threads, or one of these threads.

import init, { run_thread, start_threads } from "../engine-threads/guideway_web.js";
import { calls } from "./worker.js";

Object.assign(calls, {
  /** Runs a thread of the engine with this memory: says so, and answers nothing any more. */
  thread: async (engine: WebAssembly.Module, memory: WebAssembly.Memory) => {
    await init({ module_or_path: engine, memory });
    postMessage({});
    run_thread();
  },
  startThreads: (count: number) => start_threads(count),
});
