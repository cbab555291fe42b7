//! Flags of the engine of several threads, which the npm package alone has.
//!
//! JavaScript makes its memory, which all workers share, and so the module imports it.
//! `wasm-bindgen` gives each of them a stack, and variables of its own, by the symbols that the
//! linker exports here.

/// Flags of the C compiler.
pub(super) const C_FLAGS: &str = "-matomics -mbulk-memory";
const LINKER_ARGS: [&str; 8] = [
    "--shared-memory",
    "--import-memory",
    // Browsers reserve addresses for so much, and take memory as it is used.
    "--max-memory=4294967296",
    "--export=__wasm_init_tls",
    "--export=__tls_size",
    "--export=__tls_align",
    "--export=__tls_base",
    "--export=__heap_base",
];

/// Flags of the compiler.
pub(super) fn flags() -> String {
    let linker_args = LINKER_ARGS.map(|arg| format!(" -C link-arg={arg}"));
    format!(
        "-C target-feature=+simd128,+atomics,+bulk-memory{}",
        linker_args.concat()
    )
}
