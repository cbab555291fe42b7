// Changes words of a buffer: copies runs of words, sets or clears a bit, or spreads a few values.
//
// Bindings: batch, entries, words -> target_words. One thread per entry.

override THREADS: u32;

// Kinds of entries.
//   RUNS    three words: target word, first source word, number of words
//   BITS    one word: index of an element, and in the highest bit whether its bit is set
//   VALUES  one word: index of an element; behind them one word each, the index of its value
//   ALIKE   one word: index of an element; all get the first value
//   FILL    none: all elements get the first value
const RUNS: u32 = 0u;
const BITS: u32 = 1u;
const VALUES: u32 = 2u;
const ALIKE: u32 = 3u;
const FILL: u32 = 4u;
const SET: u32 = 0x80000000u;

struct Batch {
    entries: u32,
    kind: u32,
    // Words per element.
    element_words: u32,
    // The bit to set or clear in the first word of an element.
    bit: u32,
}

@group(0) @binding(0) var<uniform> batch: Batch;
@group(0) @binding(1) var<storage, read> entries: array<u32>;
@group(0) @binding(2) var<storage, read> words: array<u32>;
@group(0) @binding(3) var<storage, read_write> target_words: array<u32>;

fn copy_words(to: u32, first: u32, count: u32) {
    for (var i = 0u; i < count; i++) {
        target_words[to + i] = words[first + i];
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = (id.y * count.x + id.x) * THREADS + thread;
    if index >= batch.entries {
        return;
    }
    let size = batch.element_words;
    switch batch.kind {
        case RUNS: {
            copy_words(entries[3u * index], entries[3u * index + 1u], entries[3u * index + 2u]);
        }
        case BITS: {
            let entry = entries[index];
            let word = (entry & ~SET) * size;
            let others = target_words[word] & ~batch.bit;
            target_words[word] = others | select(0u, batch.bit, (entry & SET) != 0u);
        }
        case VALUES: {
            copy_words(entries[index] * size, entries[batch.entries + index] * size, size);
        }
        case ALIKE: {
            copy_words(entries[index] * size, 0u, size);
        }
        default: {
            copy_words(index * size, 0u, size);
        }
    }
}
