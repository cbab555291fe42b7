// Lines as one stage hands them to the next, and one frame to another: four numbers of 24 bits in three words, steps in the
// level that they are made for.

const LINE_WORDS: u32 = 3u;
// The first word of a line that is out of sight: no other has the highest bit of a number set.
const NOWHERE: u32 = 0xffffffffu;
// Where the steps of floats are whole numbers, whose low bits are those of the float.
const WHOLE: f32 = 8388608.0;
// The step in the middle of the level.
const MIDDLE: f32 = 4194304.0;

fn packed_line(line: vec4f) -> vec3u {
    let steps = clamp(line * frame.steps_a_px + MIDDLE, vec4f(0.0), vec4f(WHOLE - 1.0));
    let bits = bitcast<vec4u>(steps + WHOLE) & vec4u(0x7fffffu);
    return bits.xyz | ((vec3u(bits.w) << vec3u(24u, 16u, 8u)) & vec3u(0xff000000u));
}

// Where a line is in the picture: by one operation, which no compiler can round in one stage otherwise than in another. What is
// counted has to be what is listed.
fn line_of(words: vec3u) -> vec4f {
    let high = words >> vec3u(24u);
    let last = high.x | (high.y << 8u) | (high.z << 16u);
    let steps = bitcast<vec4f>(vec4u(words & vec3u(0x7fffffu), last) | vec4u(0x4b000000u)) - (WHOLE + MIDDLE);
    return fma(steps, vec4f(frame.px_a_step), frame.line_origin_px.xyxy);
}

fn words_of_line(line: u32) -> vec3u {
    reads(LINE_WORDS);
    let first = line * LINE_WORDS;
    return vec3u(lines[first], lines[first + 1u], lines[first + 2u]);
}
