// The npm package: defines `<guideway-view>`, and exports its types.

import threadedWorker from "worker-threads-source";
import { besideModule } from "./download.js";
import { GuidewayView } from "./element.js";

export type * from "./answers.js";
export { BrokenEngine, GuidewayError } from "./engine.js";
export type { ElementName, GuidewayViewEvents, Picked } from "./events.js";
export type { View } from "./map.js";
export { vehicleOf, type Vehicle } from "./vehicles.js";
export { GuidewayView };

GuidewayView.threadedWorker = threadedWorker;
GuidewayView.threadedEngineUrl = besideModule(
  () => new URL("./engine-threads.wasm.gz", import.meta.url),
);
if (globalThis.customElements && !customElements.get("guideway-view")) {
  customElements.define("guideway-view", GuidewayView);
}
