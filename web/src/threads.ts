// Threads of an engine: workers that share its memory, which only an isolated page may do.

/** An engine of several threads. */
export interface Threaded {
  /** The source of its workers. */
  worker: string;
  engine: () => Promise<WebAssembly.Module>;
  /** Threads that draw. */
  count: number;
}

type Scope = { crossOriginIsolated?: boolean; SharedArrayBuffer?: unknown; navigator?: Navigator };
type Message = { broken?: string };

/** Threads of one element at most: each is a worker, and a page may have many elements. */
const MOST = 8;
/** Time in which all must have started. */
const START_MS = 20_000;

/** How many threads an engine has in this page: one where workers cannot share memory. */
export function threadCount(scope: Scope = globalThis): number {
  const mayShare = scope.crossOriginIsolated === true && scope.SharedArrayBuffer !== undefined;
  return mayShare ? Math.min(scope.navigator?.hardwareConcurrency ?? 1, MOST) : 1;
}

export class Threads {
  private readonly workers: Worker[] = [];
  /** Ends a start that is not over. */
  private cancel: (reason: Error) => void = () => {};

  /** `onfail` hears of each thread that does not start, or stops later. */
  constructor(private readonly onfail: (reason: string) => void) {}

  /** Starts the threads of an engine whose memory this is; resolves when all of them run. */
  async start(
    { url, count }: { url: string; count: number },
    engine: WebAssembly.Module,
    memory: WebAssembly.Memory,
  ): Promise<void> {
    const one = () =>
      new Promise<void>((resolve, reject) => {
        const worker = new Worker(url);
        this.workers.push(worker);
        const fail = (reason: string) => {
          reject(new Error(reason));
          this.onfail(reason);
        };
        worker.onmessage = ({ data }: MessageEvent<Message>) => {
          if (data.broken === undefined) resolve();
          else fail(data.broken);
        };
        worker.onerror = ({ message }) => fail(message || "a thread did not start");
        worker.postMessage({ id: 0, call: "thread", args: [engine, memory] });
      });
    let timer = 0;
    const late = new Promise<void>((_, reject) => {
      this.cancel = reject;
      const words = "the threads did not start in time";
      timer = setTimeout(() => reject(new Error(words)), START_MS) as unknown as number;
    });
    try {
      await Promise.race([Promise.all(Array.from({ length: count }, one)), late]);
    } finally {
      clearTimeout(timer);
    }
  }

  stop(): void {
    this.cancel(new Error("stopped"));
    for (const worker of this.workers) worker.terminate();
  }
}
