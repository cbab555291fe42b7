//! Streams SVG elements: paths with strokes, groups, rectangles, polygon layers, texts and images.

use std::fmt::Write as _;
use std::io::{self, Write};

use guideway_layout::Value;
use guideway_spline::{Point, uniform};

use crate::clamped::is_straight;
use crate::xml_text::escape;

/// Path data: the value of the `d` attribute of a `path` element.
#[derive(Clone, Debug)]
pub struct PathData {
    data: String,
    end: Option<Point<f64>>,
    step: f64,
}

impl PathData {
    /// Empty path data. Rounds coordinates to multiples of `step`, in user units; segments whose
    /// ends are at most `step` apart are joined.
    pub fn new(step: f64) -> Self {
        Self {
            data: String::new(),
            end: None,
            step,
        }
    }

    /// Appends a segment of a uniform cubic B-spline, in user units, y down: as a line if it is
    /// straight, else as the exact cubic Bezier curve.
    pub fn push_segment(&mut self, segment: &[Point<f64>; 4]) {
        let bezier = uniform::to_bezier(segment);
        if !self
            .end
            .is_some_and(|end| end.distance(bezier[0]) <= self.step)
        {
            self.command("M", &bezier[..1]);
        }
        match is_straight(&bezier, self.step) {
            true => self.command("L", &bezier[3..]),
            false => self.command("C", &bezier[1..]),
        }
        self.end = Some(bezier[3]);
    }

    fn polygon(&mut self, corners: &[Point<f64>]) {
        if let Some((first, others)) = corners.split_first() {
            self.command("M", std::slice::from_ref(first));
            others
                .iter()
                .for_each(|p| self.command("L", std::slice::from_ref(p)));
            self.data.push('Z');
        }
    }

    /// Tells if it has no commands.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    fn command(&mut self, command: &str, points: &[Point<f64>]) {
        self.data.push_str(command);
        for (i, p) in points.iter().enumerate() {
            let steps = 1.0 / self.step;
            // Adding 0 turns -0 into 0.
            let [x, y] = [p.x, p.y].map(|v| (v * steps).round() / steps + 0.0);
            let space = if i == 0 { "" } else { " " };
            // Writing to a string cannot fail.
            let _ = write!(self.data, "{space}{x} {y}");
        }
    }
}

/// A line of monospace text. Its glyphs are stretched to its width, in any font that the viewer
/// has.
#[derive(Clone, Copy, Debug)]
pub struct SvgText<'a> {
    /// Left end of the baseline.
    pub at: [f64; 2],
    /// Font size.
    pub height: f64,
    /// Width of the whole line.
    pub width: f64,
    /// Clockwise rotation in degrees, and the point that it is about.
    pub turned: (f64, [f64; 2]),
    /// Color 0xRRGGBBAA.
    pub rgba: u32,
    /// Stroke below the letters.
    pub halo: Option<Stroke>,
    /// The characters.
    pub text: &'a str,
}

/// Color and width of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    rgba: u32,
    width: f64,
}

impl Stroke {
    /// A stroke of a color 0xRRGGBBAA and a width in user units.
    pub fn new(rgba: u32, width: f64) -> Self {
        Self { rgba, width }
    }

    /// The attributes that differ from those of `from`, or all.
    fn attributes(&self, from: Option<&Self>) -> String {
        let mut text = String::new();
        if from.is_none_or(|f| f.rgba != self.rgba) {
            text += &paint("stroke", self.rgba);
            if self.rgba & 0xFF == 0xFF && from.is_some_and(|f| f.rgba & 0xFF != 0xFF) {
                text += r#" stroke-opacity="1""#;
            }
        }
        if from.is_none_or(|f| f.width != self.width) {
            // Widths are often f32 values: prints 0.3, not 0.30000001192092896.
            text += &format!(r#" stroke-width="{}""#, Value::Float(self.width));
        }
        text
    }
}

/// The attributes `property` (`stroke` or `fill`) and its opacity for a color 0xRRGGBBAA.
fn paint(property: &str, rgba: u32) -> String {
    let mut text = format!(r##" {property}="#{:06x}""##, rgba >> 8);
    let alpha = rgba & 0xFF;
    if alpha != 0xFF {
        // Four digits distinguish all 256 alpha values.
        text += &format!(r#" {property}-opacity="{:.4}""#, f64::from(alpha) / 255.0);
    }
    text
}

/// Writes an SVG document element by element.
#[derive(Debug)]
pub struct SvgWriter<'w, W> {
    out: &'w mut W,
    common: Stroke,
}

impl<'w, W: Write> SvgWriter<'w, W> {
    /// Begins a document with the view box `[x, y, width, height]`, further attributes of the root,
    /// and the most common stroke. Paths with another stroke override it.
    ///
    /// # Errors
    /// When writing to `out` fails; the same holds for all other methods.
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

    /// Writes a path; nothing if `data` is empty.
    ///
    /// # Errors
    /// When writing fails.
    pub fn path(&mut self, id: &str, data: &PathData, stroke: &Stroke) -> io::Result<()> {
        if data.is_empty() {
            return Ok(());
        }
        let own = stroke.attributes(Some(&self.common));
        let id = match id {
            "" => String::new(),
            id => format!(r#" id="{}""#, escape(id)),
        };
        writeln!(self.out, r#"<path{id} d="{}"{own}/>"#, data.data)
    }

    /// Begins a group, which Inkscape shows as a layer.
    ///
    /// # Errors
    /// When writing fails.
    pub fn begin_group(&mut self, label: &str) -> io::Result<()> {
        let label = escape(label);
        writeln!(
            self.out,
            r#"<g inkscape:groupmode="layer" inkscape:label="{label}">"#
        )
    }

    /// Begins a group that lets what is below it shine through, from opacity 0 to 1.
    ///
    /// # Errors
    /// When writing fails.
    pub fn begin_faded_group(&mut self, opacity: f64) -> io::Result<()> {
        writeln!(self.out, r#"<g opacity="{opacity:.3}">"#)
    }

    /// Ends the innermost group.
    ///
    /// # Errors
    /// When writing fails.
    pub fn end_group(&mut self) -> io::Result<()> {
        writeln!(self.out, "</g>")
    }

    /// Begins a viewport with its own origin, which clips what it holds, given its upper left
    /// corner and its size.
    ///
    /// # Errors
    /// When writing fails.
    pub fn begin_viewport(&mut self, [x, y]: [u32; 2], size: [u32; 2]) -> io::Result<()> {
        let [width, height] = size;
        writeln!(
            self.out,
            r#"<svg x="{x}" y="{y}" width="{width}" height="{height}">"#
        )
    }

    /// Ends the innermost viewport.
    ///
    /// # Errors
    /// When writing fails.
    pub fn end_viewport(&mut self) -> io::Result<()> {
        writeln!(self.out, "</svg>")
    }

    /// Writes a rectangle `[x, y, width, height]` filled with a color 0xRRGGBBAA.
    ///
    /// # Errors
    /// When writing fails.
    pub fn rect(&mut self, [x, y, width, height]: [f64; 4], rgba: u32) -> io::Result<()> {
        let fill = paint("fill", rgba);
        let bounds = format!(r#"x="{x}" y="{y}" width="{width}" height="{height}""#);
        writeln!(self.out, r#"<rect {bounds} stroke="none"{fill}/>"#)
    }

    /// Writes a group of areas in one color 0xRRGGBBAA. The opacity applies to the group, so that
    /// overlapping areas do not add up. Each area is a path of convex polygons with one winding
    /// direction, rounded to multiples of `step`.
    ///
    /// # Errors
    /// When writing fails.
    pub fn polygon_layer<A: AsRef<[Point<f64>]>>(
        &mut self,
        label: &str,
        rgba: u32,
        step: f64,
        areas: impl IntoIterator<Item = impl IntoIterator<Item = A>>,
    ) -> io::Result<()> {
        let (label, fill) = (escape(label), paint("fill", rgba | 0xFF));
        let opacity = f64::from(rgba & 0xFF) / 255.0;
        writeln!(
            self.out,
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{label}\" opacity=\"{opacity:.4}\" \
             stroke=\"none\"{fill}>"
        )?;
        for area in areas {
            let mut data = PathData::new(step);
            area.into_iter()
                .for_each(|polygon| data.polygon(polygon.as_ref()));
            if !data.is_empty() {
                writeln!(self.out, r#"<path d="{}"/>"#, data.data)?;
            }
        }
        self.end_group()
    }

    /// Writes a line of text.
    ///
    /// # Errors
    /// When writing fails.
    pub fn text_line(&mut self, line: &SvgText<'_>) -> io::Result<()> {
        let ([x, y], height, width) = (line.at, line.height, line.width);
        let layout = format!(r#"x="{x}" y="{y}" font-size="{height}" textLength="{width}""#);
        let adjust = r#"lengthAdjust="spacingAndGlyphs""#;
        let turned = match line.turned {
            (0.0, _) => String::new(),
            (angle, [x, y]) => format!(r#" transform="rotate({angle:.3} {x} {y})""#),
        };
        let stroke = match line.halo {
            None => r#" stroke="none""#.to_owned(),
            Some(halo) => {
                let below = r#" paint-order="stroke" stroke-linejoin="round""#;
                format!("{below}{}", halo.attributes(None))
            }
        };
        let (fill, text) = (paint("fill", line.rgba), escape(line.text));
        writeln!(
            self.out,
            r#"<text {layout} {adjust} font-family="monospace"{turned}{stroke}{fill}>{text}</text>"#
        )
    }

    /// Writes an image from a data URI. `matrix` (a, b, c, d, e, f of SVG) maps the unit square to
    /// user units.
    ///
    /// # Errors
    /// When writing fails.
    pub fn image(&mut self, matrix: [f64; 6], data_uri: &str) -> io::Result<()> {
        let matrix = matrix.map(|v| v.to_string()).join(" ");
        let size = r#"width="1" height="1" preserveAspectRatio="none""#;
        writeln!(
            self.out,
            r#"<image {size} transform="matrix({matrix})" href="{data_uri}"/>"#
        )
    }

    /// Ends the document.
    ///
    /// # Errors
    /// When writing fails.
    pub fn finish(self) -> io::Result<()> {
        writeln!(self.out, "</g>\n</svg>")
    }
}
