// Line format: four 24-bit coordinates in three words, fixed-point in LOD pixels. All stages of a
// frame and later frames of the same LOD read the same words. The importing shader binds
// `lines: array<u32>`.
//
//     word 0: x1 (bits 0-22)  bits 0-7   of y2 (bits 24-31)
//     word 1: y1 (bits 0-22)  bits 8-15  of y2 (bits 24-31)  bit 23: a path starts at 1
//     word 2: x2 (bits 0-22)  bits 16-22 of y2 (bits 24-30)  bit 23: a path ends at 2

// import: shared/frame.wgsl
// import: shared/rounding.wgsl
// import: shared/work_counts.wgsl

const LINE_WORDS: u32 = 3u;
// First word of a culled line. No other line has bit 23 of that word set.
const NO_LINE: u32 = 0xffffffffu;
const PATH_END_BIT: u32 = 23u;
// 2^23: from here on floats are whole numbers, and their low bits are those of the number.
const WHOLE: f32 = 8388608.0;
// The step at the center of the LOD.
const MIDDLE: f32 = 4194304.0;
// The last step, in halves of the LOD from its center.
const LAST: f32 = 1.0 - 1.0 / MIDDLE;

fn packed_line(line: vec4f, path_ends: vec2<bool>) -> vec3u {
    let halves = clamp(line * (frame.steps_per_px * (1.0 / MIDDLE)), vec4f(-1.0), vec4f(LAST));
    let bits = bitcast<vec4u>(exact4(halves * MIDDLE) + (WHOLE + MIDDLE)) & vec4u(0x7fffffu);
    let ends = vec3u(0u, vec2u(path_ends) << vec2u(PATH_END_BIT));
    return bits.xyz | ends | ((vec3u(bits.w) << vec3u(24u, 16u, 8u)) & vec3u(0xff000000u));
}

// Bit 0: a path starts at the first point of a line. Bit 1: it ends at the second.
fn path_ends_of(words: vec3u) -> u32 {
    let ends = (words.yz >> vec2u(PATH_END_BIT)) & vec2u(1u);
    return ends.x | (ends.y << 1u);
}

// Returns a line in picture pixels.
fn line_of(words: vec3u) -> vec4f {
    let high = words >> vec3u(24u);
    let last = high.x | (high.y << 8u) | (high.z << 16u);
    let bits = vec4u(words & vec3u(0x7fffffu), last) | vec4u(0x4b000000u);
    let steps = bitcast<vec4f>(bits) - (WHOLE + MIDDLE);
    return rounded4(steps * frame.px_per_step) + frame.lod_origin_px.xyxy;
}

fn words_of_line(line: u32) -> vec3u {
    count_reads(LINE_WORDS);
    let first = line * LINE_WORDS;
    return vec3u(lines[first], lines[first + 1u], lines[first + 2u]);
}
