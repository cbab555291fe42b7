//! Directories: the entries of tiles by number, as differences, compressed by gzip.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;

/// Bytes of the header of an archive.
pub(super) const HEADER_BYTES: usize = 127;
/// Most bytes of the root directory: it and the header are in the first 16 KiB of a file.
const MAX_ROOT_BYTES: usize = (16 << 10) - HEADER_BYTES;
/// Entries of a leaf directory at first; twice as many until the root is small enough.
const LEAF_ENTRIES: usize = 4096;

/// Some consecutive tiles of the same content or, with a run of 0, a leaf directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    /// Number of the first tile.
    pub(super) id: u64,
    /// Tiles with this content.
    pub(super) run: u32,
    pub(super) offset: u64,
    pub(super) length: u32,
}

/// The directories of an archive.
pub(super) struct Directories {
    pub(super) root: Vec<u8>,
    /// All leaf directories; empty if the root has all entries.
    pub(super) leaves: Vec<u8>,
}

impl Directories {
    /// Encodes the entries, which are in the order of their numbers.
    pub(super) fn new(entries: &[Entry]) -> Self {
        let root = encode(entries);
        if root.len() <= MAX_ROOT_BYTES {
            return Self {
                root,
                leaves: Vec::new(),
            };
        }
        let mut of_leaf = LEAF_ENTRIES;
        loop {
            let mut leaves = Vec::new();
            let leaf = |entries: &[Entry]| {
                let bytes = encode(entries);
                let entry = Entry {
                    id: entries[0].id,
                    run: 0,
                    offset: leaves.len() as u64,
                    length: bytes.len() as u32,
                };
                leaves.extend_from_slice(&bytes);
                entry
            };
            let of_root: Vec<Entry> = entries.chunks(of_leaf).map(leaf).collect();
            let root = encode(&of_root);
            if root.len() <= MAX_ROOT_BYTES {
                return Self { root, leaves };
            }
            of_leaf *= 2;
        }
    }
}

fn encode(entries: &[Entry]) -> Vec<u8> {
    let mut bytes = Vec::new();
    varint(&mut bytes, entries.len() as u64);
    let mut last_id = 0;
    for entry in entries {
        varint(&mut bytes, entry.id - last_id);
        last_id = entry.id;
    }
    entries
        .iter()
        .for_each(|entry| varint(&mut bytes, entry.run.into()));
    entries
        .iter()
        .for_each(|entry| varint(&mut bytes, entry.length.into()));
    // 0 stands for an entry that begins where the one before ends.
    let mut next = None;
    for entry in entries {
        let is_next = next == Some(entry.offset);
        varint(&mut bytes, if is_next { 0 } else { entry.offset + 1 });
        next = Some(entry.offset + u64::from(entry.length));
    }
    gzip(&bytes)
}

/// Compresses by gzip, slowly and well.
pub(super) fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    written.expect("a vector takes all bytes")
}

fn varint(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}
