// How many lines the first pieces of a stroke have is a part of its plan; of the others it is found out again.

const STEPS_BITS: u32 = 4u;
const MANY: u32 = (1u << STEPS_BITS) - 1u;

fn with_piece(plan: Plan, last: u32, segments: u32, square_bend: f32) -> Plan {
    let lines = lines_of_piece(segments, square_bend);
    let bit = countOneBits(plan.ends) * STEPS_BITS;
    let steps = select(0u, min(lines, MANY) << (bit & 31u), bit < 32u);
    return Plan(plan.ends | (1u << last), plan.lines + lines, plan.steps | steps);
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
