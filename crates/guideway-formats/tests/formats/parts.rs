//! Tests of input that the caller reads in parts: the layouts and refusals of the whole bytes.

use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};

use guideway_formats::{Parts, ReadOptions, read_bytes, read_parts};
use guideway_layout::Layout;

use crate::law::compare;

/// Counts the bytes of the largest part.
struct Counted<'a> {
    bytes: &'a [u8],
    largest: AtomicUsize,
}

impl Parts for Counted<'_> {
    fn byte_count(&self) -> usize {
        self.bytes.len()
    }

    fn read(&self, from: usize, to: &mut [u8]) -> io::Result<()> {
        self.largest.fetch_max(to.len(), Ordering::Relaxed);
        self.bytes.read(from, to)
    }
}

/// The layout, or the refusal, and the bytes of the largest part.
fn read_counted(bytes: &[u8]) -> (Result<Layout, String>, usize) {
    let largest = AtomicUsize::new(0);
    let parts = Counted { bytes, largest };
    let read = read_parts("test", &parts, &ReadOptions::default());
    (read.map_err(|e| e.to_string()), parts.largest.into_inner())
}

fn read_whole(bytes: &[u8]) -> Result<Layout, String> {
    read_bytes("test", bytes, &ReadOptions::default()).map_err(|e| e.to_string())
}

#[test]
fn arrow_is_read_in_parts_and_text_whole() {
    let text = include_bytes!("../../../guideway/examples/site.lif.json");
    let site = read_whole(text).unwrap();
    let mut arrow = Vec::new();
    let options = guideway_formats::arrow::WriteOptions::default();
    guideway_formats::arrow::write_layout(&site, &mut arrow, &options).unwrap();
    for (bytes, is_whole) in [(&text[..], true), (&arrow, false)] {
        let (found, largest) = read_counted(bytes);
        let breaches = compare(&read_whole(bytes).unwrap(), &found.unwrap(), &[], 0.0);
        assert!(breaches.is_empty(), "{breaches:?}");
        assert_eq!(largest == bytes.len(), is_whole, "{largest} bytes");
    }
}

#[test]
fn refusals_are_those_of_the_whole_bytes() {
    for bytes in [&b""[..], b"?", b"{}", b"ARROW1\0\0", b"\x1f\x8b"] {
        let (found, _) = read_counted(bytes);
        let (found, expected) = (found.unwrap_err(), read_whole(bytes).unwrap_err());
        assert_eq!(found, expected, "{bytes:?}");
    }
}
