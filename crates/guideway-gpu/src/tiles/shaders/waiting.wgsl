// Lines of long lists wait until there are enough of them, so that all threads have work.

// Whether strokes are so thin that they need all samples. They hide hardly any other.
const IS_FINE: bool = WORDS > 2u;
// Longest list that is covered as it is: of fewer lines, too few are hidden to look for them.
const SHORT: u32 = select(TURN, 0x7fffffffu, IS_FINE);
// Lines that are looked at together, and rows of pixels that are worth covering together. Where all lists are covered
// as they are, nothing waits, and room for it would only keep other workgroups from running.
const LOOKS: u32 = select(TURN, 1u, IS_FINE);
const ENOUGH: u32 = select(256u, 1u, IS_FINE);
// Lines that a thread covers of a short list before it is seen whether any pixel is open.
const LINES_A_THREAD: u32 = 16u;
// Rows of samples that a thread covers of one line: what they share is looked up once.
const ROWS_A_THREAD: u32 = 4u;
// Lines that wait to be covered, and their rows of pixels, each with its line from bit 8 on.
var<workgroup> capsules: array<Capsule, 2u * LOOKS>;
var<workgroup> rows: array<u32, ENOUGH + LOOKS * TILE_PX>;
var<workgroup> waiting_lines: atomic<u32>;
var<workgroup> waiting_rows: atomic<u32>;

fn nothing_waits() {
    atomicStore(&waiting_lines, 0u);
    atomicStore(&waiting_rows, 0u);
}

fn wait(capsule: Capsule, shown: u32) {
    let line = atomicAdd(&waiting_lines, 1u);
    capsules[line] = capsule;
    var place = atomicAdd(&waiting_rows, countOneBits(shown));
    for (var left = shown; left != 0u; left &= left - 1u) {
        rows[place] = (line << 8u) | firstTrailingBit(left);
        place++;
    }
}

// Covers what waits, and closes what is then covered.
fn cover_waiting(thread: u32, count: u32) {
    let parts = SAMPLE_ROWS / ROWS_A_THREAD;
    for (var i = thread / parts; i < count; i += THREADS / parts) {
        let capsule = capsules[rows[i] >> 8u];
        let top = (rows[i] & 255u) * SAMPLE_ROWS;
        let touched = rows_touched(capsule);
        let first = max(touched.x, top);
        let end = min(touched.y, top + SAMPLE_ROWS);
        for (var row = first + (thread - first) % parts; row < end; row += parts) {
            cover_row(capsule, row);
        }
    }
    workgroupBarrier();
    close_if_covered(thread);
    if thread == 0u {
        nothing_waits();
    }
    workgroupBarrier();
}
