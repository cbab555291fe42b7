// Scatters new values to their places in a buffer.
//
// Bindings: batch, runs, words -> target_words. One thread per run of adjacent words.

override THREADS: u32;

struct Batch {
    runs: u32,
}

struct Run {
    target_word: u32,
    source: u32,
    words: u32,
}

@group(0) @binding(0) var<uniform> batch: Batch;
@group(0) @binding(1) var<storage, read> runs: array<Run>;
@group(0) @binding(2) var<storage, read> words: array<u32>;
@group(0) @binding(3) var<storage, read_write> target_words: array<u32>;

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = (id.y * count.x + id.x) * THREADS + thread;
    if index >= batch.runs {
        return;
    }
    let run = runs[index];
    for (var i = 0u; i < run.words; i++) {
        target_words[run.target_word + i] = words[run.source + i];
    }
}
