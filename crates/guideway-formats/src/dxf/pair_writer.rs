//! Writes pairs of a group code and a value as ASCII DXF.

use std::io::{self, Write};

/// Handle of the block record that owns the entities of the model.
pub(super) const MODEL_SPACE: u64 = 0x1F;

/// Writes pairs to a stream, and numbers entities with handles.
pub(super) struct PairWriter<'w, W> {
    out: &'w mut W,
    next_handle: u64,
}

impl<'w, W: Write> PairWriter<'w, W> {
    pub(super) fn new(out: &'w mut W) -> Self {
        Self {
            out,
            next_handle: 0,
        }
    }

    /// Sets the handle of the next entity; later ones count up from it.
    pub(super) fn set_next_handle(&mut self, handle: u64) {
        self.next_handle = handle;
    }

    /// Writes a text, with control characters escaped as `\U+0000`, and carets as `^ `.
    pub(super) fn text(&mut self, code: u32, text: &str) -> io::Result<()> {
        writeln!(self.out, "{code}")?;
        let mut rest = text;
        while let Some(at) = rest.find(|c: char| c.is_control() || matches!(c, '\\' | '^')) {
            let (plain, special) = rest.split_at(at);
            let c = special.chars().next().unwrap_or_default();
            // A backslash is only special before `U+` or `M+`, so `C:\temp` stays readable.
            match c {
                '^' => write!(self.out, "{plain}^ ")?,
                '\\' if !special.starts_with(r"\U+") && !special.starts_with(r"\M+") => {
                    write!(self.out, "{plain}{c}")?;
                }
                _ => write!(self.out, r"{plain}\U+{:04X}", u32::from(c))?,
            }
            rest = &special[c.len_utf8()..];
        }
        writeln!(self.out, "{rest}")
    }

    /// Writes an integer.
    pub(super) fn int(&mut self, code: u32, value: u64) -> io::Result<()> {
        writeln!(self.out, "{code}\n{value}")
    }

    /// Writes a floating-point number.
    pub(super) fn real(&mut self, code: u32, value: f64) -> io::Result<()> {
        writeln!(self.out, "{code}\n{value}")
    }

    /// Writes a handle, in hexadecimal.
    pub(super) fn handle(&mut self, code: u32, handle: u64) -> io::Result<()> {
        writeln!(self.out, "{code}\n{handle:X}")
    }

    /// Writes a point: x with this code, y and z with the codes 10 and 20 above it.
    pub(super) fn point(&mut self, code: u32, [x, y]: [f64; 2], has_z: bool) -> io::Result<()> {
        self.real(code, x)?;
        self.real(code + 10, y)?;
        if has_z {
            self.real(code + 20, 0.0)
        } else {
            Ok(())
        }
    }

    /// Begins an entity in model space.
    pub(super) fn entity(&mut self, kind: &str, layer: &str) -> io::Result<()> {
        self.text(0, kind)?;
        self.handle(5, self.next_handle)?;
        self.next_handle += 1;
        self.handle(330, MODEL_SPACE)?;
        self.text(100, "AcDbEntity")?;
        self.text(8, layer)
    }
}
