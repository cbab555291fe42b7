#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| guideway_laws::read(bytes));
