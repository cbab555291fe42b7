// Draw ranks of lines.

// That of a line; the one that stands for all where they have none.
fn rank_of(line: u32) -> u32 {
    if frame.has_ranks == 0u {
        return 0u;
    }
    reads(1u);
    return line_ranks[line];
}
