//! [`Limits`]: bounds on what a reader accepts from untrusted files, and on what is written.

/// Limits of readers and writers. Exceeding one is an error that names the limit, the value and the
/// remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Largest file that a reader loads into memory as a whole, in bytes.
    pub file_bytes: u64,
    /// Most paths per layout.
    pub paths: u64,
    /// Most control points per layout, after conversion to runs.
    pub control_points: u64,
    /// Most control points or knots per curve in a file.
    pub curve_points: usize,
    /// Highest degree of a curve in a file.
    pub degree: usize,
    /// Deepest nesting of a structured file.
    pub depth: usize,
    /// Most elements per structured file.
    pub elements: u64,
    /// Longest identifier or attribute text, in bytes.
    pub text_bytes: usize,
    /// Largest absolute coordinate, in meters.
    pub coordinate_m: f64,
    /// Diagnostics stored per code; further ones only count.
    pub diagnostics_per_code: usize,
    /// Largest distance between a curve and its conversion to runs, in meters.
    pub conversion_tolerance_m: f64,
    /// Largest file that is written, in bytes.
    pub output_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 8 << 30,
            paths: 100_000_000,
            // Derived: `Geometry` stores end indices as `u32`.
            control_points: u64::from(u32::MAX),
            curve_points: 1_000_000,
            degree: guideway_spline::MAX_DEGREE,
            depth: 128,
            elements: 100_000_000,
            text_bytes: 1 << 20,
            coordinate_m: 1e9,
            diagnostics_per_code: 1_000,
            conversion_tolerance_m: 1e-4,
            // As `file_bytes`: what is written can be read.
            output_bytes: 8 << 30,
        }
    }
}
