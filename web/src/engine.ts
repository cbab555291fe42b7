// The engine as the page calls it: a worker that is started again when it stops.

import workerSource from "worker-source";
import type { Symbols } from "./answers.js";
import { t } from "./text.js";

/** A failure in the words of the command. */
export class GuidewayError extends Error {
  constructor(
    readonly code: string,
    message: string,
    readonly remedy: string,
  ) {
    super(message);
  }
}

/** The engine stopped: it ran out of memory, or it has a fault. */
export class BrokenEngine extends Error {}

/** A failure for people. */
export function wordsOf(error: unknown): string {
  if (error instanceof GuidewayError) return `${error.message}.\n${error.remedy}.`;
  if (!(error instanceof BrokenEngine)) return String(error);
  const cause =
    "Not enough memory, or a fault of this page. Open a smaller file, or use the command.";
  return `${t("The engine stopped")} (${error.message}).\n${t(cause)}`;
}

type Waiting = { resolve: (value: never) => void; reject: (error: Error) => void };
type Answer = {
  progress?: number;
  id: number;
  value: never;
  thrown?: { code: string; message: string; remedy: string };
  broken?: string;
};
/** The compiled engine, or the same as base64 of gzip. */
type Source = WebAssembly.Module | string;

export class Engine {
  onprogress: (share: number) => void = () => {};
  private worker: Worker | undefined;
  private waiting = new Map<number, Waiting>();
  private next = 0;
  private readonly url: string;
  private isStarted = false;
  started!: Promise<void>;

  constructor(
    private readonly source: Source | Promise<Source>,
    private readonly symbols?: Symbols,
  ) {
    this.url = URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" }));
    this.restart();
  }

  /** Stops what the engine does, and starts one without a layout. */
  restart(reason = "stopped"): void {
    this.stop(reason);
    const worker = new Worker(this.url);
    this.worker = worker;
    worker.onmessage = ({ data }) => this.answer(data);
    worker.onerror = (event) => this.fail(event.message ?? "the worker did not start");
    this.started = Promise.resolve(this.source)
      .then((source) => this.post<void>(worker, "start", [source, this.symbols]))
      .then(() => void (this.isStarted = true));
    this.started.catch(() => {});
  }

  /** Ends the engine; calls that wait fail. */
  stop(reason = "stopped"): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.isStarted = false;
    this.reject(reason);
  }

  async call<T>(call: string, args: unknown[] = [], transfer: Transferable[] = []): Promise<T> {
    const worker = this.worker;
    await this.started;
    return this.post<T>(worker, call, args, transfer);
  }

  private post<T>(
    worker: Worker | undefined,
    call: string,
    args: unknown[],
    transfer: Transferable[] = [],
  ): Promise<T> {
    if (!worker || worker !== this.worker) return Promise.reject(new BrokenEngine("stopped"));
    const id = this.next++;
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      worker.postMessage({ id, call, args }, transfer);
    });
  }

  private reject(reason: string): void {
    for (const { reject } of this.waiting.values()) reject(new BrokenEngine(reason));
    this.waiting.clear();
  }

  /** An engine that never started would not do so a second time. */
  private fail(reason: string): void {
    if (this.isStarted) this.restart(reason);
    else this.reject(reason);
  }

  private answer(data: Answer): void {
    if (data.progress !== undefined) {
      this.onprogress(data.progress);
      return;
    }
    const answer = this.waiting.get(data.id);
    this.waiting.delete(data.id);
    if (data.broken !== undefined) {
      answer?.reject(new BrokenEngine(data.broken));
      this.fail(data.broken);
    } else if (data.thrown) {
      const { code, message, remedy } = data.thrown;
      answer?.reject(new GuidewayError(code, message, remedy));
    } else {
      answer?.resolve(data.value);
    }
  }
}
