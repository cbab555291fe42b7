use std::io::Read;

use flate2::read::GzDecoder;

use super::directory::{Directories, Entry};

fn gunzip(bytes: &[u8]) -> Vec<u8> {
    let mut all = Vec::new();
    GzDecoder::new(bytes).read_to_end(&mut all).unwrap();
    all
}

/// The entries of a directory, by the text of the specification.
fn decode(bytes: &[u8]) -> Vec<Entry> {
    let bytes = gunzip(bytes);
    let mut at = 0;
    let mut next = || {
        let (mut value, mut shift) = (0_u64, 0);
        loop {
            let byte = bytes[at];
            at += 1;
            value |= u64::from(byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 {
                return value;
            }
        }
    };
    let count = next() as usize;
    let mut column = || (0..count).map(|_| next()).collect::<Vec<u64>>();
    let [ids, runs, lengths, offsets] = [column(), column(), column(), column()];
    let mut all: Vec<Entry> = Vec::new();
    let mut id = 0;
    for i in 0..count {
        id += ids[i];
        let offset = match (offsets[i], all.last()) {
            (0, Some(last)) => last.offset + u64::from(last.length),
            (offset, _) => offset - 1,
        };
        all.push(Entry {
            id,
            run: runs[i] as u32,
            offset,
            length: lengths[i] as u32,
        });
    }
    all
}

fn entries(count: u64) -> Vec<Entry> {
    let entry = |i: u64| Entry {
        id: 3 * i + i * i % 5,
        run: 1 + (i % 2) as u32,
        offset: i * 7919 % 1_000_003,
        length: (i * 31 % 5000) as u32,
    };
    (0..count).map(entry).collect()
}

#[test]
fn a_small_directory_is_the_root_and_a_large_one_has_leaves() {
    let few = entries(100);
    let Directories { root, leaves } = Directories::new(&few);
    assert_eq!((decode(&root), leaves.len()), (few, 0));

    let many = entries(30_000);
    let Directories { root, leaves } = Directories::new(&many);
    assert!(root.len() <= 16_257);
    let mut found = Vec::new();
    for leaf in decode(&root) {
        assert_eq!(leaf.run, 0);
        let bytes = &leaves[leaf.offset as usize..][..leaf.length as usize];
        let of_leaf = decode(bytes);
        assert_eq!(of_leaf[0].id, leaf.id);
        found.extend(of_leaf);
    }
    assert_eq!(found, many);
}
