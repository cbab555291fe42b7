// The engine as the page calls it: a worker that is started again when it stops.

import workerSource from "worker-source";
import type { FontSource } from "./answers.js";
import { t } from "./text.js";
import { type Threaded, Threads } from "./threads.js";

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

const urlOf = (source: string) =>
  URL.createObjectURL(new Blob([source], { type: "text/javascript" }));

export class Engine {
  onprogress: (share: number) => void = () => {};
  private worker: Worker | undefined;
  private waiting = new Map<number, Waiting>();
  private next = 0;
  private readonly url = urlOf(workerSource);
  private readonly threadsUrl: string;
  private threads: Threads | undefined;
  private isStarted = false;
  /** Why the worker did not start. */
  private broken: string | undefined;
  started!: Promise<void>;

  /** Where an engine of several threads does not start, that of one does, which is fetched then. */
  constructor(
    private readonly source: () => Source | Promise<Source>,
    private readonly fonts: FontSource[],
    private threaded?: Threaded,
  ) {
    this.threadsUrl = threaded ? urlOf(threaded.worker) : "";
    this.restart();
  }

  /** The number of threads that draw. */
  get threadCount(): number {
    return this.threaded?.count ?? 1;
  }

  /** Stops what the engine does, and starts one without a layout. */
  restart(reason = "stopped"): void {
    this.stop(reason);
    this.started = this.threaded ? this.startThreaded(this.threaded) : this.start();
    this.started.catch(() => {});
  }

  private async start(): Promise<void> {
    const worker = this.startWorker(this.url);
    await this.post(worker, "start", [await this.source(), this.fonts]);
    this.isStarted = true;
  }

  private async startThreaded({ engine, count }: Threaded): Promise<void> {
    const worker = this.startWorker(this.threadsUrl);
    try {
      const module = await engine();
      const memory = await this.post<WebAssembly.Memory>(worker, "start", [module, this.fonts]);
      const threads = new Threads((reason) => {
        if (threads === this.threads) this.fail(reason);
      });
      this.threads = threads;
      await threads.start({ url: this.threadsUrl, count }, module, memory);
      await this.post(worker, "startThreads", [count]);
      this.isStarted = true;
    } catch (error) {
      // Another start has begun, or none is wanted any more.
      if (worker !== this.worker) throw error;
      console.warn(`guideway draws by one thread: ${String(error)}`);
      this.threaded = undefined;
      this.stop();
      await this.start();
    }
  }

  private startWorker(url: string): Worker {
    const worker = new Worker(url);
    this.worker = worker;
    worker.onmessage = ({ data }) => this.answer(data);
    worker.onerror = (event) => this.fail(event.message ?? "the worker did not start");
    return worker;
  }

  /** Ends the engine; calls that wait fail. */
  stop(reason = "stopped"): void {
    this.worker?.terminate();
    this.threads?.stop();
    this.worker = this.threads = this.broken = undefined;
    this.isStarted = false;
    this.reject(reason);
  }

  async call<T>(call: string, args: unknown[] = [], transfer: Transferable[] = []): Promise<T> {
    const { started } = this;
    await started;
    if (started !== this.started) throw new BrokenEngine("stopped");
    return this.post<T>(this.worker, call, args, transfer);
  }

  private post<T>(
    worker: Worker | undefined,
    call: string,
    args: unknown[],
    transfer: Transferable[] = [],
  ): Promise<T> {
    if (!worker || worker !== this.worker) return Promise.reject(new BrokenEngine("stopped"));
    if (this.broken !== undefined) return Promise.reject(new BrokenEngine(this.broken));
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
    if (this.isStarted) {
      this.restart(reason);
      return;
    }
    // It may fail before anything waits for it.
    this.broken = reason;
    this.reject(reason);
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
