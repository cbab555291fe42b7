//! Tokenizes the prolog of an XML text and its document type definition: bytes in, place of the
//! root, entities and default attributes out.
//!
//! ```text
//! <?xml ...?> <!-- ... --> <!DOCTYPE svg PUBLIC "..." "..." [ declarations ]> <svg ...
//! ```
//!
//! Quoted values, comments and instructions within a definition may contain `]>`, so its end is
//! known only by its grammar. Source: XML 1.0, sections 2.8, 3.3 and 4.2.

use std::collections::HashMap;
use std::ops::Range;

/// Attributes per element. The parser compares each one with every other; no format needs half as
/// many.
pub(super) const MAX_ATTRIBUTES: u64 = 256;

/// Public identifiers of the definitions of SVG 1.0 and 1.1 begin with this text.
const SVG_DEFINITION: &[u8] = b"-//W3C//DTD SVG 1.";

/// The part of a text before the root element.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Prolog {
    /// The document type definition, with its angle brackets.
    pub(super) doctype: Option<Range<usize>>,
    /// Byte offset of the root element, or of the first byte that no prolog has.
    pub(crate) root: usize,
}

/// A construct that does not end, or a definition that breaks the grammar, at a byte.
#[derive(Debug, PartialEq)]
pub(crate) enum PrologError {
    Unterminated(usize),
    Malformed(usize),
}

impl Prolog {
    /// Finds the root element of a text and its document type definition.
    ///
    /// # Errors
    /// When a comment, an instruction or a definition is not terminated or malformed.
    pub(crate) fn scan(text: &[u8]) -> Result<Self, PrologError> {
        let mut prolog = Self::default();
        let mut cursor = Cursor { text, at: 0 };
        loop {
            cursor.skip_blank();
            let start = cursor.at;
            if cursor.misc()? {
                continue;
            }
            if prolog.doctype.is_none() && cursor.eat(b"<!DOCTYPE") {
                cursor.definition(start, &mut |_, _| Ok(()))?;
                prolog.doctype = Some(start..cursor.at);
                continue;
            }
            prolog.root = start;
            return Ok(prolog);
        }
    }
}

/// The declarations of a definition that change how a document is read.
#[derive(Debug, Default)]
pub(super) struct Definitions<'t> {
    /// The value of each internal general entity, as written.
    pub(super) entities: HashMap<&'t str, &'t str>,
    /// Default attributes per element: name and value as written.
    pub(super) defaults: HashMap<&'t str, Vec<(&'t str, &'t str)>>,
}

impl<'t> Definitions<'t> {
    /// Reads the definition at a range of a text. The first declaration of a name counts.
    ///
    /// # Errors
    /// When a declaration is not terminated or malformed.
    pub(super) fn read(text: &'t str, doctype: Range<usize>) -> Result<Self, PrologError> {
        let bytes = text.as_bytes();
        let mut cursor = Cursor {
            text: &bytes[..doctype.end],
            at: doctype.start + b"<!DOCTYPE".len(),
        };
        let mut definitions = Self::default();
        let slice = |range: Range<usize>| text.get(range).unwrap_or_default();
        let end = cursor.definition(doctype.start, &mut |cursor, keyword| {
            match keyword {
                b"ENTITY" => {
                    if let Some([name, value]) = cursor.entity()? {
                        let entities = &mut definitions.entities;
                        entities.entry(slice(name)).or_insert(slice(value));
                    }
                }
                _ => {
                    let (element, defaults) = cursor.attributes()?;
                    let all = definitions.defaults.entry(slice(element)).or_default();
                    for (name, value) in defaults {
                        let (name, value) = (slice(name), slice(value));
                        // An element with more attributes is refused, so that further ones are not
                        // compared with all.
                        let is_full = all.len() as u64 > MAX_ATTRIBUTES;
                        if !is_full && !all.iter().any(|(known, _)| *known == name) {
                            all.push((name, value));
                        }
                    }
                }
            }
            Ok(())
        })?;
        let head = &bytes[doctype.start..end];
        if head
            .windows(SVG_DEFINITION.len())
            .any(|w| w == SVG_DEFINITION)
        {
            let all = definitions.defaults.entry("svg").or_default();
            if !all.iter().any(|(name, _)| *name == "xmlns:xlink") {
                all.push(("xmlns:xlink", "http://www.w3.org/1999/xlink"));
            }
        }
        Ok(definitions)
    }
}

/// A place in a text.
struct Cursor<'t> {
    text: &'t [u8],
    at: usize,
}

/// Reads the declaration after its keyword.
type Declaration<'f, 't> = dyn FnMut(&mut Cursor<'t>, &[u8]) -> Result<(), PrologError> + 'f;

impl<'t> Cursor<'t> {
    fn rest(&self) -> &'t [u8] {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn eat(&mut self, expected: &[u8]) -> bool {
        let found = self.rest().starts_with(expected);
        self.at += if found { expected.len() } else { 0 };
        found
    }

    fn skip_blank(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_ascii_start().len();
    }

    /// Skips to the byte after the next `end`. `start` is the place that an error names.
    fn through(&mut self, end: &[u8], start: usize) -> Result<(), PrologError> {
        let found = self.rest().windows(end.len()).position(|w| w == end);
        let length = found.ok_or(PrologError::Unterminated(start))?;
        self.at += length + end.len();
        Ok(())
    }

    /// Skips a comment or an instruction. Returns `true` if there was one.
    fn misc(&mut self) -> Result<bool, PrologError> {
        let start = self.at;
        if self.eat(b"<!--") {
            self.through(b"-->", start)?;
        } else if self.eat(b"<?") {
            self.through(b"?>", start)?;
        }
        Ok(self.at > start)
    }

    /// Reads a quoted value: the range between the quotes, or `None` if there is no quote.
    fn quoted(&mut self) -> Result<Option<Range<usize>>, PrologError> {
        let start = self.at;
        let quote = match self.rest().first() {
            Some(&quote @ (b'"' | b'\'')) => quote,
            _ => return Ok(None),
        };
        self.at += 1;
        self.through(&[quote], start)?;
        Ok(Some(start + 1..self.at - 1))
    }

    /// Reads a name or a keyword; empty if there is none.
    fn word(&mut self) -> Range<usize> {
        let ends = |b: &u8| b.is_ascii_whitespace() || b"\"'<>[]()%|".contains(b);
        let rest = self.rest();
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        self.at += length;
        self.at - length..self.at
    }

    /// Reads a definition after `<!DOCTYPE` up to its end, and passes each declaration of entities
    /// and attributes to `declare`. Returns the end of its head, before the declarations.
    fn definition(
        &mut self,
        start: usize,
        declare: &mut Declaration<'_, 't>,
    ) -> Result<usize, PrologError> {
        let mut head_end = None;
        loop {
            self.skip_blank();
            let at = self.at;
            if self.eat(b">") {
                return Ok(head_end.unwrap_or(at));
            }
            if head_end.is_none() && self.eat(b"[") {
                head_end = Some(at);
                self.declarations(start, declare)?;
            } else if self.quoted()?.is_none() && self.word().is_empty() {
                return Err(self.broken(start));
            }
        }
    }

    /// Reads declarations up to the closing bracket.
    fn declarations(
        &mut self,
        start: usize,
        declare: &mut Declaration<'_, 't>,
    ) -> Result<(), PrologError> {
        loop {
            self.skip_blank();
            let at = self.at;
            if self.eat(b"]") {
                return Ok(());
            }
            if self.misc()? {
                continue;
            }
            // Parameter entities are not followed.
            if self.eat(b"%") {
                self.through(b";", at)?;
            } else if self.eat(b"<!ENTITY") {
                declare(self, b"ENTITY")?;
            } else if self.eat(b"<!ATTLIST") {
                declare(self, b"ATTLIST")?;
            } else if !self.eat(b"<!ELEMENT") && !self.eat(b"<!NOTATION") {
                return Err(self.broken(start));
            }
            self.end_of_declaration(at)?;
        }
    }

    /// Skips to the end of a declaration that began at `start`; a reference has none.
    fn end_of_declaration(&mut self, start: usize) -> Result<(), PrologError> {
        if self.text[start] == b'%' {
            return Ok(());
        }
        loop {
            match self.rest().first() {
                None => return Err(PrologError::Unterminated(start)),
                Some(b'>') => {
                    self.at += 1;
                    return Ok(());
                }
                Some(b'"' | b'\'') => {
                    self.quoted()?;
                }
                Some(b'<') => return Err(PrologError::Malformed(self.at)),
                Some(_) => self.at += 1,
            }
        }
    }

    /// Reads name and value of an entity. `None` for a parameter entity, and for one that another
    /// file holds.
    fn entity(&mut self) -> Result<Option<[Range<usize>; 2]>, PrologError> {
        self.skip_blank();
        if self.eat(b"%") {
            return Ok(None);
        }
        let name = self.word();
        self.skip_blank();
        Ok(self.quoted()?.map(|value| [name, value]))
    }

    /// Reads the attributes of an element that have a default.
    #[expect(
        clippy::type_complexity,
        reason = "an element, and pairs of names and values"
    )]
    fn attributes(
        &mut self,
    ) -> Result<(Range<usize>, Vec<(Range<usize>, Range<usize>)>), PrologError> {
        self.skip_blank();
        let element = self.word();
        let mut defaults = Vec::new();
        loop {
            self.skip_blank();
            let name = self.word();
            if name.is_empty() {
                return Ok((element, defaults));
            }
            self.skip_blank();
            let kind = self.word();
            self.skip_blank();
            // An enumeration, also of notations.
            if (kind.is_empty() || &self.text[kind] == b"NOTATION") && self.eat(b"(") {
                self.through(b")", name.start)?;
                self.skip_blank();
            }
            let keyword = self.word();
            self.skip_blank();
            if matches!(&self.text[keyword], b"" | b"#FIXED")
                && let Some(value) = self.quoted()?
            {
                defaults.push((name, value));
            }
        }
    }

    /// The error at the current place: the text ends, or has another construct than expected.
    fn broken(&self, start: usize) -> PrologError {
        match self.rest().is_empty() {
            true => PrologError::Unterminated(start),
            false => PrologError::Malformed(self.at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn definitions(text: &str) -> Definitions<'_> {
        let prolog = Prolog::scan(text.as_bytes()).unwrap();
        Definitions::read(text, prolog.doctype.unwrap()).unwrap()
    }

    #[test]
    fn brackets_in_values_comments_and_instructions_end_nothing() {
        for hidden in [
            "<?x ]><!-- ?>",
            "<!-- ]> -->",
            "<!ENTITY z ']>'>",
            "<!ENTITY z SYSTEM \"]>\">",
            "<!NOTATION n PUBLIC ']>'>",
            "<!ATTLIST g k CDATA ']>'>",
            "%z;",
        ] {
            let text = format!(
                "<?xml?> <!-- <!DOCTYPE --><!DOCTYPE svg [{hidden}<!ENTITY a 'b'>]> <svg/>"
            );
            let found = definitions(&text);
            assert_eq!(found.entities.get("a"), Some(&"b"), "{hidden}");
            let root = Prolog::scan(text.as_bytes()).unwrap().root;
            assert_eq!(&text[root..], "<svg/>", "{hidden}");
        }
    }

    #[test]
    fn reads_default_attributes_of_every_type() {
        let found = definitions(
            "<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' 'x' [<!ELEMENT g ANY>
            <!ATTLIST g xmlns:k CDATA #FIXED \"u>\"
              a CDATA #IMPLIED b (x|y) 'x' c NOTATION (n) #REQUIRED d ID 'i'>
            <!ATTLIST g a CDATA 'late' b CDATA 'second'> ]>",
        );
        let expected = vec![("xmlns:k", "u>"), ("b", "x"), ("d", "i"), ("a", "late")];
        assert_eq!(found.defaults["g"], expected);
        assert_eq!(found.defaults["svg"][0].0, "xmlns:xlink");
    }

    #[test]
    fn refuses_what_does_not_end_and_what_is_no_declaration() {
        for text in [
            "<!DOCTYPE a [",
            "<!DOCTYPE a [<!ENTITY b 'c>]>",
            "<!--",
            "<?x",
            "<!DOCTYPE a 'b>",
        ] {
            let error = Prolog::scan(text.as_bytes());
            assert!(matches!(error, Err(PrologError::Unterminated(_))), "{text}");
        }
        for text in [
            "<!DOCTYPE a [<b/>]><c/>",
            "<!DOCTYPE a [<!ENTITY b <c>]>",
            "<!DOCTYPE a <b/>",
        ] {
            let error = Prolog::scan(text.as_bytes());
            assert!(matches!(error, Err(PrologError::Malformed(_))), "{text}");
        }
    }
}
