// Inclusive prefix sum over the threads of a workgroup (Hillis and Steele 1986), in log2(THREADS)
// steps. The importing shader declares `override THREADS: u32`.

// Inclusive sums of all threads.

var<workgroup> scan_ends: array<u32, THREADS>;

// Returns the sum of `own` up to and including this thread.
fn workgroup_scan(thread: u32, own: u32) -> u32 {
    scan_ends[thread] = own;
    workgroupBarrier();
    var end = own;
    for (var step = 1u; step < THREADS; step *= 2u) {
        if thread >= step {
            end += scan_ends[thread - step];
        }
        workgroupBarrier();
        scan_ends[thread] = end;
        workgroupBarrier();
    }
    return end;
}
