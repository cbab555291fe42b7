// Writes a number that no memory holds by chance to each word.

@group(0) @binding(0) var<storage, read_write> words: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) index: u32) {
    words[index] = 1234u + index;
}
