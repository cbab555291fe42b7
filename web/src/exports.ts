// What the modules of the npm package have in common: they define `<guideway-view>`, and export its
// types.

import { GuidewayView } from "./element.js";

export type * from "./answers.js";
export { BrokenEngine, GuidewayError } from "./engine.js";
export type { ElementName, GuidewayViewEvents, Picked } from "./events.js";
export type { View } from "./map.js";
export { vehicleOf, type Vehicle } from "./vehicles.js";
export { GuidewayView };

if (globalThis.customElements && !customElements.get("guideway-view")) {
  customElements.define("guideway-view", GuidewayView);
}
