//! Runs the law of reading over the seeds of Arrow files and 500 mutants of them. `cargo xtask
//! sanitize` builds this test alone.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod mutate;

use guideway_laws::ARROW;
use mutate::{assert_law_holds, counterexample};

#[test]
fn arrow() {
    assert_law_holds(&ARROW);
}

#[test]
fn finds_a_counterexample() {
    let seeds = [b"[1, 2, 3]".to_vec(), b"{\"x\": 4}".to_vec()];
    let law = |bytes: &[u8]| assert!(!bytes.starts_with(b"[") || bytes.contains(&b'2'));
    assert!(counterexample(law, &seeds).is_some());
    assert!(counterexample(|_| {}, &seeds).is_none());
}
