//! Writes XML elements with their attributes, indented by four spaces per level.

use std::fmt::Display;
use std::io::{self, Write};

use crate::xml_text::{escape, is_xml_char};

/// A file under construction.
pub(super) struct XmlWriter<'w, W> {
    out: &'w mut W,
    /// Tags of the open elements, and whether each has child elements.
    open: Vec<(&'static str, bool)>,
    /// Number of values with characters that XML forbids, which are replaced by `_`.
    pub(super) replaced: usize,
}

impl<'w, W: Write> XmlWriter<'w, W> {
    /// Starts a file.
    ///
    /// # Errors
    /// When the output fails, as in the other functions.
    pub(super) fn begin_file(out: &'w mut W) -> io::Result<Self> {
        write!(
            out,
            r#"<?xml version="1.0" encoding="UTF-8" standalone="yes"?>"#
        )?;
        Ok(Self {
            out,
            open: Vec::new(),
            replaced: 0,
        })
    }

    /// Starts an element.
    pub(super) fn begin(&mut self, tag: &'static str) -> io::Result<()> {
        if let Some((_, has_children)) = self.open.last_mut()
            && !std::mem::replace(has_children, true)
        {
            write!(self.out, ">")?;
        }
        self.indent()?;
        self.open.push((tag, false));
        write!(self.out, "<{tag}")
    }

    /// Adds an attribute to the element that was just started.
    pub(super) fn attribute(&mut self, name: &str, value: impl Display) -> io::Result<()> {
        let text = value.to_string();
        self.replaced += usize::from(!text.chars().all(is_xml_char));
        write!(self.out, r#" {name}="{}""#, escape(&text))
    }

    /// Ends the element that was started last.
    pub(super) fn end(&mut self) -> io::Result<()> {
        match self.open.pop() {
            Some((tag, true)) => {
                self.indent()?;
                write!(self.out, "</{tag}>")
            }
            Some((_, false)) => write!(self.out, "/>"),
            None => Ok(()),
        }
    }

    /// Writes an element without children.
    pub(super) fn element(
        &mut self,
        tag: &'static str,
        attributes: &[(&str, &dyn Display)],
    ) -> io::Result<()> {
        self.begin(tag)?;
        for (name, value) in attributes {
            self.attribute(name, value)?;
        }
        self.end()
    }

    /// Ends the file. Returns the number of values with replaced characters.
    pub(super) fn finish(self) -> io::Result<usize> {
        writeln!(self.out)?;
        Ok(self.replaced)
    }

    fn indent(&mut self) -> io::Result<()> {
        write!(self.out, "\n{:width$}", "", width = 4 * self.open.len())
    }
}
