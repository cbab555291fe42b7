//! The elements of a drawing: curves with their strokes, groups, areas, texts, images.

use std::fmt::Write as _;
use std::io::{self, Write};

use guideway_layout::Value;
use guideway_spline::{Point, uniform};

use super::write::escaped;
use crate::clamped::is_straight;

/// The curve of one path, as the `d` of an element.
#[derive(Clone, Debug)]
pub struct PathData {
    data: String,
    end: Option<Point<f64>>,
    step: f64,
}

impl PathData {
    /// An empty one. Coordinates are rounded to multiples of `step`; ends this near meet.
    pub fn new(step: f64) -> Self {
        Self {
            data: String::new(),
            end: None,
            step,
        }
    }

    /// Appends a segment of a uniform cubic B-spline, in units of the page, y down: a line if it is straight,
    /// else a cubic curve, exactly.
    pub fn push_segment(&mut self, segment: &[Point<f64>; 4]) {
        let bezier = uniform::to_bezier(segment);
        if !self
            .end
            .is_some_and(|end| end.distance(bezier[0]) <= self.step)
        {
            self.put("M", &bezier[..1]);
        }
        match is_straight(&bezier, self.step) {
            true => self.put("L", &bezier[3..]),
            false => self.put("C", &bezier[1..]),
        }
        self.end = Some(bezier[3]);
    }

    fn polygon(&mut self, corners: &[Point<f64>]) {
        if let Some((first, others)) = corners.split_first() {
            self.put("M", std::slice::from_ref(first));
            others
                .iter()
                .for_each(|p| self.put("L", std::slice::from_ref(p)));
            self.data.push('Z');
        }
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    fn put(&mut self, command: &str, points: &[Point<f64>]) {
        self.data.push_str(command);
        for (i, p) in points.iter().enumerate() {
            let steps = 1.0 / self.step;
            // Adding zero turns -0 into 0.
            let [x, y] = [p.x, p.y].map(|v| (v * steps).round() / steps + 0.0);
            let space = if i == 0 { "" } else { " " };
            // Writing to a text cannot fail.
            let _ = write!(self.data, "{space}{x} {y}");
        }
    }
}

/// How a path is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    rgba: u32,
    width: f64,
}

impl Stroke {
    /// A color 0xRRGGBBAA and a width in units of the page.
    pub fn new(rgba: u32, width: f64) -> Self {
        Self { rgba, width }
    }

    /// The attributes in which it differs from another.
    fn attributes(&self, from: Option<&Self>) -> String {
        let mut text = String::new();
        if from.is_none_or(|f| f.rgba != self.rgba) {
            text += &paint("stroke", self.rgba);
            if self.rgba & 0xFF == 0xFF && from.is_some_and(|f| f.rgba & 0xFF != 0xFF) {
                text += r#" stroke-opacity="1""#;
            }
        }
        if from.is_none_or(|f| f.width != self.width) {
            // Single precision is common: 0.3 must not be 0.30000001192092896.
            text += &format!(r#" stroke-width="{}""#, Value::Float(self.width));
        }
        text
    }
}

/// A paint and its opacity, of a `stroke` or a `fill`.
fn paint(what: &str, rgba: u32) -> String {
    let mut text = format!(r##" {what}="#{:06x}""##, rgba >> 8);
    let alpha = rgba & 0xFF;
    if alpha != 0xFF {
        // Four digits tell all 256 apart.
        text += &format!(r#" {what}-opacity="{:.4}""#, f64::from(alpha) / 255.0);
    }
    text
}

/// A drawing that is being written.
#[derive(Debug)]
pub struct SvgWriter<'w, W> {
    out: &'w mut W,
    common: Stroke,
}

impl<'w, W: Write> SvgWriter<'w, W> {
    /// Begins a page that shows `[x, y, width, height]`, with further attributes of the page and the stroke
    /// that most paths have.
    ///
    /// # Errors
    /// When `out` fails; so for all that follow.
    pub fn begin(
        out: &'w mut W,
        view: [f64; 4],
        attributes: &str,
        common: &Stroke,
    ) -> io::Result<Self> {
        let [x, y, width, height] = view;
        let lines = r#"fill="none" stroke-linecap="round" stroke-linejoin="round""#;
        writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
             viewBox=\"{x} {y} {width} {height}\" {attributes}>\n<g {lines}{}>",
            common.attributes(None)
        )?;
        Ok(Self {
            out,
            common: *common,
        })
    }

    /// A path; without a curve it is nothing.
    ///
    /// # Errors
    /// When the target fails.
    pub fn path(&mut self, id: &str, outline: &PathData, stroke: &Stroke) -> io::Result<()> {
        if outline.is_empty() {
            return Ok(());
        }
        let own = stroke.attributes(Some(&self.common));
        let id = match id {
            "" => String::new(),
            id => format!(r#" id="{}""#, escaped(id)),
        };
        writeln!(self.out, r#"<path{id} d="{}"{own}/>"#, outline.data)
    }

    /// What follows is in a group, which drawing programs show as a layer.
    ///
    /// # Errors
    /// When the target fails.
    pub fn begin_group(&mut self, label: &str) -> io::Result<()> {
        let label = escaped(label);
        writeln!(
            self.out,
            r#"<g inkscape:groupmode="layer" inkscape:label="{label}">"#
        )
    }

    /// Ends the group.
    ///
    /// # Errors
    /// When the target fails.
    pub fn end_group(&mut self) -> io::Result<()> {
        writeln!(self.out, "</g>")
    }

    /// A rectangle `[x, y, width, height]` of a color 0xRRGGBBAA.
    ///
    /// # Errors
    /// When the target fails.
    pub fn rect(&mut self, [x, y, width, height]: [f64; 4], rgba: u32) -> io::Result<()> {
        let fill = paint("fill", rgba);
        let place = format!(r#"x="{x}" y="{y}" width="{width}" height="{height}""#);
        writeln!(self.out, r#"<rect {place} stroke="none"{fill}/>"#)
    }

    /// A layer of one color 0xRRGGBBAA, which counts once wherever some of its areas lie on each other. Each area
    /// is a path of convex polygons that go the same way round, rounded to multiples of `step`.
    ///
    /// # Errors
    /// When the target fails.
    pub fn polygon_layer<A: AsRef<[Point<f64>]>>(
        &mut self,
        label: &str,
        rgba: u32,
        step: f64,
        areas: impl IntoIterator<Item = impl IntoIterator<Item = A>>,
    ) -> io::Result<()> {
        let (label, fill) = (escaped(label), paint("fill", rgba | 0xFF));
        let opacity = f64::from(rgba & 0xFF) / 255.0;
        writeln!(
            self.out,
            r#"<g inkscape:groupmode="layer" inkscape:label="{label}" opacity="{opacity:.4}" stroke="none"{fill}>"#
        )?;
        for area in areas {
            let mut outline = PathData::new(step);
            area.into_iter()
                .for_each(|polygon| outline.polygon(polygon.as_ref()));
            if !outline.is_empty() {
                writeln!(self.out, r#"<path d="{}"/>"#, outline.data)?;
            }
        }
        self.end_group()
    }

    /// A text of a color 0xRRGGBBAA in letters of one width, which together are as wide as said.
    ///
    /// # Errors
    /// When the target fails.
    pub fn text(
        &mut self,
        [x, y]: [f64; 2],
        height: f64,
        width: f64,
        rgba: u32,
        text: &str,
    ) -> io::Result<()> {
        let place = format!(r#"x="{x}" y="{y}" font-size="{height}" textLength="{width}""#);
        let look = r#"font-family="monospace" stroke="none""#;
        let (fill, text) = (paint("fill", rgba), escaped(text));
        writeln!(self.out, "<text {place} {look}{fill}>{text}</text>")
    }

    /// An image whose unit square is put into place by `matrix` (a, b, c, d, e, f of SVG), as a data URI.
    ///
    /// # Errors
    /// When the target fails.
    pub fn image(&mut self, matrix: [f64; 6], data_uri: &str) -> io::Result<()> {
        let matrix = matrix.map(|v| v.to_string()).join(" ");
        let place = r#"width="1" height="1" preserveAspectRatio="none""#;
        writeln!(
            self.out,
            r#"<image {place} transform="matrix({matrix})" href="{data_uri}"/>"#
        )
    }

    /// Ends the page.
    ///
    /// # Errors
    /// When the target fails.
    pub fn finish(self) -> io::Result<()> {
        writeln!(self.out, "</g>\n</svg>")
    }
}
