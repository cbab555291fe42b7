// A range of items, one per thread, and the part of each item's work.

override WORKGROUP: u32;

struct Items {
    first: u32,
    // One past the last.
    end: u32,
    // The part of each item's work, which bounds the iterations of a thread.
    first_part: u32,
    end_part: u32,
}

@group(0) @binding(0) var<uniform> items: Items;

// The item of a thread; items from `items.end` on do not exist. Workgroups are dispatched in rows.
fn item_of(workgroup: vec3u, workgroups: vec3u, thread: u32) -> u32 {
    return items.first + (workgroup.y * workgroups.x + workgroup.x) * WORKGROUP + thread;
}
