// Events of `<guideway-view>`, and how its calls name elements.

import type { Details, Info, Reference } from "./answers.js";
import type { View } from "./map.js";
import type { Vehicle } from "./vehicles.js";

/** An element of the layout, by its id or by kind and row. */
export type ElementName = string | Reference;

/** What the pointer is at. */
export type Picked = Details | { kind: "vehicle"; id: string; vehicle: Vehicle };

/** Events of `<guideway-view>`; none of them bubbles. */
export interface GuidewayViewEvents {
  /** A layout is open. */
  load: CustomEvent<Info>;
  /** `error.error` is a `GuidewayError`, unless the engine itself failed. */
  error: ErrorEvent;
  /** The pointer is at another element or vehicle, or at none (`null`). */
  hover: CustomEvent<Picked | null>;
  /** An element or a vehicle was clicked, or none of them (`null`). */
  select: CustomEvent<Picked | null>;
  /** Another part of the layout is shown. */
  viewchange: CustomEvent<View>;
}
