//! A DXF file as pairs of a group code and a value, from text or from binary.
//!
//! Source: Autodesk's DXF reference, chapters "Group Code Value Types" and "Binary DXF Files". Nothing is
//! copied: values stay where they are in the file until somebody asks for a number.

use guideway_layout::Place;

use crate::Problem;

/// What a binary file begins with.
pub(super) const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// A group code with its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'b> {
    pub(super) code: i32,
    pub(super) value: Value<'b>,
    /// Line of the code, from 1; none in a binary file.
    pub(super) line: Option<u32>,
}

/// A value as the file has it: text files have nothing but text.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value<'b> {
    Text(&'b [u8]),
    Real(f64),
    Whole(i64),
}

impl<'b> Pair<'b> {
    pub(super) fn text(&self) -> &'b [u8] {
        match self.value {
            Value::Text(text) => text,
            _ => b"",
        }
    }

    pub(super) fn real(&self) -> Option<f64> {
        let real = match self.value {
            Value::Real(real) => real,
            Value::Whole(whole) => whole as f64,
            Value::Text(text) => std::str::from_utf8(text.trim_ascii()).ok()?.parse().ok()?,
        };
        real.is_finite().then_some(real)
    }

    pub(super) fn whole(&self) -> Option<i64> {
        match self.value {
            Value::Whole(whole) => Some(whole),
            // Some writers put a point into whole numbers.
            _ => self.real().filter(|r| r.fract() == 0.0).map(|r| r as i64),
        }
    }
}

/// Reads pairs one after the other. A copy goes on from the same place.
#[derive(Clone, Copy)]
pub(super) struct Pairs<'b> {
    bytes: &'b [u8],
    at: usize,
    line: u32,
    form: Form,
}

#[derive(Clone, Copy, PartialEq)]
enum Form {
    Text,
    /// Codes of one byte, up to release 12.
    Narrow,
    /// Codes of two bytes.
    Wide,
}

impl<'b> Pairs<'b> {
    pub(super) fn new(bytes: &'b [u8]) -> Self {
        let (at, form) = match bytes.strip_prefix(SENTINEL) {
            // The first pair is 0, SECTION or 999, a comment: 00 and 53 or FF if codes have one byte.
            Some([255, ..] | [0, b'S', ..]) => (SENTINEL.len(), Form::Narrow),
            Some(_) => (SENTINEL.len(), Form::Wide),
            None => (
                if bytes.starts_with(b"\xEF\xBB\xBF") {
                    3
                } else {
                    0
                },
                Form::Text,
            ),
        };
        Self {
            bytes,
            at,
            line: 1,
            form,
        }
    }

    pub(super) fn is_binary(&self) -> bool {
        self.form != Form::Text
    }

    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// The next pair; none where the bytes end before a pair does.
    pub(super) fn next(&mut self) -> Result<Option<Pair<'b>>, Problem> {
        let pair = match self.form {
            Form::Text => self.next_text(),
            _ => self.next_binary(),
        }?;
        if pair.is_none() {
            // What is left is part of a pair, and must not be taken for the next one.
            self.at = self.bytes.len();
        }
        Ok(pair)
    }

    fn next_text(&mut self) -> Result<Option<Pair<'b>>, Problem> {
        let line = self.line;
        let Some(code) = self.text_line() else {
            return Ok(None);
        };
        let Some(code) = group_code(code.trim_ascii()) else {
            if self.at >= self.bytes.len() {
                return Ok(None);
            }
            return Err(Problem::Syntax {
                line: line.into(),
                column: 1,
                message: "a group code was expected, which is a whole number".into(),
            });
        };
        Ok(self.text_line().map(|text| Pair {
            code,
            value: Value::Text(text),
            line: Some(line),
        }))
    }

    /// A line without its end, if there is one.
    fn text_line(&mut self) -> Option<&'b [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let length = length.unwrap_or(rest.len());
        let end = match rest[length..] {
            [b'\r', b'\n', ..] => 2,
            _ => 1,
        };
        self.at += length + end;
        self.line = self.line.saturating_add(1);
        Some(&rest[..length])
    }

    fn next_binary(&mut self) -> Result<Option<Pair<'b>>, Problem> {
        let start = self.at;
        let Some(code) = self.binary_code() else {
            return Ok(None);
        };
        let Some(kind) = Kind::of(code) else {
            return Err(Problem::Damaged {
                place: Place::element(format!("byte {start}")),
                detail: format!("there is no group code {code}"),
            });
        };
        let value = match kind {
            Kind::Text => self.until_nul().map(Value::Text),
            Kind::Real => self.take().map(f64::from_le_bytes).map(Value::Real),
            Kind::Byte => self.take().map(|[byte]: [u8; 1]| Value::Whole(byte.into())),
            Kind::Int16 => self
                .take()
                .map(i16::from_le_bytes)
                .map(|v| Value::Whole(v.into())),
            Kind::Int32 => self
                .take()
                .map(i32::from_le_bytes)
                .map(|v| Value::Whole(v.into())),
            Kind::Int64 => self.take().map(i64::from_le_bytes).map(Value::Whole),
            Kind::Bytes => self.take().and_then(|[length]: [u8; 1]| {
                let chunk = self.bytes.get(self.at..self.at + usize::from(length))?;
                self.at += chunk.len();
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
        if self.form == Form::Wide {
            return self.take().map(i16::from_le_bytes).map(i32::from);
        }
        match self.take::<1>()? {
            [255] => self.take().map(i16::from_le_bytes).map(i32::from),
            [code] => Some(code.into()),
        }
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let bytes = self.bytes.get(self.at..)?.first_chunk()?;
        self.at += N;
        Some(*bytes)
    }

    fn until_nul(&mut self) -> Option<&'b [u8]> {
        let rest = self.bytes.get(self.at..)?;
        let length = rest.iter().position(|&b| b == 0)?;
        self.at += length + 1;
        Some(&rest[..length])
    }
}

/// The number that a line is: at most four digits in sound files, and a sign.
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

/// How the value of a group code is stored in a binary file.
enum Kind {
    Text,
    Real,
    Byte,
    Int16,
    Int32,
    Int64,
    /// A length in one byte, and so many bytes.
    Bytes,
}

impl Kind {
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
