//! Draws line charts as SVG with the colors of the style sheet of the page.

use guideway_bench::format::digits;
use guideway_bench::page::escape;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 340.0;
/// Margins for the axes and their labels, in pixels.
const LEFT: f64 = 64.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 46.0;
/// Ratio of largest to smallest value above which the axis is logarithmic.
const LOG_RATIO: f64 = 60.0;
/// Number of line classes in the style sheet.
const STYLES: usize = 14;

/// A line chart of non-negative values.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x_label: &'static str,
    pub(crate) y_label: &'static str,
    pub(crate) series: Vec<Series>,
}

/// One line with its points from left to right.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
}

/// Maps the values of one axis to positions from 0 to 1.
struct Axis {
    from: f64,
    to: f64,
    is_log: bool,
    ticks: Vec<f64>,
}

impl Axis {
    fn linear(most: f64) -> Self {
        let step = round_up(most / 6.0);
        let count = (most / step - 1e-9).ceil().clamp(1.0, 20.0) as usize;
        Self {
            from: 0.0,
            to: step * count as f64,
            is_log: false,
            ticks: (0..=count).map(|i| step * i as f64).collect(),
        }
    }

    fn log(least: f64, most: f64) -> Self {
        let (low, high) = (least.log10().floor() as i32, most.log10().ceil() as i32);
        Self {
            from: 10_f64.powi(low),
            to: 10_f64.powi(high.max(low + 1)),
            is_log: true,
            ticks: (low..=high.max(low + 1))
                .map(|power| 10_f64.powi(power))
                .collect(),
        }
    }

    /// Position of a value: 0 at the start, 1 at the end.
    fn position(&self, value: f64) -> f64 {
        if self.is_log {
            (value.max(self.from) / self.from).ln() / (self.to / self.from).ln()
        } else {
            (value - self.from) / (self.to - self.from)
        }
    }
}

/// The smallest 1, 2, 2.5 or 5 times a power of ten that is at least `value`.
fn round_up(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    let factors = [1.0, 2.0, 2.5, 5.0];
    let factor = factors
        .into_iter()
        .find(|f| f * power >= value * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

impl Chart {
    /// Returns `true` if no series has a point.
    pub(crate) fn is_empty(&self) -> bool {
        self.series.iter().all(|series| series.points.is_empty())
    }

    /// The chart as an HTML figure; an empty string for an empty chart.
    pub(crate) fn html(&self) -> String {
        if self.is_empty() {
            return String::new();
        }
        let title = escape(&self.title);
        format!(
            "<figure><figcaption>{title}</figcaption>\n{}{}</figure>\n",
            self.svg(),
            self.legend()
        )
    }

    fn values(&self) -> impl Iterator<Item = (f64, f64)> {
        self.series
            .iter()
            .flat_map(|series| series.points.iter().copied())
    }

    fn axes(&self) -> (Axis, Axis) {
        let most = |of: fn((f64, f64)) -> f64| self.values().map(of).fold(0.0, f64::max);
        let positive = |value: f64| if value > 0.0 { value } else { 1.0 };
        let (x_most, y_most) = (positive(most(|p| p.0)), positive(most(|p| p.1)));
        let above_zero = self.values().map(|p| p.1).filter(|&y| y > 0.0);
        let y_least = above_zero.fold(y_most, f64::min);
        let y_axis = if y_most / y_least > LOG_RATIO {
            // At most six decades: smaller values would compress the rest of the chart.
            Axis::log(y_least.max(y_most * 1e-6), y_most)
        } else {
            Axis::linear(y_most)
        };
        (Axis::linear(x_most), y_axis)
    }

    fn svg(&self) -> String {
        let (x_axis, y_axis) = self.axes();
        let x = |value: f64| LEFT + x_axis.position(value) * (WIDTH - LEFT - RIGHT);
        let y = |value: f64| HEIGHT - BOTTOM - y_axis.position(value) * (HEIGHT - TOP - BOTTOM);
        let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
             role=\"img\" aria-label=\"{}\">\n",
            escape(&self.title)
        );
        for &tick in &y_axis.ticks {
            let (at, label) = (y(tick), label(tick));
            svg += &format!(
                "<line class=\"grid\" x1=\"{LEFT}\" y1=\"{at:.1}\" x2=\"{right}\" \
                 y2=\"{at:.1}\"/>\n"
            );
            svg += &format!(
                "<text class=\"y\" x=\"{}\" y=\"{:.1}\">{label}</text>\n",
                LEFT - 8.0,
                at + 4.0
            );
        }
        for &tick in &x_axis.ticks {
            let (at, label) = (x(tick), label(tick));
            svg += &format!(
                "<text class=\"x\" x=\"{at:.1}\" y=\"{}\">{label}</text>\n",
                bottom + 18.0
            );
        }
        svg += &format!(
            "<text class=\"x\" x=\"{}\" y=\"{}\">{}</text>\n",
            f64::midpoint(LEFT, right),
            HEIGHT - 8.0,
            escape(self.x_label)
        );
        svg += &format!(
            "<text class=\"x\" transform=\"translate(14 {}) rotate(-90)\">{}{}</text>\n",
            f64::midpoint(TOP, bottom),
            escape(self.y_label),
            if y_axis.is_log { ", logarithmic" } else { "" }
        );
        for (i, series) in self.series.iter().enumerate() {
            let class = format!("s{}", i % STYLES);
            let points = series.points.iter();
            let positions: Vec<String> = points
                .map(|p| format!("{:.1},{:.1}", x(p.0), y(p.1)))
                .collect();
            svg += &format!(
                "<polyline class=\"{class}\" points=\"{}\"/>\n",
                positions.join(" ")
            );
            for point in &series.points {
                svg += &format!(
                    "<circle class=\"{class}\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\"><title>{}: {} \
                     at {}</title></circle>\n",
                    x(point.0),
                    y(point.1),
                    escape(&series.name),
                    digits(point.1),
                    label(point.0)
                );
            }
        }
        svg += "</svg>\n";
        svg
    }

    fn legend(&self) -> String {
        let mut html = String::from("<ul class=\"legend\">\n");
        for (i, series) in self.series.iter().enumerate() {
            let class = i % STYLES;
            html += &format!(
                "<li><svg viewBox=\"0 0 28 10\" width=\"28\" height=\"10\" aria-hidden=\"true\">\
                 <polyline class=\"s{class}\" points=\"0,5 28,5\"/>\
                 <circle class=\"s{class}\" cx=\"14\" cy=\"5\" r=\"3.5\"/></svg> {}</li>\n",
                escape(&series.name)
            );
        }
        html + "</ul>\n"
    }
}

/// Short label of a number on an axis: 0, 2.5, 90k, 1M.
fn label(value: f64) -> String {
    let short = |value: f64, unit: &str| {
        // Ticks are sums of steps with rounding errors.
        let text = format!("{value:.6}");
        format!("{}{unit}", text.trim_end_matches('0').trim_end_matches('.'))
    };
    if value >= 1e6 {
        short(value / 1e6, "M")
    } else if value >= 1e3 {
        short(value / 1e3, "k")
    } else {
        short(value, "")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: &[(f64, f64)]) -> Chart {
        Chart {
            title: "a < b".into(),
            x_label: "paths",
            y_label: "ms",
            series: vec![Series {
                name: "m & n".into(),
                points: points.to_vec(),
            }],
        }
    }

    #[test]
    fn points_have_positions_of_their_values() {
        let chart = chart(&[(0.0, 0.0), (100.0, 5.0), (200.0, 10.0)]);
        let html = chart.html();
        roxmltree::Document::parse(&html).expect("well-formed");
        let (left, right) = (LEFT, WIDTH - RIGHT);
        let (top, bottom) = (TOP, HEIGHT - BOTTOM);
        let middle = (f64::midpoint(left, right), f64::midpoint(top, bottom));
        let expected = format!(
            "{left:.1},{bottom:.1} {:.1},{:.1} {right:.1},{top:.1}",
            middle.0, middle.1
        );
        assert!(html.contains(&expected), "{expected} in {html}");
    }

    #[test]
    fn ticks_are_round_and_cover_all_values() {
        for most in [1e-3, 0.7, 1.0, 16.9, 99.0, 1_020_350.0] {
            let axis = Axis::linear(most);
            assert!(
                axis.to >= most * (1.0 - 1e-9) && axis.to < 2.0 * most,
                "{most}: {}",
                axis.to
            );
            assert!((3..=12).contains(&axis.ticks.len()), "{:?}", axis.ticks);
        }
        let axis = Axis::log(0.02, 300.0);
        assert_eq!(axis.ticks.len(), 6);
        assert!(axis.from <= 0.02 && axis.to >= 300.0);
        assert_eq!(
            [0.0, 0.3, 2.5, 90_000.0, 1.5e6].map(label),
            ["0", "0.3", "2.5", "90k", "1.5M"]
        );
    }

    #[test]
    fn the_style_sheet_has_every_line_class() {
        let sheet = guideway_bench::page::STYLE;
        assert!(STYLES >= crate::reproduce::METHODS.len());
        for style in 0..STYLES {
            assert!(sheet.contains(&format!("polyline.s{style} ")), "s{style}");
            assert!(sheet.contains(&format!("circle.s{style} ")), "s{style}");
            assert_eq!(
                sheet.matches(&format!("--c{style}:")).count(),
                2,
                "light and dark"
            );
        }
    }

    #[test]
    fn wide_ranges_are_logarithmic_and_extremes_finite() {
        assert!(
            chart(&[(1.0, 0.1), (2.0, 100.0)])
                .html()
                .contains("logarithmic")
        );
        assert!(
            !chart(&[(1.0, 10.0), (2.0, 100.0)])
                .html()
                .contains("logarithmic")
        );
        for points in [
            &[(0.0, 0.0)][..],
            &[(1e300, 1e300), (1.0, 1e-300)],
            &[(5.0, 3.0)],
        ] {
            let html = chart(points).html();
            roxmltree::Document::parse(&html).expect("well-formed");
            assert!(!html.contains("NaN") && !html.contains("inf"), "{html}");
        }
        assert_eq!(chart(&[]).html(), "");
    }
}
