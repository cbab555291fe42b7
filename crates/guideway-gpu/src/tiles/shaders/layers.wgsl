// Tiles of any scene: lists are in falling draw rank, and strokes of one path stand together. What a path
// covers is gathered first, and then laid below all that was laid before.

// 0: opaque paths; 1: translucent ones among them; 2: how many paths cover a pixel.
override SHADING: u32;
const OPAQUE: u32 = 0u;
const TRANSLUCENT: u32 = 1u;
const DENSITY: u32 = 2u;

// Parts that one sample's share of a sum is counted in.
const PARTS: f32 = 256.0;

var<workgroup> capsules: array<Capsule, BATCH>;
var<workgroup> ranks: array<u32, BATCH>;
var<workgroup> colors: array<u32, BATCH>;
// Red, green, blue, and how much is hidden, for each pixel.
var<workgroup> sums: array<atomic<u32>, THREADS * 4>;

// What still shines through at each sample of this thread's row.
var<private> clear: array<f32, WORDS * 32>;

fn add(pixel: u32, color: vec4f, samples: f32) {
    let parts = vec4u(vec4f(color.rgb, 255.0) * samples * PARTS + 0.5);
    for (var channel = 0u; channel < 4u; channel++) {
        atomicAdd(&sums[pixel * 4u + channel], parts[channel]);
    }
}

// Lays a colour over what was gathered of a row, where nothing hides it, and gathers anew.
fn lay(row: u32, color: u32, gathered: ptr<function, Row>, covered: ptr<function, Row>) {
    let ink = channels(color);
    let opacity = ink.a / 255.0;
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    for (var word = 0u; word < WORDS; word++) {
        let fresh = select((*gathered)[word] & ~(*covered)[word], (*gathered)[word], SHADING == DENSITY);
        (*gathered)[word] = 0u;
        for (var of_word = 0u; of_word < pixels_a_word && fresh != 0u; of_word++) {
            let bits = bits_of_pixel(fresh, of_word);
            let pixel = (row / SAMPLE_ROWS) * TILE_PX + word * pixels_a_word + of_word;
            if bits == 0u {
                continue;
            }
            if SHADING == DENSITY {
                atomicAdd(&sums[pixel * 4u], countOneBits(bits));
            } else if SHADING == OPAQUE {
                add(pixel, ink, f32(countOneBits(bits)));
            } else {
                var taken = 0.0;
                for (var i = 0u; i < SAMPLES_A_ROW; i++) {
                    if ((bits >> i) & 1u) != 0u {
                        let sample = word * 32u + of_word * SAMPLES_A_ROW + i;
                        let part = clear[sample] * opacity;
                        taken += part;
                        clear[sample] -= part;
                    }
                }
                add(pixel, ink, taken);
            }
        }
        if SHADING != DENSITY && opacity >= 1.0 {
            (*covered)[word] |= fresh;
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, count);
    if index >= frame.columns * frame.rows {
        return;
    }
    let tile = tile_of(index);
    let list = list_of(index);
    let start = list.x;
    let end = list.y;
    if start >= end {
        write(tile, thread, select(frame.background, 0u, SHADING == DENSITY));
        return;
    }
    for (var channel = 0u; channel < 4u; channel++) {
        atomicStore(&sums[thread * 4u + channel], 0u);
    }
    workgroupBarrier();
    var covered = beyond(tile, thread);
    var gathered: Row;
    if SHADING == TRANSLUCENT {
        for (var i = 0u; i < WORDS * 32u; i++) {
            clear[i] = 1.0;
        }
    }
    var rank = 0xffffffffu;
    var color = 0u;
    for (var first = start; first < end; first += BATCH) {
        let batch = min(BATCH, end - first);
        if thread < batch {
            capsules[thread] = capsule_at(tile, first + thread);
            let rank = line_ranks[references[first + thread]];
            ranks[thread] = rank;
            colors[thread] = style_of(rank).color;
        }
        workgroupBarrier();
        for (var i = 0u; i < batch; i++) {
            if ranks[i] != rank {
                lay(thread, color, &gathered, &covered);
                rank = ranks[i];
                color = colors[i];
            }
            cover(&gathered, capsules[i], thread);
        }
        if SHADING == DENSITY {
            workgroupBarrier();
        } else if !any_open(thread, &covered) {
            break;
        }
    }
    lay(thread, color, &gathered, &covered);
    workgroupBarrier();
    let samples = f32(SAMPLE_ROWS * SAMPLES_A_ROW);
    var sum: vec4f;
    for (var channel = 0u; channel < 4u; channel++) {
        sum[channel] = f32(atomicLoad(&sums[thread * 4u + channel]));
    }
    if SHADING == DENSITY {
        write(tile, thread, bitcast<u32>(sum.x / samples));
    } else {
        let shares = sum / (samples * PARTS);
        write(tile, thread, over_background(shares.rgb, shares.a / 255.0));
    }
}
