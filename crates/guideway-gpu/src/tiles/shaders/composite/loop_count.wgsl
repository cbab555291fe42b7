// Counts the loop iterations of threads. Some drivers end long-running threads without an error;
// the host refuses tiles near that limit. All threads call these functions, with a barrier between
// one and the next.

// import: shared/counters.wgsl

// Iterations of this thread.
var<private> loops: u32;
var<workgroup> workgroup_max_loops: atomic<u32>;

fn begin_loop_count(thread: u32) {
    if thread == 0u {
        atomicStore(&workgroup_max_loops, 0u);
    }
}

fn fold_loop_count() {
    atomicMax(&workgroup_max_loops, loops);
}

fn report_loop_count(thread: u32) {
    if thread == 0u {
        count_atomics(1u);
        atomicMax(&counters.totals.max_loops, atomicLoad(&workgroup_max_loops));
    }
}
