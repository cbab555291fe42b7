// How often threads go round their loops: some devices end those that go on for too long, without a word.

// Of this thread.
var<private> rounds: u32;
var<workgroup> most_rounds: atomic<u32>;

// All threads call each of these, with a barrier between one and the next.
fn begin_rounds(thread: u32) {
    if thread == 0u {
        atomicStore(&most_rounds, 0u);
    }
}

fn end_rounds() {
    atomicMax(&most_rounds, rounds);
}

fn tell_rounds(thread: u32) {
    if thread == 0u {
        atomics(1u);
        atomicMax(&found.counters.rounds, atomicLoad(&most_rounds));
    }
}
