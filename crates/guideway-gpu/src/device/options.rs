//! Artificial limits of a device.

/// Limits below those of the adapter: for tests, and to emulate a weaker device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Most bytes of a buffer that a shader may bind. `None`: the adapter's limit.
    pub storage_binding_bytes: Option<u32>,
    /// Most workgroups along one dimension of a dispatch. `None`: the adapter's limit.
    pub workgroups_per_dimension: Option<u32>,
    /// Most loop iterations per thread. `None`: as many as are safe.
    pub loops_per_thread: Option<u32>,
    /// Longest tile list that one workgroup covers where lists can be split. `None`: by its length.
    pub max_unsplit_list: Option<u32>,
    /// Checks every memory access of shaders at run time.
    pub checks_shaders: bool,
    /// Disables timestamp queries, as on a device without them.
    pub without_timestamps: bool,
    /// Disables subgroup operations, as on a device without them.
    pub without_subgroups: bool,
}

impl GpuOptions {
    /// The limits of chips that share the memory of the processor: bindings of 128 MiB, no
    /// timestamp queries, no subgroup operations. Kernels need at most the 256 threads and 32 KiB
    /// per workgroup that these chips have; a test looks at each.
    pub const INTEGRATED: Self = Self {
        storage_binding_bytes: Some(128 << 20),
        workgroups_per_dimension: Some(65_535),
        loops_per_thread: None,
        max_unsplit_list: None,
        checks_shaders: false,
        without_timestamps: true,
        without_subgroups: true,
    };
}
