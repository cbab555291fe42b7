#![no_main]

libfuzzer_sys::fuzz_target!(
    // Panics of the Arrow library are caught by its reader. The fuzzer's own hook would end the run at them; without it
    // only a panic that is not caught does.
    init: drop(std::panic::take_hook()),
    |bytes: &[u8]| guideway_laws::read(bytes)
);
