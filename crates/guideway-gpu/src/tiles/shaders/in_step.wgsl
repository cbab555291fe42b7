// Threads that run in step on a processor, and are a workgroup of their own.

const LANES: u32 = 8u;

struct Thread {
    @builtin(subgroup_invocation_id) lane: u32,
}
