//! Notes: reads texts and points, and keeps them with placed blocks as notes of the layout. They
//! are not drawn; `guideway network` names stations and nodes after them.

use guideway_layout::{Note, NoteKind};
use guideway_spline::Point;

use super::affine3::Affine3;
use super::records::Record;
use super::shape::{Mark, Shape, plane};
use super::text::TextDecoder;
use crate::ReadError;
use crate::builder::Builder;
use crate::pair_reader::Pair;

/// Returns `true` if entities of a kind are notes.
pub(super) fn is_note(kind: &str) -> bool {
    matches!(kind, "TEXT" | "MTEXT" | "ATTRIB" | "POINT")
}

/// Parses a record of a kind that [`is_note`]; `None` without a position.
pub(super) fn mark(kind: &str, record: &Record<'_>, texts: &TextDecoder) -> Option<Shape> {
    let (text, at) = match kind {
        "POINT" => (String::new(), record.vector(10)?),
        "MTEXT" => {
            let parts = record.all(3).chain(record.all(1));
            let text = texts.decode_parts(parts.map(Pair::text));
            (plain_mtext(&text), record.vector(10)?)
        }
        _ => {
            let is_aligned = [72, 73, 74]
                .iter()
                .any(|&code| record.int(code).unwrap_or(0) != 0);
            let aligned = record.vector(11).filter(|_| is_aligned);
            let at = aligned.or_else(|| record.vector(10))?;
            let text = plain_text(&texts.decode(record.text(1).unwrap_or_default()));
            (text, plane(record).point(at))
        }
    };
    Some(Shape::Mark(Box::new(Mark {
        kind: if kind == "POINT" {
            NoteKind::Point
        } else {
            NoteKind::Text
        },
        text,
        at,
        is_attribute: kind == "ATTRIB",
    })))
}

/// Adds a text or a point to the notes of the layout.
pub(super) fn add_mark(
    builder: &mut Builder<'_>,
    mark: &Mark,
    transform: &Affine3,
    layer: &str,
) -> Result<(), ReadError> {
    let notes = &mut builder.layout.notes;
    if mark.is_attribute
        && let Some(block) = notes.last_mut().filter(|note| note.kind == NoteKind::Block)
    {
        if block.text.is_empty() {
            mark.text.clone_into(&mut block.text);
        }
        return builder.charge_text(&mark.text);
    }
    let position_m = transform.point(mark.at).xy();
    add(builder, mark.kind, &mark.text, "", layer, position_m)
}

/// Adds a placed block to the notes of the layout.
pub(super) fn add_block(
    builder: &mut Builder<'_>,
    name: &str,
    layer: &str,
    position_m: Point<f64>,
) -> Result<(), ReadError> {
    add(builder, NoteKind::Block, "", name, layer, position_m)
}

fn add(
    builder: &mut Builder<'_>,
    kind: NoteKind,
    text: &str,
    block: &str,
    layer: &str,
    position_m: Point<f64>,
) -> Result<(), ReadError> {
    let limit = builder.source.options.limits.coordinate_m;
    if !(position_m.x.abs() <= limit && position_m.y.abs() <= limit) {
        return Ok(());
    }
    for part in [text, block, layer] {
        builder.check_text(part)?;
        builder.charge_text(part)?;
    }
    builder.layout.notes.push(Note {
        kind,
        text: text.to_owned(),
        block: block.to_owned(),
        layer: layer.to_owned(),
        position_m,
    });
    Ok(())
}

/// A TEXT without its control codes: `%%d` is a degree sign, `%%u` underlines. It has one line.
fn plain_text(text: &str) -> String {
    let text = text.replace(|c: char| c.is_control(), " ");
    let mut parts = text.split("%%");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let mut letters = part.chars();
        plain.push_str(
            match letters.next().map(|letter| letter.to_ascii_lowercase()) {
                Some('d') => "°",
                Some('p') => "±",
                Some('c') => "⌀",
                Some('u' | 'o' | 'k') => "",
                _ => {
                    letters = part.chars();
                    "%"
                }
            },
        );
        plain.push_str(letters.as_str());
    }
    plain.trim().to_owned()
}

/// An MTEXT without its formatting: `\P` begins a line, `\fArial;` selects a font, braces group.
fn plain_mtext(text: &str) -> String {
    let mut plain = String::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '{' | '}' => {}
            '\\' => match letters.next() {
                Some('P' | 'N' | 'X' | '~') => plain.push(' '),
                Some(escaped @ ('\\' | '{' | '}')) => plain.push(escaped),
                // Switches without a value.
                Some('L' | 'l' | 'O' | 'o' | 'K' | 'k') | None => {}
                // Stacked text, such as 1/2, has letters; all others only format.
                Some('S') => {
                    let stacked = letters.by_ref().take_while(|&l| l != ';');
                    plain.extend(stacked.map(|l| if l == '^' { '/' } else { l }));
                }
                Some(_) => {
                    letters.by_ref().find(|&l| l == ';');
                }
            },
            letter if letter.is_control() => plain.push(' '),
            letter => plain.push(letter),
        }
    }
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_lose_their_formatting_only() {
        assert_eq!(plain_text("%%uDock%%u 90%%d 50%% %%c8"), "Dock 90° 50% ⌀8");
        let mtext = r"{\fArial|b1;\H2.5;PICK}-07\Pbay\~2 \S1^2; \{x\}";
        assert_eq!(plain_mtext(mtext), "PICK-07 bay 2 1/2 {x}");
        assert_eq!(plain_mtext(r"A\"), "A");
    }
}
