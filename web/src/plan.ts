// The floor plan that somebody adds to the page: a file, and where an image lies.

import type { Placement } from "./answers.js";
import { byId } from "./panels.js";

const IMAGE = /\.(png|jpe?g|p[bgp]m)$/i;

/** Calls `show` with a file that is chosen, and with the place of an image. */
export function connectPlan(show: (file: File, placement: Placement | null) => void): void {
  const chosen = byId<HTMLInputElement>("plan-file");
  const place = byId<HTMLFormElement>("plan-place");
  let image: File | undefined;
  byId("choose-plan").onclick = () => chosen.click();
  chosen.onchange = () => {
    const file = chosen.files?.[0];
    chosen.value = "";
    if (!file) return;
    image = IMAGE.test(file.name) ? file : undefined;
    place.hidden = !image;
    if (!image) show(file, null);
  };
  place.onsubmit = (event) => {
    event.preventDefault();
    const number = (name: string) => byId<HTMLInputElement>(`plan-${name}`).valueAsNumber;
    const [pxPerM, rotateDeg] = [number("scale"), number("rotate")];
    if (image) show(image, { pxPerM, rotateDeg, offset: [number("x"), number("y")] });
  };
}
