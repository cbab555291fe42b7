//! Writes paths and draw lists as elements of a page of vector graphics.

use std::io;

use guideway_layout::PathRef;
use guideway_scene::{DrawList, Legend, Report, Scene, Shading, Style, View};
use guideway_spline::{Bounds, Point};

use crate::density_image::write_density;
use crate::page::Page;

/// The paths that were written.
pub(crate) struct WrittenPaths {
    /// Number of paths in the view.
    pub(crate) drawn: u64,
    /// Meaning of the colors of density shading.
    pub(crate) density: Option<Legend>,
}

/// Writes the paths of a scene in draw order, or their density as an image.
fn write_paths(
    scene: &Scene,
    view: &View,
    style: &Style,
    page: &mut impl Page,
) -> io::Result<WrittenPaths> {
    if style.shading != Shading::Color {
        let Report { drawn, density, .. } = write_density(scene, view, style, page)?;
        return Ok(WrittenPaths { drawn, density });
    }
    let mut drawn = 0;
    for &path in scene.draw_order() {
        let width_px = width_px(scene, path, view, style);
        let outline = outline(scene, path, view, width_px);
        drawn += u64::from(!outline.is_empty());
        let id = scene.layout().paths.id(path as usize);
        let id = (!id.is_empty()).then_some(id);
        page.path(id, &outline, scene.color(path), width_px)?;
    }
    Ok(WrittenPaths {
        drawn,
        density: None,
    })
}

/// Writes the paths of a scene as a group of this opacity, from 0 to 1; without a group if they are
/// opaque.
pub(crate) fn write_faded_paths(
    scene: &Scene,
    view: &View,
    style: &Style,
    opacity: f64,
    page: &mut impl Page,
) -> io::Result<WrittenPaths> {
    if opacity >= 1.0 {
        return write_paths(scene, view, style, page);
    }
    page.begin_group("paths", opacity.max(0.0))?;
    let written = write_paths(scene, view, style, page)?;
    page.end_group()?;
    Ok(written)
}

/// Stroke width of a path in a view, in pixels.
pub(crate) fn width_px(scene: &Scene, path: u32, view: &View, style: &Style) -> f64 {
    2.0 * style
        .line_rule
        .radius_px(scene.width_m(path), view.px_per_m())
}

/// The segments of a path whose stroke may reach into a view, in its pixels.
pub(crate) fn outline(
    scene: &Scene,
    path: u32,
    view: &View,
    width_px: f64,
) -> Vec<[Point<f64>; 4]> {
    let size = view.size();
    let shown = Bounds {
        min: Point::default(),
        max: Point::new(f64::from(size.width()), f64::from(size.height())),
    };
    let shown = shown.inflated(width_px / 2.0);
    let path: PathRef<'_> = scene.layout().paths.get(path as usize);
    let segments = path.runs().flat_map(|run| run.segments());
    let segments = segments.map(|segment| segment.map(|p| view.pixel_from_world(p)));
    let is_near = |segment: &[Point<f64>; 4]| {
        let hull = Bounds::of_points(*segment);
        hull.is_some_and(|hull| hull.intersects(shown))
    };
    segments.filter(is_near).collect()
}

/// Writes a draw list as a group with this label; an empty list writes nothing.
pub(crate) fn write_draw_list(
    list: &DrawList,
    label: &str,
    page: &mut impl Page,
) -> io::Result<()> {
    if list.is_empty() {
        return Ok(());
    }
    page.begin_group(label, 1.0)?;
    for fill in &list.fills {
        page.areas(label, fill.color, std::slice::from_ref(&fill.polygons))?;
    }
    for text in &list.texts {
        page.text(text)?;
    }
    page.end_group()
}

#[cfg(test)]
mod tests {
    use guideway_formats::svg::{Stroke, SvgWriter};
    use guideway_scene::{Rgba, TextLine};

    use super::*;

    #[test]
    fn writes_fills_and_texts_as_elements() {
        let mut list = DrawList::default();
        let (a, b) = (Point::new(10.0, 60.0), Point::new(20.0, 80.0));
        list.fill_rectangle(Rgba::opaque(255, 0, 0), a, b);
        list.texts.push(TextLine {
            text: "lé漢".into(),
            left_middle_px: Point::new(40.0, 64.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: 12.0,
            color: Rgba::BLACK,
            halo: Rgba::opaque(0, 255, 0),
        });
        let mut out = Vec::new();
        let common = Stroke::new(0xFF, 1.0);
        let mut page = SvgWriter::begin(&mut out, [0.0, 0.0, 100.0, 128.0], "", &common).unwrap();
        write_draw_list(&list, "marks", &mut page).unwrap();
        write_draw_list(&DrawList::default(), "nothing", &mut page).unwrap();
        page.finish().unwrap();
        let text = String::from_utf8(out).unwrap();
        for part in ["lé漢", "#ff0000", "#00ff00", "marks", "M10 60"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(!text.contains("nothing"));
    }
}
