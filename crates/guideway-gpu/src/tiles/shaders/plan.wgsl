// Into how many lines a stroke is turned, and which.

// The ends of the pieces of a stroke, a bit a segment, and the lines of all pieces together.
struct Plan {
    ends: u32,
    lines: u32,
    // How many lines each of the first pieces has, in a few bits each: MANY if it has more.
    steps: u32,
}

const STEPS_BITS: u32 = 4u;
const MANY: u32 = (1u << STEPS_BITS) - 1u;

fn with_piece(plan: Plan, last: u32, segments: u32, square_bend: f32) -> Plan {
    let lines = select(1u, steps_of(square_bend), segments == 1u);
    let bit = countOneBits(plan.ends) * STEPS_BITS;
    let steps = select(0u, min(lines, MANY) << (bit & 31u), bit < 32u);
    return Plan(plan.ends | (1u << last), plan.lines + lines, plan.steps | steps);
}

// Pieces as long as one line may stand for; a segment that bends more is a piece of its own, and cut.
fn plan_of(curve: Curve, segments: u32) -> Plan {
    var plan = Plan(0u, 0u, 0u);
    var first = control_px(curve, 1u);
    var second = control_px(curve, 2u);
    var before = square_bend_of(control_px(curve, 0u), first, second);
    var piece = 0u;
    var worst = before;
    for (var segment = 0u; segment < segments; segment++) {
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

// How many lines a piece has that its plan does not tell.
fn steps_of_piece(curve: Curve, first: u32, segments: u32) -> u32 {
    if segments > 1u {
        return 1u;
    }
    return steps_of(max(square_bend(curve, first), square_bend(curve, first + 1u)));
}

// The line of that number.
fn part_of(curve: Curve, plan: Plan, number: u32) -> Part {
    var part = Part(0u, 0u, number, 0u);
    var told = plan.steps;
    loop {
        part.segments = firstTrailingBit(plan.ends >> part.first) + 1u;
        part.steps = told & MANY;
        told = told >> STEPS_BITS;
        if part.steps == 0u || part.steps == MANY {
            part.steps = steps_of_piece(curve, part.first, part.segments);
        }
        // The last piece has what is left.
        let rest = (plan.ends >> (part.first + part.segments - 1u)) >> 1u;
        if part.step < part.steps || rest == 0u {
            break;
        }
        part.step -= part.steps;
        part.first += part.segments;
    }
    return part;
}

// A point between two lines of a piece: lines that meet get the same one, to the bit.
fn joint_px(curve: Curve, part: Part, step: u32) -> vec2f {
    if step == 0u {
        return vertex_px(curve, part.first);
    }
    if step == part.steps {
        return vertex_px(curve, part.first + part.segments);
    }
    return point_px(curve, part.first, f32(step) / f32(part.steps));
}
