// Into how many lines a stroke is turned, and which.

// The ends of the pieces of a stroke, a bit a segment, and the lines of all pieces together.
struct Plan {
    ends: u32,
    lines: u32,
    // How many lines each of the first pieces has, in a few bits each: MANY if it has more.
    steps: u32,
}

fn lines_of_piece(segments: u32, square_bend: f32) -> u32 {
    return select(1u, steps_of(square_bend), segments == 1u);
}

// Pieces as long as one line may stand for; a segment that bends more is a piece of its own, and cut.
fn plan_of(curve: Curve, segments: u32) -> Plan {
    var plan = Plan(0u, 0u, 0u);
    var first = control_px(curve, 1u);
    var second = control_px(curve, 2u);
    var before = square_bend_of(control_px(curve, 0u), first, second);
    var piece = 0u;
    var worst = before;
    var segment = 0u;
    // There is one at least. A processor would go once more round a loop that looks for its end first.
    loop {
        let third = control_px(curve, segment + 3u);
        let bend = square_bend_of(first, second, third);
        first = second;
        second = third;
        if piece > 0u && !is_flat(piece + 1u, max(worst, bend)) {
            plan = with_piece(plan, segment - 1u, piece, worst);
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
    return with_piece(plan, segments - 1u, piece, worst);
}

// One line of a stroke: from step to step of a piece.
struct Part {
    first: u32,
    segments: u32,
    step: u32,
    steps: u32,
}
