//! Writes paths and draw lists as SVG elements.

use std::io::{self, Write};

use guideway_formats::svg::{PathData, Stroke, SvgWriter};
use guideway_layout::PathRef;
use guideway_scene::{DrawList, Scene, Style, TextLine, View};
use guideway_spline::{Bounds, Point};

/// Step of coordinates, in pixels: far below what a viewer can show.
pub(crate) const STEP_PX: f64 = 1e-3;

/// Writes the paths of a scene in draw order. Returns the number of paths in the view.
pub(crate) fn write_paths(
    scene: &Scene,
    view: &View,
    style: &Style,
    page: &mut SvgWriter<'_, impl Write>,
) -> io::Result<u64> {
    let mut drawn = 0;
    for &path in scene.draw_order() {
        let width_px = width_px(scene, path, view, style);
        let outline = outline(scene, path, view, width_px);
        drawn += u64::from(!outline.is_empty());
        let stroke = Stroke::new(scene.color(path).to_u32(), width_px);
        page.path(scene.layout().paths.id(path as usize), &outline, &stroke)?;
    }
    Ok(drawn)
}

/// Stroke width of a path in a view, in pixels.
pub(crate) fn width_px(scene: &Scene, path: u32, view: &View, style: &Style) -> f64 {
    2.0 * style
        .line_rule
        .radius_px(scene.width_m(path), view.px_per_m())
}

/// The segments of a path whose stroke may reach into a view, in its pixels.
pub(crate) fn outline(scene: &Scene, path: u32, view: &View, width_px: f64) -> PathData {
    let size = view.size();
    let shown = Bounds {
        min: Point::default(),
        max: Point::new(f64::from(size.width()), f64::from(size.height())),
    };
    let shown = shown.inflated(width_px / 2.0);
    let mut outline = PathData::new(STEP_PX);
    let path: PathRef<'_> = scene.layout().paths.get(path as usize);
    for segment in path.runs().flat_map(|run| run.segments()) {
        let segment = segment.map(|p| view.pixel_from_world(p));
        let hull = Bounds::of_points(segment);
        if hull.is_some_and(|hull| hull.intersects(shown)) {
            outline.push_segment(&segment);
        }
    }
    outline
}

/// Writes a draw list as a group with this label; an empty list writes nothing.
pub(crate) fn write_draw_list(
    list: &DrawList,
    label: &str,
    page: &mut SvgWriter<'_, impl Write>,
) -> io::Result<()> {
    if list.is_empty() {
        return Ok(());
    }
    page.begin_group(label)?;
    for fill in &list.fills {
        page.polygon_layer(label, fill.color.to_u32(), STEP_PX, [&fill.polygons])?;
    }
    for text in &list.texts {
        let height = text.char_width_px / TextLine::CHAR_ASPECT;
        let width = text.width_px();
        if text.background.a > 0 {
            let corner = text.left_middle_px - Point::new(0.0, 0.6 * height);
            let rectangle = [corner.x, corner.y, width, 1.2 * height];
            page.rect(rectangle, text.background.to_u32())?;
        }
        // From the middle of a line to its baseline: half the height of a capital.
        let at = text.left_middle_px + Point::new(0.0, 0.35 * height);
        page.text([at.x, at.y], height, width, text.color.to_u32(), &text.text)?;
    }
    page.end_group()
}

#[cfg(test)]
mod tests {
    use guideway_scene::Rgba;

    use super::*;

    #[test]
    fn writes_fills_and_texts_as_elements() {
        let mut list = DrawList::default();
        let (a, b) = (Point::new(10.0, 60.0), Point::new(20.0, 80.0));
        list.fill_rectangle(Rgba::opaque(255, 0, 0), a, b);
        list.texts.push(TextLine {
            text: "lé漢".into(),
            left_middle_px: Point::new(40.0, 64.0),
            char_width_px: 12.0,
            color: Rgba::BLACK,
            background: Rgba::opaque(0, 255, 0),
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
