// Subdivides a stroke into pieces and lines. A piece is a run of segments flat enough for one line,
// or a single segment cut into lines of equal steps in t.
//
//     segments   0   1   2   3   4   5
//     pieces   |-------|---|-----------|     piece_ends = 0b100110
//     lines    |-------|-|-|-----------|     packed_lines = 1, 2, 1

// import: flatten/curve.wgsl

// Bit i of piece_ends: a piece ends with segment i. `lines`: of all pieces together.
struct Subdivision {
    piece_ends: u32,
    lines: u32,
    // Line counts of the first eight pieces, 4 bits each; MAX_PACKED_LINES: that many or more.
    packed_lines: u32,
}

fn piece_lines(segments: u32, squared_bend: f32) -> u32 {
    return select(1u, segment_lines(squared_bend), segments == 1u);
}

// Extends each piece as far as one line may replace it. A segment that bends more is cut.
fn subdivide(curve: Curve, segments: u32) -> Subdivision {
    var pieces = Subdivision(0u, 0u, 0u);
    var first = control_px(curve, 1u);
    var second = control_px(curve, 2u);
    var before = squared_bend_of(control_px(curve, 0u), first, second);
    var piece = 0u;
    var worst = before;
    var segment = 0u;
    // There is at least one segment.
    loop {
        let third = control_px(curve, segment + 3u);
        let bend = squared_bend_of(first, second, third);
        first = second;
        second = third;
        if piece > 0u && !is_flat(piece + 1u, max(worst, bend)) {
            pieces = append_piece(pieces, segment - 1u, piece, worst);
            piece = 0u;
            worst = before;
        }
        piece += 1u;
        worst = max(worst, bend);
        before = bend;
        segment++;
        if segment >= segments {
            break;
        }
    }
    return append_piece(pieces, segments - 1u, piece, worst);
}

// One line of a stroke: from `step` to `step + 1` of the `steps` of a piece.
struct CurvePiece {
    first: u32,
    segments: u32,
    step: u32,
    steps: u32,
}

const PIECE_BITS: u32 = 4u;
const MAX_PACKED_LINES: u32 = (1u << PIECE_BITS) - 1u;

fn append_piece(pieces: Subdivision, last: u32, segments: u32, squared_bend: f32) -> Subdivision {
    let lines = piece_lines(segments, squared_bend);
    let bit = countOneBits(pieces.piece_ends) * PIECE_BITS;
    let steps = select(0u, min(lines, MAX_PACKED_LINES) << (bit & 31u), bit < 32u);
    let piece_ends = pieces.piece_ends | (1u << last);
    return Subdivision(piece_ends, pieces.lines + lines, pieces.packed_lines | steps);
}

// Number of lines of a piece whose count is not packed.
fn long_piece_lines(curve: Curve, first: u32, segments: u32) -> u32 {
    if segments > 1u {
        return 1u;
    }
    return segment_lines(max(squared_bend(curve, first), squared_bend(curve, first + 1u)));
}

// Finds the line with this number.
fn locate_line(curve: Curve, pieces: Subdivision, number: u32) -> CurvePiece {
    var piece = CurvePiece(0u, 0u, number, 0u);
    var packed = pieces.packed_lines;
    loop {
        piece.segments = firstTrailingBit(pieces.piece_ends >> piece.first) + 1u;
        piece.steps = packed & MAX_PACKED_LINES;
        packed = packed >> PIECE_BITS;
        if piece.steps == 0u || piece.steps == MAX_PACKED_LINES {
            piece.steps = long_piece_lines(curve, piece.first, piece.segments);
        }
        // The last piece holds all remaining lines.
        let rest = (pieces.piece_ends >> (piece.first + piece.segments - 1u)) >> 1u;
        if piece.step < piece.steps || rest == 0u {
            break;
        }
        piece.step -= piece.steps;
        piece.first += piece.segments;
    }
    return piece;
}

// A point between two lines of a piece. Lines that meet get the same point, to the bit.
fn line_end_px(curve: Curve, piece: CurvePiece, step: u32) -> vec2f {
    if step == 0u {
        return knot_px(curve, piece.first);
    }
    if step == piece.steps {
        return knot_px(curve, piece.first + piece.segments);
    }
    return curve_px(curve, piece.first, f32(step) * reciprocal(f32(piece.steps)));
}
