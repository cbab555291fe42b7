// Gives the element the engine of several threads, which isolated pages take.

import threadedWorker from "worker-threads-source";
import { besideModule } from "./download.js";
import { GuidewayView } from "./element.js";

GuidewayView.threadedWorker = threadedWorker;
GuidewayView.threadedEngineUrl = besideModule(
  () => new URL("./engine-threads.wasm.gz", import.meta.url),
);
