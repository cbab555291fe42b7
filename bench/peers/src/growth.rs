//! Growth: frame times of all renderers against the number of paths, as JSON lines and an SVG plot.

use std::fmt::Write as _;
use std::fs;

use anyhow::Result;
use serde_json::json;

use crate::{data, draw, times};

/// Numbers of paths, in steps of about a factor of three.
const PATHS: [usize; 9] = [
    1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000, 10_000_000,
];
/// A renderer that takes longer for a frame draws no larger layout.
const MAX_MS: f64 = 1_000.0;
const COLORS: [&str; 11] = [
    "#0b57d0", "#c2410c", "#a16207", "#15803d", "#0f766e", "#7e22ce", "#be185d", "#334155",
    "#0891b2", "#dc2626", "#65a30d",
];

/// Draws layouts of increasing size with all methods, prints one JSON line each, and writes a plot
/// of frame times to `svg`.
pub(crate) fn run(svg: &str) -> Result<()> {
    let mut curves: Vec<(&str, Vec<(usize, f64)>)> = Vec::new();
    curves.extend(
        draw::METHODS
            .iter()
            .map(|(method, _)| (*method, Vec::new())),
    );
    for paths in PATHS {
        let layout = data::layout("d1", paths)?;
        for (method, curve) in &mut curves {
            if curve.last().is_some_and(|&(_, ms)| ms > MAX_MS) {
                continue;
            }
            let (view, mut frame) = data::view(&layout)?;
            let times_ms = draw::draw(method, &layout, &view, &mut frame)?;
            let ms = times::median_after_first_ms(&times_ms);
            println!(
                "{}",
                json!({
                    "method": method,
                    "paths": paths,
                    "first_frame_ms": times_ms[0],
                    "frame_ms": ms,
                })
            );
            curve.push((paths, ms));
        }
    }
    Ok(fs::write(svg, plot(&curves))?)
}

/// SVG with logarithmic axes: 1e3 to 1e7 paths, 0.1 to 1e4 milliseconds.
fn plot(curves: &[(&str, Vec<(usize, f64)>)]) -> String {
    let x = |paths: f64| 70.0 + (paths.log10() - 3.0) * 130.0;
    let y = |ms: f64| 330.0 - (ms.log10() + 1.0) * 62.0;
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 390\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"760\" height=\"390\" fill=\"white\"/>\n\
         <text x=\"330\" y=\"378\" text-anchor=\"middle\">paths</text>\n\
         <text x=\"14\" y=\"14\">milliseconds per frame</text>\n",
    );
    let mut add = |line: std::fmt::Arguments<'_>| {
        // Writing to a string cannot fail.
        _ = svg.write_fmt(line);
    };
    for decade in 3..=7 {
        let at = x(10_f64.powi(decade));
        add(format_args!(
            "<path d=\"M{at} 20V330\" stroke=\"#ddd\"/>\
             <text x=\"{at}\" y=\"350\" text-anchor=\"middle\">10\
             <tspan dy=\"-5\" font-size=\"9\">{decade}</tspan></text>\n"
        ));
    }
    for decade in -1..=4 {
        let ms = 10_f64.powi(decade);
        let at = y(ms);
        add(format_args!(
            "<path d=\"M70 {at}H590\" stroke=\"#ddd\"/>\
             <text x=\"62\" y=\"{}\" text-anchor=\"end\">{ms}</text>\n",
            at + 4.0
        ));
    }
    for (row, (method, points)) in curves.iter().enumerate() {
        let color = COLORS[row % COLORS.len()];
        let vertices = points.iter().map(|&(paths, ms)| (x(paths as f64), y(ms)));
        let line: Vec<_> = vertices.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        add(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n\
             <text x=\"604\" y=\"{}\" fill=\"{color}\">{method}</text>\n",
            line.join(" "),
            30 + 18 * row
        ));
    }
    svg + "</svg>\n"
}
