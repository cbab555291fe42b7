//! The picture of findings: paths with errors in red and with warnings in orange over the others in
//! gray, and a ring with the kind of the finding at each place.

use std::f64::consts::TAU;
use std::sync::Arc;

use guideway::compose::{Decorations, Picture, Rendered};
use guideway::document::{Element, locate};
use guideway::layout::{Diagnostics, Layout, Severity, UserError};
use guideway::scene::{DrawList, FrameSize, LineRule, Rgba, Scene, SceneOptions, TextLine, View};
use guideway::spline::{Bounds, Point};

use super::findings::SeverityCounts;
use super::holder::Holders;
use crate::cli::output::Output;
use crate::cli::picture_file::OTHER_PATHS;
use crate::cli::picture_output::PictureOutput;
use crate::cli::text;

/// Radius of a ring and half its thickness, in points.
const RING_POINTS: [f64; 2] = [9.0, 1.25];
/// Height of the texts, in points.
const TEXT_POINTS: f64 = 12.0;
/// Corners of a ring. Derived: it differs from a circle by less than a fifth of a point.
const RING_CORNERS: usize = 24;

/// A place with findings.
struct Spot {
    at_px: Point<f64>,
    severity: Severity,
    /// Kinds of the findings, each with its number.
    kinds: Vec<(&'static str, usize)>,
}

/// Draws the errors and warnings of a layout that name an element, or its notes. Everything that no
/// finding names is gray.
pub(crate) fn write(
    mut layout: Layout,
    found: &Diagnostics,
    name: &str,
    output: &PictureOutput<'_>,
    out: &Output,
) -> Result<Rendered, UserError> {
    let progress = out.progress("drawing the findings");
    // Notes hide what is wrong, unless there is nothing else.
    let least = match found.count_at_least(Severity::Warning) {
        0 => Severity::Info,
        _ => Severity::Warning,
    };
    let shown = || found.iter().filter(|f| f.severity >= least);
    let holders = Holders::of(&layout);
    let element = |place| locate(&layout, place).or_else(|| holders.holder(place));
    let mut located: Vec<(Element, Severity, &'static str)> = shown()
        .filter_map(|f| Some((element(&f.place)?, f.severity, f.code.name())))
        .collect();
    located.sort_by_key(|(_, severity, _)| std::cmp::Reverse(*severity));
    let elsewhere = match shown().count() - located.len() {
        0 => String::new(),
        count => format!(", {count} at no element"),
    };
    let mut styles = vec![(OTHER_PATHS, 0); layout.paths.len()];
    for &(element, severity, _) in &located {
        if let Element::Path(row) = element {
            let style = (color(severity).to_u32(), rank(severity));
            let old = &mut styles[row as usize];
            *old = if style.1 > old.1 { style } else { *old };
        }
    }
    let (colors, ranks) = styles.into_iter().unzip();
    layout.paths.set_color_rgba(colors);
    layout.paths.set_rank(ranks);
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default())?;
    let mut picture = Picture::new(Arc::new(scene), FrameSize::new(1920, 1080)?);
    picture.style.line_rule = LineRule::World {
        width_m: 0.0,
        min_px: 2.0,
        max_px: 12.0,
    };
    let SeverityCounts {
        errors, warnings, ..
    } = SeverityCounts::of(std::iter::once(found));
    let (errors, warnings) = (
        text::counted(errors, "error"),
        text::counted(warnings, "warning"),
    );
    picture.decorations = Decorations {
        has_scale_bar: true,
        title: Some(format!(
            "{name}: {errors} (red), {warnings} (orange){elsewhere}"
        )),
        ..Decorations::default()
    };
    let view = picture.view()?;
    picture.overlay = rings(&spots(picture.scene.layout(), &located, &view), &view);
    output.write(&picture, &progress)
}

fn color(severity: Severity) -> Rgba {
    match severity {
        Severity::Error => Rgba::opaque(214, 39, 40),
        Severity::Warning => Rgba::opaque(224, 120, 0),
        Severity::Info => Rgba::opaque(60, 110, 190),
    }
}

fn rank(severity: Severity) -> i32 {
    match severity {
        Severity::Error => 3,
        Severity::Warning => 2,
        Severity::Info => 1,
    }
}

/// The places of findings in a view, those that are near each other as one.
fn spots(layout: &Layout, located: &[(Element, Severity, &'static str)], view: &View) -> Vec<Spot> {
    /// Places in a picture that has more are not told apart.
    const MOST: usize = 2_000;
    let near_px = 2.0 * RING_POINTS[0];
    let mut spots: Vec<Spot> = Vec::new();
    for &(element, severity, kind) in located {
        let Some(at_m) = position(layout, element) else {
            continue;
        };
        let at_px = view.pixel_from_world(at_m);
        let near = spots
            .iter_mut()
            .find(|spot| spot.at_px.distance(at_px) < near_px);
        if let Some(spot) = near {
            spot.severity = spot.severity.max(severity);
            match spot.kinds.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, count)) => *count += 1,
                None => spot.kinds.push((kind, 1)),
            }
        } else if spots.len() < MOST {
            spots.push(Spot {
                at_px,
                severity,
                kinds: vec![(kind, 1)],
            });
        }
    }
    spots
}

/// The middle of a path, or the position of a node or station; for a station without one, that of
/// its first node.
fn position(layout: &Layout, element: Element) -> Option<Point<f64>> {
    match element {
        Element::Path(row) => {
            let path = layout.paths.get(row as usize);
            path.point_at(path.length_m() / 2.0)
        }
        Element::Node(row) => Some(layout.nodes.position_m(row)),
        Element::Station(row) => layout.station_position_m(row),
    }
}

/// A ring per place, and its kinds of findings where they have room.
fn rings(spots: &[Spot], view: &View) -> DrawList {
    let mut list = DrawList::default();
    let reach = Point::new(RING_POINTS[0], RING_POINTS[0]);
    let ring_box = |spot: &Spot| Bounds {
        min: spot.at_px - reach,
        max: spot.at_px + reach,
    };
    let mut taken: Vec<Bounds<f64>> = spots.iter().map(ring_box).collect();
    for spot in spots {
        let ink = color(spot.severity);
        let [radius_px, half_px] = RING_POINTS;
        let corner = |i: usize, radius: f64| {
            let angle = TAU * i as f64 / RING_CORNERS as f64;
            spot.at_px + Point::new(angle.cos(), angle.sin()) * radius
        };
        for i in 0..RING_CORNERS {
            let [inner, outer] = [radius_px - half_px, radius_px + half_px];
            let part = [
                corner(i, inner),
                corner(i + 1, inner),
                corner(i + 1, outer),
                corner(i, outer),
            ];
            list.fill_polygon(ink, &part);
        }
        let kinds = spot.kinds.iter().map(|(kind, count)| match count {
            1 => (*kind).to_owned(),
            count => format!("{kind} x{count}"),
        });
        let mut text = TextLine {
            text: kinds.collect::<Vec<_>>().join(", "),
            left_middle_px: spot.at_px + Point::new(radius_px + 4.0, 0.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: TEXT_POINTS * TextLine::CHAR_ASPECT,
            color: ink,
            halo: Rgba::WHITE.with_opacity(0.85),
        };
        let width_px = text.width_px();
        if text.left_middle_px.x + width_px > f64::from(view.size().width()) {
            text.left_middle_px.x = spot.at_px.x - radius_px - 4.0 - width_px;
        }
        let half = Point::new(0.0, 0.6 * TEXT_POINTS);
        let bounds = Bounds {
            min: text.left_middle_px - half,
            max: text.left_middle_px + half + Point::new(width_px, 0.0),
        };
        if !taken.iter().any(|other| other.intersects(bounds)) {
            taken.push(bounds);
            list.texts.push(text);
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_station_without_a_position_has_its_ring_at_its_node() {
        let mut layout = Layout::default();
        let at = Point::new(3.0, 4.0);
        let node = layout.nodes.push("a", at, None);
        let on_node = layout.stations.push("dock", None, vec![node], None);
        let lost = layout.stations.push("lost", None, Vec::new(), None);
        let at_own = Point::new(5.0, 4.0);
        let own = layout.stations.push("own", Some(at_own), vec![node], None);
        let position = |row| position(&layout, Element::Station(row));
        assert_eq!(
            [on_node, lost, own].map(position),
            [Some(at), None, Some(at_own)]
        );
    }
}
