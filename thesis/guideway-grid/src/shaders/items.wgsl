// One thread an item, over a range of them.

override WORKGROUP: u32;

struct Items {
    first: u32,
    // Behind the last.
    end: u32,
    // Which part of each item's work, where a thread would go round its loop too often for all of it.
    first_part: u32,
    end_part: u32,
}

@group(0) @binding(0) var<uniform> items: Items;

// The item of a thread; there is none from `items.end` on. Workgroups are dispatched in rows.
fn item_of(workgroup: vec3u, workgroups: vec3u, thread: u32) -> u32 {
    return items.first + (workgroup.y * workgroups.x + workgroup.x) * WORKGROUP + thread;
}
