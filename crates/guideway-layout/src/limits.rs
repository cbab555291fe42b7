/// Every limit that a reader holds to. Exceeding one is an error that names it.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Largest file that is read into memory whole, in bytes.
    pub file_bytes: u64,
    /// Most paths of one layout.
    pub paths: u64,
    /// Most control points of one layout after conversion.
    pub control_points: u64,
    /// Most control points or knots of one curve in a file.
    pub curve_points: usize,
    /// Highest degree of one curve in a file.
    pub degree: usize,
    /// Deepest nesting of a structured file.
    pub depth: usize,
    /// Most elements of a structured file.
    pub elements: u64,
    /// Longest identifier or attribute text, in bytes.
    pub text_bytes: usize,
    /// Largest absolute coordinate, in meters.
    pub coordinate_m: f64,
    /// Diagnostics kept whole for each code; beyond that they are counted.
    pub diagnostics_per_code: usize,
    /// Largest deviation when a curve cannot be converted exactly, in meters.
    pub conversion_tolerance_m: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 8 << 30,
            paths: 100_000_000,
            control_points: u64::from(u32::MAX),
            curve_points: 1_000_000,
            degree: 25,
            depth: 128,
            elements: 100_000_000,
            text_bytes: 1 << 20,
            coordinate_m: 1e9,
            diagnostics_per_code: 1_000,
            conversion_tolerance_m: 1e-4,
        }
    }
}
