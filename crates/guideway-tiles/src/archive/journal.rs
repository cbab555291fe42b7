//! [`Journal`]: the finished tiles of a run, on disk block by block, so that a stopped run goes on.

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

use super::directory::Entry;
use crate::{Tile, TileError};

/// First bytes of a journal.
const MAGIC: &[u8; 8] = b"GWTILES2";
/// Bytes before the first block.
const START: u64 = 16;
/// Numbers of 64 bits before the entries of a block: check sum, zoom, next tile, omitted paths,
/// bits of the greatest count plus one, entries, bytes of tiles.
const FIELDS: usize = 7;
/// Bytes of an entry: number, offset, length, and the hash of the content in two halves.
const ENTRY_BYTES: usize = 8 * 5;
/// Most entries of a block: a journal that claims more is damaged.
const MAX_ENTRIES: u64 = 1 << 16;

/// Counts of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BlockCounts {
    /// Paths that its tiles leave out.
    pub(crate) omitted: u64,
    /// The number of paths per pixel with the last color of its zoom.
    pub(crate) max_count: Option<f32>,
}

/// The tiles of a zoom.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ZoomCounts {
    pub(super) tiles: u64,
    pub(super) omitted: u64,
    pub(super) max_count: Option<f32>,
}

/// The finished tiles of a run. Each is written once, with the first tile of its content.
pub struct Journal {
    file: File,
    /// Offset of the next block.
    end: u64,
    /// Number of the first tile that is not done.
    next_id: u64,
    pub(super) entries: Vec<Entry>,
    /// Place of each content.
    places: HashMap<[u64; 2], (u64, u32)>,
    pub(super) zooms: BTreeMap<u8, ZoomCounts>,
    continued: u64,
}

impl Journal {
    /// Opens a journal for reading and writing. Keeps the blocks in it if they are of a run of the
    /// same key, and begins anew otherwise. A block whose end is missing counts as not done.
    ///
    /// # Errors
    /// When the file cannot be read or written.
    pub fn open(file: File, key: u64) -> Result<Self, TileError> {
        let mut journal = Self {
            file,
            end: START,
            next_id: 0,
            entries: Vec::new(),
            places: HashMap::new(),
            zooms: BTreeMap::new(),
            continued: 0,
        };
        let mut start = [0; START as usize];
        let length = journal.file.metadata()?.len();
        let mut reader = BufReader::with_capacity(1 << 20, &journal.file);
        let expected = [&MAGIC[..], &key.to_le_bytes()].concat();
        let is_known = reader.read_exact(&mut start).is_ok() && start[..] == expected[..];
        let mut blocks = Vec::new();
        let mut left = length.saturating_sub(START);
        while is_known && let Some(block) = Block::read(&mut reader, left)? {
            left -= block.bytes();
            blocks.push(block);
        }
        drop(reader);
        for block in blocks {
            journal.end += block.bytes();
            journal.add(&block);
        }
        journal.continued = journal.entries.len() as u64;
        journal
            .file
            .set_len(if is_known { journal.end } else { 0 })?;
        journal.file.rewind()?;
        journal.file.write_all(&expected)?;
        journal.file.seek(SeekFrom::Start(journal.end))?;
        Ok(journal)
    }

    /// Number of tiles that were in the journal when it was opened.
    pub fn continued(&self) -> u64 {
        self.continued
    }

    /// Number of tiles.
    pub fn len(&self) -> u64 {
        self.entries.len() as u64
    }

    /// Returns `true` if there are no tiles.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Number of the first tile that is not done.
    pub(crate) fn next_id(&self) -> u64 {
        self.next_id
    }

    /// Appends the tiles of a block of a zoom, which come after all others and before the tile
    /// behind `last_id`.
    ///
    /// # Errors
    /// When the disk fails or is full; the journal is then to be opened again.
    pub(crate) fn push(
        &mut self,
        (zoom, last_id): (u8, u64),
        counts: BlockCounts,
        tiles: Vec<(Tile, Vec<u8>)>,
    ) -> Result<(), TileError> {
        let mut block = Block {
            zoom,
            next_id: last_id + 1,
            counts,
            entries: Vec::with_capacity(tiles.len()),
            data: Vec::new(),
            data_bytes: 0,
        };
        let data_at = self.end + Block::head_bytes(tiles.len());
        let mut new = HashMap::new();
        for (tile, content) in tiles {
            let hash = hash(&content);
            let known = self.places.get(&hash).or_else(|| new.get(&hash)).copied();
            let (offset, length) = known.unwrap_or_else(|| {
                let place = (data_at + block.data.len() as u64, content.len() as u32);
                new.insert(hash, place);
                block.data.extend_from_slice(&content);
                place
            });
            let entry = Entry {
                id: tile.id(),
                run: 1,
                offset,
                length,
            };
            block.entries.push((entry, hash));
        }
        block.data_bytes = block.data.len() as u64;
        let head = block.head();
        self.file
            .write_all(&check(&head, &block.data).to_le_bytes())?;
        self.file.write_all(&head)?;
        self.file.write_all(&block.data)?;
        self.end += block.bytes();
        self.add(&block);
        Ok(())
    }

    fn add(&mut self, block: &Block) {
        self.next_id = block.next_id;
        let zoom = self.zooms.entry(block.zoom).or_default();
        zoom.tiles += block.entries.len() as u64;
        zoom.omitted += block.counts.omitted;
        zoom.max_count = zoom.max_count.or(block.counts.max_count);
        for (entry, hash) in &block.entries {
            self.entries.push(*entry);
            self.places
                .entry(*hash)
                .or_insert((entry.offset, entry.length));
        }
    }

    /// The content at a place of the journal.
    pub(super) fn copy(
        &self,
        places: impl Iterator<Item = (u64, u32)>,
        out: &mut impl Write,
    ) -> io::Result<()> {
        let mut reader = BufReader::with_capacity(1 << 20, &self.file);
        let mut at = 0;
        reader.rewind()?;
        for (offset, length) in places {
            reader.seek_relative(offset as i64 - at)?;
            io::copy(&mut reader.by_ref().take(length.into()), out)?;
            at = (offset + u64::from(length)) as i64;
        }
        Ok(())
    }
}

/// A block of tiles as it is in the journal.
struct Block {
    zoom: u8,
    next_id: u64,
    counts: BlockCounts,
    entries: Vec<(Entry, [u64; 2])>,
    /// Contents that were new; not kept of a block that was read.
    data: Vec<u8>,
    data_bytes: u64,
}

impl Block {
    fn head_bytes(entries: usize) -> u64 {
        (8 * FIELDS + ENTRY_BYTES * entries) as u64
    }

    fn bytes(&self) -> u64 {
        Self::head_bytes(self.entries.len()) + self.data_bytes
    }

    /// All before the contents, without the check sum.
    fn head(&self) -> Vec<u8> {
        let max_count = self.counts.max_count;
        let mut numbers = vec![
            u64::from(self.zoom),
            self.next_id,
            self.counts.omitted,
            max_count.map_or(0, |count| u64::from(count.to_bits()) + 1),
            self.entries.len() as u64,
            self.data_bytes,
        ];
        for (entry, hash) in &self.entries {
            numbers.extend([
                entry.id,
                entry.offset,
                entry.length.into(),
                hash[0],
                hash[1],
            ]);
        }
        numbers.into_iter().flat_map(u64::to_le_bytes).collect()
    }

    /// Reads the next block, of a file with some bytes left; `None` behind the last whole one.
    fn read(reader: &mut impl Read, left: u64) -> io::Result<Option<Self>> {
        let mut head = [0; 8 * FIELDS];
        if !read_whole(reader, &mut head)? {
            return Ok(None);
        }
        let number = |bytes: &[u8], at: usize| {
            let (all, _) = bytes.as_chunks::<8>();
            u64::from_le_bytes(all[at])
        };
        let [sum, zoom, next_id, omitted, max_count, entries, data] =
            [0, 1, 2, 3, 4, 5, 6].map(|at| number(&head, at));
        let needed = Self::head_bytes(entries.min(MAX_ENTRIES) as usize).saturating_add(data);
        if entries > MAX_ENTRIES || needed > left {
            return Ok(None);
        }
        let mut bytes = head[8..].to_vec();
        let entry_bytes = ENTRY_BYTES * entries as usize;
        bytes.resize(head.len() - 8 + entry_bytes + data as usize, 0);
        if !read_whole(reader, &mut bytes[head.len() - 8..])? {
            return Ok(None);
        }
        let (numbers, contents) = bytes.split_at(head.len() - 8 + entry_bytes);
        if check(numbers, contents) != sum {
            return Ok(None);
        }
        let entries = bytes[head.len() - 8..][..entry_bytes].chunks(ENTRY_BYTES);
        let entries = entries.map(|bytes| {
            let [id, offset, length, first, second] = [0, 1, 2, 3, 4].map(|at| number(bytes, at));
            let entry = Entry {
                id,
                run: 1,
                offset,
                length: length as u32,
            };
            (entry, [first, second])
        });
        Ok(Some(Self {
            zoom: zoom as u8,
            next_id,
            counts: BlockCounts {
                omitted,
                max_count: max_count
                    .checked_sub(1)
                    .map(|bits| f32::from_bits(bits as u32)),
            },
            entries: entries.collect(),
            data: Vec::new(),
            data_bytes: data,
        }))
    }
}

/// Fills a buffer; returns `false` if the file ends before.
fn read_whole(reader: &mut impl Read, buffer: &mut [u8]) -> io::Result<bool> {
    match reader.read_exact(buffer) {
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(false),
        read => read.map(|()| true),
    }
}

/// Hash of a content: 128 bits, so that equal hashes are equal contents.
fn hash(content: &[u8]) -> [u64; 2] {
    [0_u8, 1].map(|half| {
        let mut hasher = DefaultHasher::new();
        (half, content).hash(&mut hasher);
        hasher.finish()
    })
}

/// Check sum of a block: of its numbers and its contents.
fn check(numbers: &[u8], contents: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    (numbers, contents).hash(&mut hasher);
    hasher.finish()
}
