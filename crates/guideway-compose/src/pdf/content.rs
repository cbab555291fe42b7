//! The operators of one content stream of PDF, compressed as they are written.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use guideway_spline::Point;

use crate::text::Curve;

/// Decimals of coordinates: a thousandth of a pixel.
const DECIMALS: usize = 3;
/// Decimals of factors. Derived: a page of 65,535 pixels is off by less than a pixel.
pub(super) const FACTOR_DECIMALS: usize = 6;

/// The state in effect, which is not selected again.
#[derive(Clone, Default)]
struct State {
    /// Name of the graphics state.
    name: String,
    color: [String; 2],
    width: String,
}

/// A content stream.
pub(super) struct Content {
    out: ZlibEncoder<Vec<u8>>,
    state: State,
    /// The states to return to, outermost first.
    saved: Vec<State>,
    /// End of the last segment of an open path.
    end: Option<Point<f64>>,
}

impl Default for Content {
    fn default() -> Self {
        Self {
            out: ZlibEncoder::new(Vec::new(), Compression::default()),
            state: State::default(),
            saved: Vec::new(),
            end: None,
        }
    }
}

impl Content {
    /// The compressed stream.
    pub(super) fn finish(self) -> io::Result<Vec<u8>> {
        self.out.finish()
    }

    /// Writes operators without operands.
    pub(super) fn operator(&mut self, text: &str) -> io::Result<()> {
        self.end = None;
        writeln!(self.out, "{text}")
    }

    /// Saves the state, which [`Self::restore`] returns to.
    pub(super) fn save(&mut self) -> io::Result<()> {
        self.saved.push(self.state.clone());
        self.operator("q")
    }

    /// Returns to the state that was saved last.
    pub(super) fn restore(&mut self) -> io::Result<()> {
        self.state = self.saved.pop().unwrap_or_default();
        self.operator("Q")
    }

    /// Writes an operator after its operands; a color only if it is another one.
    pub(super) fn numbers(&mut self, numbers: &[f64], operator: &str) -> io::Result<()> {
        let text = operands(numbers, FACTOR_DECIMALS) + operator;
        let color = match operator {
            "RG" => Some(0),
            "rg" => Some(1),
            _ => None,
        };
        if let Some(color) = color.map(|color| &mut self.state.color[color]) {
            if *color == text {
                return Ok(());
            }
            color.clone_from(&text);
        }
        writeln!(self.out, "{text}")
    }

    /// Selects a graphics state by its name.
    pub(super) fn state(&mut self, name: &str) -> io::Result<()> {
        if self.state.name != name {
            name.clone_into(&mut self.state.name);
            write!(self.out, "/{name} gs ")?;
        }
        Ok(())
    }

    /// Selects the width of lines.
    pub(super) fn width(&mut self, width: f64) -> io::Result<()> {
        let text = operands(&[width], DECIMALS) + "w";
        if self.state.width != text {
            writeln!(self.out, "{text}")?;
            self.state.width = text;
        }
        Ok(())
    }

    /// Begins a part of a path, unless the last one ends here.
    pub(super) fn move_on(&mut self, to: Point<f64>) -> io::Result<()> {
        let is_on = |end: Point<f64>| end.distance(to) <= 10f64.powi(-(DECIMALS as i32));
        match self.end.is_some_and(is_on) {
            true => Ok(()),
            false => self.points(&[to], "m"),
        }
    }

    pub(super) fn curve(&mut self, b: Point<f64>, c: Point<f64>, d: Point<f64>) -> io::Result<()> {
        self.points(&[b, c, d], "c")
    }

    /// A closed polygon.
    pub(super) fn polygon(&mut self, corners: &[Point<f64>]) -> io::Result<()> {
        for (i, corner) in corners.iter().enumerate() {
            self.points(&[*corner], if i == 0 { "m" } else { "l" })?;
        }
        write!(self.out, "h ")
    }

    /// The outline of a letter. Returns `false` if it has none.
    pub(super) fn glyph(&mut self, curves: &[Curve]) -> io::Result<bool> {
        self.end = None;
        for curve in curves {
            let point = |at: usize, of: &[ab_glyph_rasterizer::Point]| {
                Point::new(f64::from(of[at].x), f64::from(of[at].y))
            };
            match curve {
                Curve::Line(of) => {
                    self.move_on(point(0, of))?;
                    self.points(&[point(1, of)], "l")?;
                }
                Curve::Quad(of) => {
                    let [a, b, c] = [0, 1, 2].map(|at| point(at, of));
                    self.move_on(a)?;
                    // A quadratic curve, raised to a cubic one.
                    let toward = |from: Point<f64>| from + (b - from) * (2.0 / 3.0);
                    self.curve(toward(a), toward(c), c)?;
                }
                Curve::Cubic(of) => {
                    let [a, b, c, d] = [0, 1, 2, 3].map(|at| point(at, of));
                    self.move_on(a)?;
                    self.curve(b, c, d)?;
                }
            }
        }
        Ok(!curves.is_empty())
    }

    fn points(&mut self, points: &[Point<f64>], operator: &str) -> io::Result<()> {
        self.end = points.last().copied();
        for point in points {
            write!(self.out, "{}", operands(&[point.x, point.y], DECIMALS))?;
        }
        write!(self.out, "{operator} ")
    }
}

/// Numbers, each with a space behind it. PDF knows no exponents.
pub(super) fn operands(numbers: &[f64], decimals: usize) -> String {
    let mut text = String::new();
    for number in numbers {
        let digits = format!("{number:.decimals$}");
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        text += match digits {
            "-0" => "0",
            digits => digits,
        };
        text.push(' ');
    }
    text
}
