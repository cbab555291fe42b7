// The inside of `<guideway-view>`: canvas, buttons, progress, notice.

import elementStyle from "element-style";
import { t } from "./text.js";

export class Shadow {
  readonly canvas: HTMLCanvasElement;
  readonly buttons: HTMLButtonElement[];
  private readonly notice: HTMLElement;
  private readonly status: HTMLElement;
  private readonly progress: HTMLProgressElement;

  constructor(private readonly root: ShadowRoot) {
    root.innerHTML = `<style>${elementStyle}</style>
      <canvas part="canvas" tabindex="0" role="application"></canvas>
      <div part="controls"><button>+</button><button>&minus;</button><button></button></div>
      <div part="status" role="status" hidden><span></span> <progress max="1"></progress></div>
      <div part="notice" role="alert" hidden></div>`;
    this.canvas = root.querySelector("canvas")!;
    this.notice = root.querySelector("[part=notice]")!;
    this.status = root.querySelector("[part=status]")!;
    this.progress = root.querySelector("progress")!;
    this.buttons = [...root.querySelectorAll("button")];
    const [nearer, farther, all] = this.buttons;
    nearer!.setAttribute("aria-label", t("Zoom in"));
    farther!.setAttribute("aria-label", t("Zoom out"));
    all!.textContent = t("Fit");
  }

  /** Names the map for those who hear the page. */
  label(words: string | null): void {
    const keys = "Map of the layout. Arrow keys move, plus and minus zoom, 0 shows all.";
    this.canvas.setAttribute("aria-label", words ?? t(keys));
  }

  /** Says that something takes time; no words end it. */
  busy(words: string): void {
    this.root.querySelector("span")!.textContent = words;
    this.status.hidden = !words;
    this.progress.removeAttribute("value");
  }

  advance(share: number): void {
    this.progress.value = share;
  }

  /** Says that something went wrong; no words end it. */
  warn(words: string): void {
    this.notice.textContent = words;
    this.notice.hidden = !words;
  }
}
