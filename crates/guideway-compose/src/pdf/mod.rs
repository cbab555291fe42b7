//! Writes a page of vector graphics as PDF 1.6 (ISO 32000-1): paths as curves, texts as outlines.
//!
//! | module | content |
//! |---|---|
//! | `content` | the operators of one content stream |
//! | `file` | objects and their table of places |

mod content;
mod file;

use std::io::{self, Write};

use guideway_scene::{FrameSize, Rgba, TextLine};
use guideway_spline::{Point, uniform};

use self::content::Content;
use self::file::{Objects, text_string};
use crate::page::{Page, PageImage};
use crate::text::{LinePlace, ShapedLine};

/// Points of a page (1/72 inch) per pixel (1/96 inch).
const POINTS_PER_PX: f64 = 0.75;
/// Largest side of a page in its units (ISO 32000-1, annex C).
const MAX_UNITS: f64 = 14_400.0;

/// A page that becomes a PDF file.
pub(crate) struct PdfPage {
    objects: Objects,
    size_px: [f64; 2],
    /// The content of the page, and of the groups that are open.
    open: Vec<Open>,
}

/// A content stream that is being written.
struct Open {
    content: Content,
    /// Opacity of a group that becomes an object of its own; `None` for one within its parent.
    opacity: Option<u8>,
}

impl PdfPage {
    /// An empty page.
    pub(crate) fn new(size: FrameSize) -> io::Result<Self> {
        let size_px = [size.width(), size.height()].map(f64::from);
        let mut content = Content::default();
        // The origin of PDF is the lower left corner, with y up.
        let scale = Self::units_per_px(size_px);
        let flip = [scale, 0.0, 0.0, -scale, 0.0, scale * size_px[1]];
        content.numbers(&flip, "cm")?;
        content.operator("1 J 1 j")?;
        Ok(Self {
            objects: Objects::new(),
            size_px,
            open: vec![Open {
                content,
                opacity: None,
            }],
        })
    }

    fn units_per_px(size_px: [f64; 2]) -> f64 {
        POINTS_PER_PX.min(MAX_UNITS / size_px[0].max(size_px[1]))
    }

    fn content(&mut self) -> &mut Content {
        let last = self.open.len() - 1;
        &mut self.open[last].content
    }

    /// Selects a color for lines or areas, and its opacity.
    fn select(&mut self, color: Rgba, operator: &str) -> io::Result<()> {
        let alpha = self.objects.alpha(color.a);
        let [r, g, b] = [color.r, color.g, color.b].map(|c| f64::from(c) / 255.0);
        self.content().state(&alpha)?;
        self.content().numbers(&[r, g, b], operator)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// When the output fails.
    pub(crate) fn finish(mut self, title: Option<&str>, out: &mut impl Write) -> io::Result<()> {
        let title = title.map_or_else(String::new, |title| {
            format!("/Title {}", text_string(title))
        });
        let info = format!(
            "<</Producer(Guideway {}){title}>>",
            env!("CARGO_PKG_VERSION")
        );
        let units = self.size_px.map(|px| px * Self::units_per_px(self.size_px));
        // One unit is more than a point on a page that is larger than its units can say.
        let user_unit = POINTS_PER_PX / Self::units_per_px(self.size_px);
        let last = self.open.swap_remove(0).content;
        self.objects
            .write(last.finish()?, units, user_unit, &info, out)
    }
}

impl Page for PdfPage {
    fn path(
        &mut self,
        _id: Option<&str>,
        segments: &[[Point<f64>; 4]],
        color: Rgba,
        width_px: f64,
    ) -> io::Result<()> {
        if segments.is_empty() {
            return Ok(());
        }
        self.select(color, "RG")?;
        let content = self.content();
        content.width(width_px)?;
        for segment in segments {
            let [a, b, c, d] = uniform::to_bezier(segment);
            content.move_on(a)?;
            content.curve(b, c, d)?;
        }
        content.operator("S")
    }

    fn rectangle(&mut self, [a, b]: [Point<f64>; 2], color: Rgba) -> io::Result<()> {
        self.select(color, "rg")?;
        let content = self.content();
        content.numbers(&[a.x, a.y, b.x - a.x, b.y - a.y], "re")?;
        content.operator("f")
    }

    fn areas(
        &mut self,
        _label: &str,
        color: Rgba,
        areas: &[Vec<Vec<Point<f64>>>],
    ) -> io::Result<()> {
        if areas.iter().all(Vec::is_empty) {
            return Ok(());
        }
        self.select(color, "rg")?;
        let content = self.content();
        // One path, whose areas have one winding direction: its color is composited once.
        for contour in areas.iter().flatten() {
            content.polygon(contour)?;
        }
        content.operator("f")
    }

    fn text(&mut self, text: &TextLine) -> io::Result<()> {
        let (line, place) = (ShapedLine::new(&text.text), LinePlace::of(text));
        if text.halo.a > 0 {
            self.select(text.halo, "RG")?;
            let content = self.content();
            // A stroke is as wide on both sides of the outlines of letters.
            content.width(2.0 * text.halo_px())?;
            for glyph in line.outlines(&place) {
                if content.glyph(&glyph)? {
                    content.operator("S")?;
                }
            }
        }
        self.select(text.color, "rg")?;
        let content = self.content();
        for glyph in line.outlines(&place) {
            if content.glyph(&glyph)? {
                content.operator("f")?;
            }
        }
        Ok(())
    }

    fn image(&mut self, matrix: [f64; 6], image: &impl PageImage) -> io::Result<()> {
        let name = self.objects.image(image.size_px(), image.pixels())?;
        let [a, b, c, d, e, f] = matrix;
        // The unit square of an image of PDF has its first row at y = 1.
        let placed = [a, b, -c, -d, e + c, f + d];
        let opaque = self.objects.alpha(255);
        let content = self.content();
        content.state(&opaque)?;
        content.operator("q")?;
        content.numbers(&placed, "cm")?;
        content.operator(&format!("/{name} Do Q"))
    }

    fn begin_group(&mut self, _label: &str, opacity: f64) -> io::Result<()> {
        let alpha = (opacity * 255.0).round() as u8;
        let (content, opacity) = match alpha {
            // Elements of an opaque group are those of its parent.
            255 => {
                let last = self.open.len() - 1;
                (std::mem::take(&mut self.open[last].content), None)
            }
            _ => (Content::default(), Some(alpha)),
        };
        self.open.push(Open { content, opacity });
        Ok(())
    }

    fn end_group(&mut self) -> io::Result<()> {
        let Some(group) = self.open.pop() else {
            return Ok(());
        };
        match group.opacity {
            None => *self.content() = group.content,
            Some(opacity) => {
                let form = self.objects.form(group.content.finish()?, self.size_px);
                let alpha = self.objects.alpha(opacity);
                let content = self.content();
                content.state(&alpha)?;
                content.operator(&format!("/{form} Do"))?;
            }
        }
        Ok(())
    }

    fn begin_part(&mut self, corner_px: [u32; 2], size_px: [u32; 2]) -> io::Result<()> {
        let ([x, y], [width, height]) = (corner_px.map(f64::from), size_px.map(f64::from));
        let content = self.content();
        content.save()?;
        content.numbers(&[1.0, 0.0, 0.0, 1.0, x, y], "cm")?;
        content.numbers(&[0.0, 0.0, width, height], "re W n")
    }

    fn end_part(&mut self) -> io::Result<()> {
        self.content().restore()
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    fn p(x: f64, y: f64) -> Point<f64> {
        Point::new(x, y)
    }

    fn page() -> PdfPage {
        PdfPage::new(FrameSize::new(200, 100).unwrap()).unwrap()
    }

    fn bytes(page: PdfPage) -> Vec<u8> {
        let mut out = Vec::new();
        page.finish(Some("Halle Süd"), &mut out).unwrap();
        out
    }

    /// The texts of all compressed streams, in file order.
    fn streams(file: &[u8]) -> Vec<String> {
        let find = |from: usize, what: &[u8]| {
            let place = file[from..]
                .windows(what.len())
                .position(|part| part == what);
            place.map(|at| from + at)
        };
        let mut texts = Vec::new();
        let mut from = 0;
        while let Some(start) = find(from, b">>stream\n") {
            let end = find(start, b"\nendstream").unwrap();
            let mut text = Vec::new();
            let mut decoder = flate2::read::ZlibDecoder::new(&file[start + 9..end]);
            decoder.read_to_end(&mut text).unwrap();
            texts.push(String::from_utf8_lossy(&text).into_owned());
            from = end;
        }
        texts
    }

    #[test]
    fn table_of_places_points_at_every_object() {
        let mut page = page();
        page.rectangle([p(0.0, 0.0), p(9.0, 9.0)], Rgba::from_u32(0x1020_3080))
            .unwrap();
        let file = bytes(page);
        let text = String::from_utf8_lossy(&file);
        assert!(text.starts_with("%PDF-1.6\n") && text.ends_with("%%EOF\n"));
        let place = text.rsplit("startxref\n").next().unwrap();
        let place: usize = place.lines().next().unwrap().parse().unwrap();
        let table = String::from_utf8_lossy(&file[place..]).into_owned();
        let mut lines = table.lines().skip(1);
        let count: usize = lines.next().unwrap()[2..].parse().unwrap();
        let entries: Vec<&str> = lines.take(count).collect();
        for (number, entry) in entries.iter().enumerate().skip(1) {
            let place: usize = entry[..10].parse().unwrap();
            let head = format!("{number} 0 obj");
            assert!(file[place..].starts_with(head.as_bytes()), "{number}");
        }
        assert!(text.contains("/MediaBox[0 0 150 75]"), "{text}");
        assert!(text.contains("/ca 0.501961 /CA"), "{text}");
        assert!(text.contains("<FEFF00480061006C006C006500200053"), "{text}");
    }

    #[test]
    fn paths_areas_and_letters_are_curves() {
        let mut page = page();
        let line = [p(-20.0, 5.0), p(10.0, 5.0), p(40.0, 5.0), p(70.0, 5.0)];
        page.path(Some("a"), &[line], Rgba::BLACK, 2.5).unwrap();
        let outer = vec![p(0.0, 0.0), p(9.0, 0.0), p(9.0, 9.0)];
        let hole = vec![p(4.0, 2.0), p(6.0, 4.0), p(6.0, 2.0)];
        page.areas("", Rgba::WHITE, &[vec![outer, hole]]).unwrap();
        page.text(&TextLine {
            text: "o".into(),
            left_middle_px: p(10.0, 50.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: 12.0,
            color: Rgba::BLACK,
            halo: Rgba::from_u32(0),
        })
        .unwrap();
        let content = streams(&bytes(page)).remove(0);
        assert!(content.contains("10 5 m 20 5 30 5 40 5 c S"), "{content}");
        assert!(content.contains("2.5 w"), "{content}");
        // One path, in which the hole turns against the outer contour.
        let area = "0 0 m 9 0 l 9 9 l h 4 2 m 6 4 l 6 2 l h f";
        assert!(content.contains(area), "{content}");
        assert!(content.matches(" c").count() > 4, "{content}");
    }

    #[test]
    fn parts_have_their_own_origin_and_end_with_the_state_before() {
        let mut page = page();
        let corners = [p(1.0, 2.0), p(9.0, 9.0)];
        page.rectangle(corners, Rgba::WHITE).unwrap();
        page.begin_part([50, 0], [50, 100]).unwrap();
        page.rectangle(corners, Rgba::BLACK).unwrap();
        page.end_part().unwrap();
        page.rectangle(corners, Rgba::WHITE).unwrap();
        page.rectangle(corners, Rgba::BLACK).unwrap();
        let content = streams(&bytes(page)).remove(0);
        let after_part = content.split("Q\n").nth(1).unwrap();
        assert!(
            content.contains("q\n1 0 0 1 50 0 cm\n0 0 50 100 re W n\n"),
            "{content}"
        );
        // White is still selected, black is not.
        assert!(
            after_part.starts_with("1 2 8 7 re\nf\n0 0 0 rg"),
            "{content}"
        );
    }

    #[test]
    fn faded_groups_are_composited_once() {
        let mut page = page();
        page.begin_group("pale", 0.5).unwrap();
        page.begin_group("inner", 1.0).unwrap();
        let corners = [p(0.0, 0.0), p(9.0, 9.0)];
        page.rectangle(corners, Rgba::BLACK).unwrap();
        page.end_group().unwrap();
        page.end_group().unwrap();
        page.rectangle(corners, Rgba::WHITE).unwrap();
        let file = bytes(page);
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains("/Group<</S/Transparency"), "{text}");
        let all = streams(&file);
        let parts: Vec<_> = all.iter().filter(|part| part.contains("re\nf")).collect();
        assert_eq!(parts.len(), 2, "{all:?}");
        assert!(
            parts.iter().any(|part| part.contains("/A128 gs /F1 Do")),
            "{all:?}"
        );
    }
}
