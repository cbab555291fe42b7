//! A view as SVG: the same paths in the same order, colors and widths, as true curves.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use guideway::formats::svg::{Outline, Page, Stroke};
use guideway::layout::PathRef;
use guideway::render::{DrawList, MethodInfo, Report, Shading, Style, View};
use guideway::scene::Scene;
use guideway::spline::{Bounds, Point};
use guideway::{SaveError, replace_file};

use super::below::{Below, Seen};
use super::{Drawn, Wishes, legend, picture, sheet};
use crate::cli::Failure;

/// Steps of coordinates, in pixels.
pub(super) const STEP_PX: f64 = 1e-3;

/// Ending of the names of such files.
const ENDING: &str = "svg";

pub(super) fn is_wanted(output: &Path) -> bool {
    let ending = output.extension().unwrap_or_default();
    ending.eq_ignore_ascii_case(ENDING)
}

/// Writes a view of a scene as a file.
pub(crate) fn draw(
    output: &Path,
    scene: &Scene,
    below: &Below,
    wishes: &Wishes,
) -> Result<Drawn, Failure> {
    if wishes.style.shading != Shading::Color {
        return Err(Failure::arguments(
            "an SVG picture has the colors of paths, not how many there are",
            "Leave --shade out, or save the picture as PNG",
        ));
    }
    let view = picture::view(scene, below, wishes)?;
    let seen = below.seen(scene, &view)?;
    let (legend, has_no_room) = legend::wished(scene, wishes);
    let drawn = replace_file(output, |file| {
        let written = File::create(file).and_then(|file| {
            let mut out = BufWriter::with_capacity(1 << 16, file);
            let drawn = write(&mut out, scene, &view, &seen, &legend, wishes)?;
            out.flush()?;
            Ok(drawn)
        });
        written.map_err(|problem| SaveError {
            path: output.to_owned(),
            problem,
        })
    })?;
    let mut report = Report::of(ENDING, scene, drawn);
    report.notes.extend(has_no_room);
    Ok(Drawn {
        view,
        report,
        method: MethodInfo {
            name: ENDING,
            summary: "curves, for whatever shows them to draw",
            device: "none".to_owned(),
        },
        swept: seen.report(),
        prepare_ms: 0.0,
        render_ms: 0.0,
        write_ms: 0.0,
    })
}

/// Writes all; returns how many paths can be seen.
fn write(
    out: &mut impl Write,
    scene: &Scene,
    view: &View,
    below: &Seen<'_>,
    legend: &DrawList,
    wishes: &Wishes,
) -> io::Result<u64> {
    let size = view.size();
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let first = scene.draw_order().first();
    let common = first.map_or(Stroke::of(0xFF, 1.0), |&path| {
        Stroke::of(
            scene.color(path).to_u32(),
            width_px(scene, path, view, &wishes.style),
        )
    });
    let attributes = format!(r#"width="{width}" height="{height}""#);
    let mut page = Page::begin(out, [0.0, 0.0, width, height], &attributes, &common)?;
    let background = wishes.style.background;
    if background.a > 0 {
        page.area([0.0, 0.0, width, height], background.to_u32())?;
    }
    below.write(view, &wishes.style, &mut page)?;
    let drawn = write_paths(scene, view, &wishes.style, &mut page)?;
    sheet::write(&wishes.marks, "marks", &mut page)?;
    sheet::write(legend, "legend", &mut page)?;
    page.end()?;
    Ok(drawn)
}

fn width_px(scene: &Scene, path: u32, view: &View, style: &Style) -> f64 {
    2.0 * style
        .line_rule
        .radius_px(scene.width_m(path), view.px_per_m())
}

/// Writes the paths of a scene; returns how many can be seen.
pub(super) fn write_paths(
    scene: &Scene,
    view: &View,
    style: &Style,
    page: &mut Page<'_, impl Write>,
) -> io::Result<u64> {
    let mut drawn = 0;
    for &path in scene.draw_order() {
        let width_px = width_px(scene, path, view, style);
        let outline = outline(scene, path, view, width_px);
        drawn += u64::from(!outline.is_empty());
        let stroke = Stroke::of(scene.color(path).to_u32(), width_px);
        page.path(scene.layout().paths.id(path as usize), &outline, &stroke)?;
    }
    Ok(drawn)
}

/// What of a path may leave a mark in a view, in its pixels.
pub(super) fn outline(scene: &Scene, path: u32, view: &View, width_px: f64) -> Outline {
    let size = view.size();
    let seen = Bounds {
        min: Point::default(),
        max: Point::new(f64::from(size.width()), f64::from(size.height())),
    };
    let seen = seen.inflated(width_px / 2.0);
    let mut outline = Outline::new(STEP_PX);
    let path: PathRef<'_> = scene.layout().paths.get(path as usize);
    for segment in path.runs().flat_map(|run| run.segments()) {
        let segment = segment.map(|p| view.pixel_from_world(p));
        let hull = Bounds::of_points(segment);
        if hull.is_some_and(|hull| hull.intersects(seen)) {
            outline.push(&segment);
        }
    }
    outline
}
