// Counts the work of a thread, for `count_work`. Compiles to nothing without the override COUNTS.

override COUNTS: bool = false;

struct Work {
    // Sample rows tested against a line.
    tests: u32,
    // Atomic operations on storage buffers.
    atomics: u32,
    words_read: u32,
    words_written: u32,
}

// Work of this thread.
var<private> work: Work;

fn count_tests(count: u32) {
    if COUNTS {
        work.tests += count;
    }
}

fn count_atomics(count: u32) {
    if COUNTS {
        work.atomics += count;
    }
}

fn count_reads(words: u32) {
    if COUNTS {
        work.words_read += words;
    }
}

fn count_writes(words: u32) {
    if COUNTS {
        work.words_written += words;
    }
}
