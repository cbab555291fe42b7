// What a frame takes. Only shaders that are made for that count it: for others this is no code at all.

override COUNTS: bool = false;

struct Work {
    // Rows of samples that were held against a line.
    tests: u32,
    // Operations on memory that all workgroups see.
    atomics: u32,
    words_read: u32,
    words_written: u32,
}

// Of this thread.
var<private> work: Work;

fn tests(count: u32) {
    if COUNTS {
        work.tests += count;
    }
}

fn atomics(count: u32) {
    if COUNTS {
        work.atomics += count;
    }
}

fn reads(words: u32) {
    if COUNTS {
        work.words_read += words;
    }
}

fn writes(words: u32) {
    if COUNTS {
        work.words_written += words;
    }
}
