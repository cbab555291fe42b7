//! [`Skeleton`]: a JSON text without the items of its long arrays. One pass over the input finds
//! them, checks the limits and counts lines, so that the text need not be in memory.
//!
//! ```text
//! input      {"layouts": [{"nodes": [{...}, {...}, {...}], "name": "ground"}]}
//! skeleton   {"layouts": [{"nodes": [], "name": "ground"}]}
//! ```

use guideway_layout::{Limits, TextPosition};

use super::limits::STEPS;
use super::scan::{offset_in, unescaped};
use crate::input::Input;
use crate::source::Source;
use crate::text::BYTE_ORDER_MARK;
use crate::{Problem, ReadError};

/// Bytes of the input that are read at once.
const BLOCK_BYTES: usize = 4 << 20;

/// Bytes from which on a part of an array ends, at the next comma between items. A thread parses a
/// part at once.
const PART_BYTES: usize = 64 << 10;

/// Returns `true` if the array below these keys is long. An array counts as the key `[]`.
pub(crate) type IsLong = fn(&[&str]) -> bool;

/// A text without the items of its long arrays.
pub(crate) struct Skeleton {
    pub(crate) text: String,
    arrays: Vec<LongArray>,
}

/// The items of an array in the input.
pub(crate) struct LongArray {
    /// Byte of its opening bracket in the skeleton.
    at: usize,
    /// First bytes of its parts, and the byte of its closing bracket. A part ends behind a comma,
    /// the last one before the bracket.
    pub(crate) borders: Vec<usize>,
    /// Place of its first part.
    pub(crate) first: TextPosition,
    /// Place behind its closing bracket.
    behind: TextPosition,
}

impl Skeleton {
    /// Scans an input; `None` if it exceeds a limit or is no JSON text as far as the scan tells.
    ///
    /// # Errors
    /// When the input cannot be read, or the caller cancels the read.
    pub(crate) fn scan(
        source: &Source<'_>,
        input: &Input<'_>,
        is_long: IsLong,
    ) -> Result<Option<Self>, ReadError> {
        let fail = |problem: Problem| source.fail(problem);
        let mut scan = Scan::new(&source.options.limits, is_long);
        let mut buffer = Vec::new();
        let mut from = 0;
        while from < input.len() {
            source.check_cancelled()?;
            let end = input.len().min(from + BLOCK_BYTES);
            let block = input.part(from..end, &mut buffer).map_err(fail)?;
            let mark = match block.starts_with(BYTE_ORDER_MARK) && from == 0 {
                true => BYTE_ORDER_MARK.len(),
                false => 0,
            };
            if !scan.block(&block[mark..], from + mark) {
                return Ok(None);
            }
            from = end;
        }
        Ok(scan.finish())
    }

    /// The items of a long array, by its part of the text; `None` for another part.
    pub(crate) fn array(&self, part: &str) -> Option<&LongArray> {
        let at = offset_in(&self.text, part)?;
        let found = self.arrays.binary_search_by_key(&at, |array| array.at);
        self.arrays.get(found.ok()?)
    }

    /// The place in the input of a byte of the text.
    pub(crate) fn position(&self, at: usize) -> TextPosition {
        let before = self.arrays.partition_point(|array| array.at < at);
        let (from, start) = match self.arrays[..before].last() {
            Some(array) => (array.at + "[]".len(), array.behind),
            None => (0, TextPosition::FIRST),
        };
        let between = self.text.as_bytes().get(from..at);
        start.after(between.unwrap_or_default())
    }
}

/// A scan in progress.
struct Scan<'l> {
    limits: &'l Limits,
    is_long: IsLong,
    text: Vec<u8>,
    arrays: Vec<LongArray>,
    /// Key of the current member of each open object, `[]` for each open array.
    keys: Vec<String>,
    /// The last string outside of long arrays: its first byte in the text, and that of its quote.
    string: [usize; 2],
    in_string: bool,
    /// True behind a backslash of a string.
    is_escaped: bool,
    /// Open brackets within the long array that is scanned, its own included; 0 outside.
    depth: usize,
    max_depth: usize,
    elements: u64,
    /// Byte of the input from which on the next part may begin.
    next_border: usize,
    position: TextPosition,
}

/// The reason why the scan of the items of an array stops.
#[derive(Clone, Copy, PartialEq)]
enum Stop {
    BlockEnd,
    Border,
    ArrayEnd,
}

impl<'l> Scan<'l> {
    fn new(limits: &'l Limits, is_long: IsLong) -> Self {
        Self {
            limits,
            is_long,
            text: Vec::new(),
            arrays: Vec::new(),
            keys: Vec::new(),
            string: [0; 2],
            in_string: false,
            is_escaped: false,
            depth: 0,
            max_depth: 0,
            elements: 0,
            next_border: 0,
            position: TextPosition::FIRST,
        }
    }

    /// Scans a block, whose first byte is `from` in the input. Returns `false` if it is not valid.
    fn block(&mut self, block: &[u8], from: usize) -> bool {
        let (mut at, mut counted) = (0, 0);
        let mut count_to = |scan: &mut Self, end: usize| {
            scan.position = scan.position.after(&block[counted..end]);
            counted = end;
        };
        while at < block.len() {
            let rest = &block[at..];
            if self.depth > 0 {
                let (length, stop) = self.items(rest, from + at);
                at += length;
                let byte = from + at;
                match stop {
                    Stop::BlockEnd => {}
                    Stop::Border => self.add_border(byte),
                    Stop::ArrayEnd => {
                        count_to(self, at);
                        // As it is, valid or not.
                        self.text.push(block[at - 1]);
                        self.add_border(byte - 1);
                        let behind = self.position;
                        self.arrays
                            .last_mut()
                            .into_iter()
                            .for_each(|a| a.behind = behind);
                    }
                }
            } else if self.in_string {
                let length = self.string(rest);
                self.text.extend_from_slice(&rest[..length]);
                self.string[1] = self.text.len() - 1;
                at += length;
            } else {
                at += 1;
                if !self.frame(rest[0]) {
                    return false;
                }
                if self.depth > 0 {
                    count_to(self, at);
                    self.arrays.push(LongArray {
                        at: self.text.len() - 1,
                        borders: Vec::new(),
                        first: self.position,
                        behind: self.position,
                    });
                    self.add_border(from + at);
                }
            }
        }
        count_to(self, block.len());
        self.max_depth <= self.limits.depth && self.elements <= self.limits.elements
    }

    fn add_border(&mut self, byte: usize) {
        self.next_border = byte + PART_BYTES;
        let array = self.arrays.last_mut().into_iter();
        array.for_each(|array| array.borders.push(byte));
    }

    /// Scans a byte outside of long arrays and strings. Returns `false` if it is not valid.
    fn frame(&mut self, byte: u8) -> bool {
        self.text.push(byte);
        self.elements += u64::from(STEPS[usize::from(byte)].1);
        match byte {
            b'"' => {
                self.in_string = true;
                self.string = [self.text.len(); 2];
            }
            b':' => {
                let key = std::str::from_utf8(&self.text[self.string[0]..self.string[1]]);
                let (Ok(key), Some(current)) = (key, self.keys.last_mut()) else {
                    return false;
                };
                *current = match key.contains('\\') {
                    true => unescaped(&format!("\"{key}\"")),
                    false => key.to_owned(),
                };
            }
            b'[' if self.is_at_long_array() => {
                self.depth = 1;
                self.max_depth = self.max_depth.max(self.keys.len() + 1);
            }
            b'{' => self.keys.push(String::new()),
            b'[' => self.keys.push("[]".to_owned()),
            b'}' | b']' => return self.keys.pop().is_some(),
            _ => {}
        }
        self.keys.len() <= self.limits.depth
    }

    fn is_at_long_array(&self) -> bool {
        let keys: Vec<&str> = self.keys.iter().map(String::as_str).collect();
        (self.is_long)(&keys)
    }

    /// Scans items of a long array; the first byte is `from` in the input. Returns the number of
    /// scanned bytes.
    fn items(&mut self, bytes: &[u8], from: usize) -> (usize, Stop) {
        // Locals stay in registers: this visits every byte of a large file.
        let (mut depth, mut max_depth, mut elements) = (self.depth, 0, 0);
        let border = self.next_border.saturating_sub(from);
        let (mut at, mut stop) = (0, Stop::BlockEnd);
        while at < bytes.len() && stop == Stop::BlockEnd {
            if self.in_string {
                at += self.string(&bytes[at..]);
                continue;
            }
            for &byte in &bytes[at..] {
                at += 1;
                if byte == b'"' {
                    self.in_string = true;
                    break;
                }
                let (deeper, begun) = STEPS[usize::from(byte)];
                depth = depth.wrapping_add_signed(isize::from(deeper));
                max_depth = max_depth.max(depth);
                elements += u64::from(begun);
                if depth == 0 {
                    stop = Stop::ArrayEnd;
                    break;
                }
                if at >= border && depth == 1 && byte == b',' {
                    stop = Stop::Border;
                    break;
                }
            }
        }
        self.depth = depth;
        self.max_depth = self.max_depth.max(self.keys.len() + max_depth);
        self.elements += elements;
        (at, stop)
    }

    /// Scans a string to its quote, to a backslash, or to the end of `bytes`. Returns the number of
    /// scanned bytes.
    fn string(&mut self, bytes: &[u8]) -> usize {
        if std::mem::take(&mut self.is_escaped) {
            return 1;
        }
        let end = bytes.iter().position(|byte| matches!(byte, b'"' | b'\\'));
        let Some(end) = end else {
            return bytes.len();
        };
        self.is_escaped = bytes[end] == b'\\';
        self.in_string = self.is_escaped;
        end + 1
    }

    /// The skeleton; `None` if the text ends within an array.
    fn finish(self) -> Option<Skeleton> {
        let text = String::from_utf8(self.text).ok()?;
        (self.depth == 0).then_some(Skeleton {
            text,
            arrays: self.arrays,
        })
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::Limits;

    use super::*;
    use crate::ReadOptions;

    fn is_long(keys: &[&str]) -> bool {
        matches!(keys, ["l", "[]", "nodes"])
    }

    fn scan(text: &str, limits: Limits) -> Option<Skeleton> {
        let options = ReadOptions {
            limits,
            ..ReadOptions::default()
        };
        let source = Source {
            name: "test",
            options: &options,
        };
        Skeleton::scan(&source, &Input::Bytes(text.as_bytes()), is_long).unwrap()
    }

    #[test]
    fn long_arrays_are_left_out() {
        let text = "{\"l\":[{\"no\\u0064es\":[[1,\n\"]\\\"\"],{}],\n\"nodes\":3, \"x\":\"nodes\"}],\
                    \"nodes\":[1]}";
        let found = scan(text, Limits::default()).unwrap();
        let (before, after) = (
            "{\"l\":[{\"no\\u0064es\":[",
            "],\n\"nodes\":3, \"x\":\"nodes\"}],",
        );
        assert_eq!(found.text, format!("{before}{after}\"nodes\":[1]}}"));
        let [array] = &found.arrays[..] else {
            panic!("{} arrays", found.arrays.len());
        };
        let parts = [before.len(), text.find("],\n\"nodes\"").unwrap()];
        assert_eq!(array.borders, parts);
        let place = |at: usize| (found.position(at).line, found.position(at).column);
        assert_eq!(place(3), (1, 4));
        // Behind the array, which has a line break, is the third line.
        assert_eq!(place(found.text.find("3,").unwrap()), (3, 9));
    }

    #[test]
    fn parts_end_at_commas_between_items() {
        let item = format!("[\"{}\", 1]", "x".repeat(1000));
        let items = vec![item; 200].join(",\n");
        let text = format!("{{\"l\":[{{\"nodes\":[{items}]}}]}}");
        let found = scan(&text, Limits::default()).unwrap();
        let borders = &found.arrays[0].borders;
        assert!(borders.len() > 3, "{borders:?}");
        for &border in &borders[1..borders.len() - 1] {
            assert_eq!(&text[border - 2..border + 2], "],\n[");
        }
    }

    #[test]
    fn limits_hold_within_long_arrays() {
        let text = r#"{"l":[{"nodes":[1,{"a":[2]}]}]}"#;
        for (depth, elements, is_within) in [(6, 7, true), (5, 7, false), (6, 6, false)] {
            let limits = Limits {
                depth,
                elements,
                ..Limits::default()
            };
            assert_eq!(
                scan(text, limits).is_some(),
                is_within,
                "{depth} {elements}"
            );
        }
        for text in ["]", "}{", r#"{"l":[{"nodes":[1"#, "{\"l\":[{\"nodes\":[\""] {
            assert!(scan(text, Limits::default()).is_none(), "{text}");
        }
    }
}
