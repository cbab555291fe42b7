//! Tokenizes a DXF file: ASCII or binary bytes in, pairs of a group code and a value out.
//!
//! Source: Autodesk's DXF reference, chapters "Group Code Value Types" and "Binary DXF Files".
//! Zero-copy: text values borrow from the file, and numbers are parsed on access.

use guideway_layout::Place;

use crate::Problem;
use crate::text::BYTE_ORDER_MARK;

/// The first bytes of a binary file.
pub(crate) const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// A group code with its value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<'b> {
    pub(crate) code: i32,
    pub(crate) value: Value<'b>,
    /// Line of the code, from 1; `None` in a binary file.
    pub(crate) line: Option<u32>,
}

/// A value as stored in the file; in an ASCII file every value is text.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Value<'b> {
    Text(&'b [u8]),
    Real(f64),
    Int(i64),
}

impl<'b> Pair<'b> {
    /// The text; empty for a binary number.
    pub(crate) fn text(&self) -> &'b [u8] {
        match self.value {
            Value::Text(text) => text,
            _ => b"",
        }
    }

    /// The value as a finite number.
    pub(crate) fn real(&self) -> Option<f64> {
        let real = match self.value {
            Value::Real(real) => real,
            Value::Int(int) => int as f64,
            Value::Text(text) => std::str::from_utf8(text.trim_ascii()).ok()?.parse().ok()?,
        };
        real.is_finite().then_some(real)
    }

    /// The value as an integer.
    pub(crate) fn int(&self) -> Option<i64> {
        match self.value {
            Value::Int(int) => Some(int),
            // Some writers append a decimal point to integers.
            _ => self.real().filter(|r| r.fract() == 0.0).map(|r| r as i64),
        }
    }
}

/// Reads pairs in sequence. A copy continues from the same offset.
#[derive(Clone, Copy)]
pub(crate) struct PairReader<'b> {
    bytes: &'b [u8],
    offset: usize,
    line: u32,
    encoding: Encoding,
    /// Blanks are around all values of an ASCII file, and are no part of them.
    is_padded: bool,
    /// Lines where a group code should be, but is none: their number, and the first of them.
    stray: Option<StrayLines>,
}

/// Lines of an ASCII file that are no part of a pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StrayLines {
    pub(crate) count: u32,
    pub(crate) first: u32,
}

/// Stray lines up to which a file is read. Beyond, it is no drawing.
const MAX_STRAY_LINES: u32 = 1_000;

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    /// Binary with group codes of one byte, up to release 12.
    BinaryR12,
    /// Binary with group codes of two bytes.
    Binary,
}

impl<'b> PairReader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        let (offset, encoding) = match bytes.strip_prefix(SENTINEL) {
            // The first pair is (0, SECTION) or (999, comment). With one-byte codes it begins with
            // the bytes 00 53 or FF.
            Some([255, ..] | [0, b'S', ..]) => (SENTINEL.len(), Encoding::BinaryR12),
            Some(_) => (SENTINEL.len(), Encoding::Binary),
            None if bytes.starts_with(BYTE_ORDER_MARK) => (BYTE_ORDER_MARK.len(), Encoding::Ascii),
            None => (0, Encoding::Ascii),
        };
        let reader = Self {
            bytes,
            offset,
            line: 1,
            encoding,
            is_padded: false,
            stray: None,
        };
        Self {
            is_padded: reader.has_padded_keyword(),
            ..reader
        }
    }

    /// Returns `true` if blanks are around the first keyword: in valid files none has any.
    fn has_padded_keyword(mut self) -> bool {
        while let Ok(Some(pair)) = self.next() {
            if pair.code != 999 {
                let text = pair.text();
                return pair.code == 0 && text.trim_ascii() != text;
            }
        }
        false
    }

    pub(crate) fn is_binary(&self) -> bool {
        self.encoding != Encoding::Ascii
    }

    /// Number of bytes read.
    pub(crate) fn position(&self) -> usize {
        self.offset
    }

    /// The stray lines so far.
    pub(crate) fn stray(&self) -> Option<StrayLines> {
        self.stray
    }

    /// The next pair; skips lines that are no group code, which a text with a line break leaves
    /// behind. `None` if the file ends before the pair does.
    ///
    /// # Errors
    /// When a group code is malformed or unknown.
    pub(crate) fn next(&mut self) -> Result<Option<Pair<'b>>, Problem> {
        let pair = match self.encoding {
            Encoding::Ascii => self.next_text(),
            _ => self.next_binary(),
        }?;
        if pair.is_none() {
            // The rest is a partial pair: another call must not read it as a whole one.
            self.offset = self.bytes.len();
        }
        Ok(pair)
    }

    fn next_text(&mut self) -> Result<Option<Pair<'b>>, Problem> {
        loop {
            let line = self.line;
            let Some(code) = self.text_line() else {
                return Ok(None);
            };
            if let Some(code) = group_code(code.trim_ascii()) {
                let text = self.text_line();
                return Ok(text.map(|text| Pair {
                    code,
                    value: Value::Text(match self.is_padded {
                        true => text.trim_ascii(),
                        false => text,
                    }),
                    line: Some(line),
                }));
            }
            if self.offset >= self.bytes.len() {
                return Ok(None);
            }
            let stray = self.stray.get_or_insert(StrayLines {
                count: 0,
                first: line,
            });
            stray.count += 1;
            if stray.count > MAX_STRAY_LINES {
                return Err(Problem::Syntax {
                    line: stray.first.into(),
                    column: 1,
                    message: "expected a group code, which is an integer".into(),
                });
            }
            if self.codes_ahead(1) > self.codes_ahead(0) {
                // The code itself is damaged: its value goes with it.
                self.text_line();
            }
        }
    }

    /// The number of group codes among the next pairs, if they begin after some lines.
    fn codes_ahead(mut self, lines: usize) -> usize {
        const PAIRS: usize = 8;
        for _ in 0..lines {
            self.text_line();
        }
        let mut next_is_code = || {
            let code = self.text_line()?;
            self.text_line();
            group_code(code.trim_ascii())
        };
        (0..PAIRS).filter_map(|_| next_is_code()).count()
    }

    /// The next line without its terminator.
    fn text_line(&mut self) -> Option<&'b [u8]> {
        let rest = self
            .bytes
            .get(self.offset..)
            .filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let length = length.unwrap_or(rest.len());
        let end = match rest[length..] {
            [b'\r', b'\n', ..] => 2,
            _ => 1,
        };
        self.offset += length + end;
        self.line = self.line.saturating_add(1);
        Some(&rest[..length])
    }

    fn next_binary(&mut self) -> Result<Option<Pair<'b>>, Problem> {
        let start = self.offset;
        let Some(code) = self.binary_code() else {
            return Ok(None);
        };
        let Some(kind) = ValueType::of(code) else {
            return Err(Problem::Damaged {
                place: Place::element(format!("byte {start}")),
                detail: format!("unknown group code {code}"),
            });
        };
        let value = match kind {
            ValueType::Text => self.until_nul().map(Value::Text),
            ValueType::Real => self.take().map(f64::from_le_bytes).map(Value::Real),
            ValueType::Byte => self.take().map(|[byte]: [u8; 1]| Value::Int(byte.into())),
            ValueType::Int16 => self
                .take()
                .map(i16::from_le_bytes)
                .map(|v| Value::Int(v.into())),
            ValueType::Int32 => self
                .take()
                .map(i32::from_le_bytes)
                .map(|v| Value::Int(v.into())),
            ValueType::Int64 => self.take().map(i64::from_le_bytes).map(Value::Int),
            ValueType::Bytes => self.take().and_then(|[length]: [u8; 1]| {
                let end = self.offset + usize::from(length);
                let chunk = self.bytes.get(self.offset..end)?;
                self.offset = end;
                Some(Value::Text(chunk))
            }),
        };
        Ok(value.map(|value| Pair {
            code,
            value,
            line: None,
        }))
    }

    fn binary_code(&mut self) -> Option<i32> {
        if self.encoding == Encoding::Binary {
            return self.take().map(i16::from_le_bytes).map(i32::from);
        }
        match self.take::<1>()? {
            [255] => self.take().map(i16::from_le_bytes).map(i32::from),
            [code] => Some(code.into()),
        }
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let bytes = self.bytes.get(self.offset..)?.first_chunk()?;
        self.offset += N;
        Some(*bytes)
    }

    fn until_nul(&mut self) -> Option<&'b [u8]> {
        let rest = self.bytes.get(self.offset..)?;
        let length = rest.iter().position(|&b| b == 0)?;
        self.offset += length + 1;
        Some(&rest[..length])
    }
}

/// Parses a group code: in valid files an optional sign and at most four digits.
fn group_code(line: &[u8]) -> Option<i32> {
    let (sign, digits) = match line {
        [b'-', digits @ ..] => (-1, digits),
        [b'+', digits @ ..] => (1, digits),
        digits => (1, digits),
    };
    if digits.is_empty() {
        return None;
    }
    let add = |number: i32, &byte: &u8| {
        let digit = byte.is_ascii_digit().then(|| i32::from(byte - b'0'))?;
        number.checked_mul(10)?.checked_add(digit)
    };
    digits.iter().try_fold(0, add).map(|number| sign * number)
}

/// The storage type of a value in a binary file.
enum ValueType {
    Text,
    Real,
    Byte,
    Int16,
    Int32,
    Int64,
    /// A chunk: a length of one byte, followed by that number of bytes.
    Bytes,
}

impl ValueType {
    /// The type for a group code; `None` for a code that the DXF reference does not list.
    fn of(code: i32) -> Option<Self> {
        Some(match code {
            0..=9 | 100..=109 | 300..=309 | 320..=369 | 390..=399 => Self::Text,
            410..=419 | 430..=439 | 470..=481 | 999 | 1000..=1003 | 1005..=1009 => Self::Text,
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Self::Real,
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Self::Int16,
            90..=99 | 420..=429 | 440..=459 | 1071 => Self::Int32,
            160..=169 => Self::Int64,
            290..=299 => Self::Byte,
            310..=319 | 1004 => Self::Bytes,
            _ => return None,
        })
    }
}
