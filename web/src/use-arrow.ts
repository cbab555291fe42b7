// Gives the element the engine that reads layouts of Arrow.

import { besideModule } from "./download.js";
import { GuidewayView } from "./element.js";

GuidewayView.engineUrl = besideModule(
  () => new URL("./engine-arrow.wasm.gz", import.meta.url),
);
