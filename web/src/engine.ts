// The engine as the page calls it: a worker that is started again when it stops.

import workerSource from "worker-source";

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

type Answer = { resolve: (value: never) => void; reject: (error: Error) => void };

export class Engine {
  onprogress: (share: number) => void = () => {};
  private worker!: Worker;
  private waiting = new Map<number, Answer>();
  private next = 0;
  private readonly url: string;
  started!: Promise<void>;

  /** `packed` is the engine as base64 of gzip. */
  constructor(private readonly packed: string) {
    this.url = URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" }));
    this.restart();
  }

  /** Stops what the engine does, and starts one without a layout. */
  restart(reason = "stopped"): void {
    this.worker?.terminate();
    for (const { reject } of this.waiting.values()) reject(new BrokenEngine(reason));
    this.waiting.clear();
    this.worker = new Worker(this.url);
    this.worker.onmessage = ({ data }) => this.answer(data);
    this.worker.onerror = (event) => this.restart(event.message);
    this.started = this.call<void>("start", [this.packed]);
    this.started.catch(() => {});
  }

  call<T>(call: string, args: unknown[] = [], transfer: Transferable[] = []): Promise<T> {
    const id = this.next++;
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, call, args }, transfer);
    });
  }

  private answer(data: {
    progress?: number;
    id: number;
    value: never;
    thrown?: { code: string; message: string; remedy: string };
    broken?: string;
  }): void {
    if (data.progress !== undefined) {
      this.onprogress(data.progress);
      return;
    }
    const answer = this.waiting.get(data.id);
    this.waiting.delete(data.id);
    if (data.broken !== undefined) {
      answer?.reject(new BrokenEngine(data.broken));
      this.restart(data.broken);
    } else if (data.thrown) {
      const { code, message, remedy } = data.thrown;
      answer?.reject(new GuidewayError(code, message, remedy));
    } else {
      answer?.resolve(data.value);
    }
  }
}
