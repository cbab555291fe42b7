//! Dispatch of hot functions to the widest vector instructions of the processor.

/// Vector instructions to use. All levels give the same bits: tests force each and compare. Builds
/// without tests compile only the widest, because each level doubles the compile time of the
/// rasterizer; builds for debugging, which use no vectors, only the baseline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum SimdLevel {
    /// The widest that the processor has.
    #[default]
    Widest,
    /// Only those that every processor of the architecture has.
    #[cfg(test)]
    Baseline,
    /// Eight lanes (AVX2), if the processor has them.
    #[cfg(test)]
    Eight,
}

/// Defines a function that calls `$work`, compiled once per level. Its first argument is the
/// [`SimdLevel`]. Every function that `$work` calls has to be inlined (`#[inline(always)]`);
/// otherwise it is compiled for the baseline.
macro_rules! simd_dispatch {
    ($vis:vis fn $name:ident($($arg:ident: $type:ty),+) by $work:ident) => {
        $vis fn $name(simd: $crate::cpu::ground::simd::SimdLevel, $($arg: $type),+) {
            #[cfg_attr(any(test, not(debug_assertions)), multiversion::multiversion(targets(
                "x86_64+avx512f+avx512bw+avx512dq+avx512vl+bmi1+bmi2+lzcnt+popcnt",
                "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"
            )))]
            fn widest($($arg: $type),+) {
                $work($($arg),+);
            }

            #[cfg(test)]
            #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn eight($($arg: $type),+) {
                $work($($arg),+);
            }

            match simd {
                $crate::cpu::ground::simd::SimdLevel::Widest => widest($($arg),+),
                #[cfg(test)]
                $crate::cpu::ground::simd::SimdLevel::Eight => eight($($arg),+),
                #[cfg(test)]
                $crate::cpu::ground::simd::SimdLevel::Baseline => $work($($arg),+),
            }
        }
    };
}

pub(crate) use simd_dispatch;
