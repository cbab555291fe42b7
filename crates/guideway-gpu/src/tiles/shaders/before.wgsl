// What the stages before have found.

struct CountersBefore {
    rounded: u32,
    exact: u32,
    lines: u32,
    references: u32,
    drawn: u32,
    longest: u32,
    full_tiles: u32,
    rounds: u32,
    missing: u32,
    shared_tiles: u32,
    parts: u32,
    longest_alone: u32,
    work: array<u32, 8>,
}
