// Sums over the threads of a workgroup.

// How much there is of all threads up to and with each.
var<workgroup> ends: array<u32, THREADS>;

// Sums up so much of each thread. Returns the sum up to and with this one.
fn add_up(thread: u32, own: u32) -> u32 {
    ends[thread] = own;
    workgroupBarrier();
    var end = own;
    for (var step = 1u; step < THREADS; step *= 2u) {
        if thread >= step {
            end += ends[thread - step];
        }
        workgroupBarrier();
        ends[thread] = end;
        workgroupBarrier();
    }
    return end;
}
