//! Which vector instructions work is done with.

/// Which vector instructions to use. All give the same bits: tests force each, and compare. For them alone are the others compiled: they cost as
/// much building as all else here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum LaneWidth {
    /// The widest that there are.
    #[default]
    Widest,
    /// None beyond what every processor of this kind has.
    #[cfg(test)]
    Baseline,
    /// Eight lanes, where there are.
    #[cfg(test)]
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

            #[cfg(test)]
            #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn eight($($arg: $type),+) {
                $work($($arg),+);
            }

            match lane_width {
                $crate::cpu::vectors::LaneWidth::Widest => widest($($arg),+),
                #[cfg(test)]
                $crate::cpu::vectors::LaneWidth::Eight => eight($($arg),+),
                #[cfg(test)]
                $crate::cpu::vectors::LaneWidth::Baseline => $work($($arg),+),
            }
        }
    };
}

pub(super) use by_lane_width;
