//! Which vector instructions work is done with.

/// Which vector instructions to use. All give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(not(test), expect(dead_code, reason = "tests force each, and compare"))]
pub(super) enum LaneWidth {
    /// The widest that there are.
    #[default]
    Widest,
    /// None beyond what every processor of this kind has.
    Baseline,
    /// Eight lanes, where there are.
    Eight,
}

/// A function that does what another does, which is compiled for each kind of processor; all that it calls has to be inlined, or
/// is compiled for every processor. What is to be used comes first among its arguments.
macro_rules! by_lane_width {
    ($vis:vis fn $name:ident($($arg:ident: $type:ty),+) by $work:ident) => {
        $vis fn $name(lane_width: $crate::cpu::vectors::LaneWidth, $($arg: $type),+) {
            #[multiversion::multiversion(targets(
                "x86_64+avx512f+avx512bw+avx512dq+avx512vl+bmi1+bmi2+lzcnt+popcnt",
                "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"
            ))]
            fn widest($($arg: $type),+) {
                $work($($arg),+);
            }

            #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn eight($($arg: $type),+) {
                $work($($arg),+);
            }

            match lane_width {
                $crate::cpu::vectors::LaneWidth::Widest => widest($($arg),+),
                $crate::cpu::vectors::LaneWidth::Eight => eight($($arg),+),
                $crate::cpu::vectors::LaneWidth::Baseline => $work($($arg),+),
            }
        }
    };
}

pub(super) use by_lane_width;
