#![no_main]

libfuzzer_sys::fuzz_target!(
    // The Arrow reader catches panics of the Arrow library. The panic hook of the fuzzer would
    // abort at them, so it is removed: only an uncaught panic ends the run.
    init: drop(std::panic::take_hook()),
    |bytes: &[u8]| guideway_laws::convert(bytes)
);
