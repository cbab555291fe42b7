//! Errors of opening a variant: options that are wrong, or a device that rejects the shaders.

use guideway_gpu::DeviceError;

/// The reason why [`Grid::new`](crate::Grid::new) failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// An option is out of range.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The device failed, or rejected a shader.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// The reason why options of the method are rejected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OptionsError {
    /// The method has no such option.
    #[error(
        "unknown option `{option}`; method `grid` takes `naive` or `scan`, `radius`, `exit`, \
         `aa=smooth`, `aa=none` or `aa=subpixel`, `samples=N`, `cells=N`"
    )]
    Unknown {
        /// The option as written.
        option: String,
    },
    /// An option repeats or contradicts an earlier one.
    #[error("`{text}`: `{option}` repeats or contradicts an earlier option; remove one of them")]
    Repeated {
        /// All options as written.
        text: String,
        /// The later one of the two options.
        option: String,
    },
    /// The value of an option is no whole number.
    #[error("invalid option `{option}`: the value must be a whole number")]
    NotANumber {
        /// The option as written.
        option: String,
    },
    /// The samples per segment are out of range.
    #[error("invalid option `samples={samples}`: the range is 2 to 64")]
    Samples {
        /// Samples per segment.
        samples: u32,
    },
    /// The cells per side are out of range.
    #[error("invalid option `cells={cells}`: the range is 1 to 1024")]
    Cells {
        /// Cells per side of the grid.
        cells: u32,
    },
    /// The naive prefix sum would take too long.
    #[error(
        "the naive prefix sum takes too long for {cells} x {cells} cells: add `scan`, or use at \
         most `cells={limit}`"
    )]
    TooManyNaiveCells {
        /// Cells per side of the grid.
        cells: u32,
        /// The most cells per side for the naive prefix sum.
        limit: u32,
    },
}
