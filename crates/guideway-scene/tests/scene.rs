//! Scenes built from layouts: draw order, colors, levels and legends.

use std::sync::Arc;

use guideway_layout::{Layout, Level, NewPath, OwnStyle, Quantity, Value};
use guideway_scene::density::{ToneMap, shade};
use guideway_scene::{
    ClassBreaks, ColorBy, Edit, Frame, FrameSize, Insertion, Palette, PathState, Rgba, Scene,
    SceneError, SceneOptions,
};
use guideway_spline::{Point, Runs};

fn layout(paths: usize) -> Layout {
    let mut layout = Layout::default();
    for level in ["ground", "upper"] {
        layout.levels.push(Level {
            id: level.to_owned(),
            ..Level::default()
        });
    }
    for i in 0..paths {
        let mut runs = Runs::default();
        runs.push_line(Point::new(i as f64, 0.0), Point::new(i as f64, 1.0));
        let id = format!("P{i}");
        layout.paths.push(&NewPath {
            id: &id,
            runs: &runs,
            level: Some((i % 2) as u32),
            ..NewPath::default()
        });
    }
    layout
}

fn scene(layout: Layout, options: &SceneOptions) -> Scene {
    Scene::new(Arc::new(layout), options).expect("options that fit the layout")
}

fn by(column: &str) -> SceneOptions {
    SceneOptions {
        color_by: Some(ColorBy {
            column: column.to_owned(),
        }),
        ..SceneOptions::default()
    }
}

#[test]
fn draw_order_is_rank_then_file_order() {
    let mut ranked = layout(5);
    ranked.paths.set_rank(vec![3, -1, 0, 3, 0]);
    assert_eq!(
        scene(ranked, &SceneOptions::default()).draw_order(),
        [1, 2, 4, 0, 3]
    );
    assert_eq!(
        scene(layout(3), &SceneOptions::default()).draw_order(),
        [0, 1, 2]
    );
}

#[test]
fn selecting_a_level_hides_the_others() {
    let options = SceneOptions {
        level: Some("upper".to_owned()),
        ..SceneOptions::default()
    };
    let upper = scene(layout(5), &options);
    assert_eq!(upper.draw_order(), [1, 3]);
    assert_eq!(upper.hidden_count(), 3);
    assert_eq!(upper.bounds().unwrap().max.x, 3.0);

    let options = SceneOptions {
        level: Some("cellar".to_owned()),
        ..SceneOptions::default()
    };
    let error = Scene::new(Arc::new(layout(1)), &options).unwrap_err();
    assert!(matches!(&error, SceneError::UnknownLevel { .. }));
    assert!(error.to_string().contains("ground, upper"), "{error}");
}

#[test]
fn levels_can_have_their_colors_in_common() {
    let mut speeds = layout(4);
    for (row, speed) in [1.0, 2.0, 2.0, 3.0].into_iter().enumerate() {
        let attributes = &mut speeds.paths.attributes;
        attributes.set(row, "speed", Value::Float(speed));
    }
    // Rows 1 and 2 have the same speed on two levels.
    let colors = |has_common_colors| {
        let of_level = |level: &str, row| {
            let options = SceneOptions {
                level: Some(level.to_owned()),
                has_common_colors,
                ..by("speed")
            };
            scene(speeds.clone(), &options).color(row)
        };
        [of_level("upper", 1), of_level("ground", 2)]
    };
    let [upper, ground] = colors(true);
    assert_eq!(upper, ground);
    let [upper, ground] = colors(false);
    assert_ne!(upper, ground, "each level counts its own paths");
}

#[test]
fn own_colors_override_the_default_color() {
    let mut colored = layout(2);
    colored.paths.set_color_rgba(vec![0xff00_00ff, 0]);
    let options = SceneOptions {
        color: Some(Rgba::opaque(1, 2, 3)),
        ..SceneOptions::default()
    };
    let colored = scene(colored, &options);
    assert_eq!(colored.color(0), Rgba::opaque(255, 0, 0));
    assert_eq!(colored.color(1), Rgba::opaque(1, 2, 3));
    assert!(colored.is_opaque());
}

#[test]
fn ignores_widths_that_are_negative_or_not_finite() {
    let mut wide = layout(3);
    wide.paths.set_width_m(vec![0.5, f32::NAN, -1.0]);
    let wide = scene(wide, &SceneOptions::default());
    assert_eq!([0, 1, 2].map(|p| wide.width_m(p)), [Some(0.5), None, None]);
}

#[test]
fn lists_the_most_frequent_classes_first() {
    let mut kinds = layout(30);
    for row in 0..29 {
        let kind = if row < 12 {
            "aisle".to_owned()
        } else {
            format!("kind {row}")
        };
        kinds.paths.attributes.set(row, "kind", Value::Text(&kind));
    }
    let scene = scene(kinds, &by("kind"));
    let legend = scene.legend().unwrap();
    assert_eq!(legend.entries[0].label, "aisle");
    assert_eq!(legend.entries[0].paths, Some(12));
    assert_eq!(legend.entries[0].color, scene.color(3));
    let labels: Vec<_> = legend.entries.iter().map(|e| e.label.as_str()).collect();
    assert_eq!(labels[7..], ["11 other values", "no value"]);
    assert_eq!(
        legend.entries.iter().filter_map(|e| e.paths).sum::<u64>(),
        30
    );
}

#[test]
fn few_distinct_numbers_form_classes_in_ascending_order() {
    let mut speeds = layout(6);
    for (row, speed) in [2.0, 10.0, 2.0, 0.5, 10.0, 10.0].into_iter().enumerate() {
        let attributes = &mut speeds.paths.attributes;
        attributes.set(row, "speed", Value::Float(speed));
    }
    let scene = scene(speeds, &by("speed"));
    let entries = &scene.legend().unwrap().entries;
    let read: Vec<_> = entries
        .iter()
        .map(|e| (e.label.as_str(), e.paths))
        .collect();
    assert_eq!(read, [("0.5", Some(1)), ("2", Some(2)), ("10", Some(3))]);
    assert_eq!(scene.color(3), entries[0].color);
}

#[test]
fn legend_names_the_unit_of_values_per_vehicle_type() {
    let mut layout = Layout::default();
    layout.paths.push(&NewPath {
        vehicle_types: &["tug", "fork"],
        ..NewPath::default()
    });
    let entries = &mut layout.paths.vehicle_types_mut().attributes;
    entries.set_quantity(1, "maxSpeed", 1.5, Quantity::Speed);
    let scene = scene(layout, &by("maxSpeed"));
    let legend = scene.legend().unwrap();
    assert_eq!(legend.title(), "maxSpeed (m/s)");
    assert_eq!(legend.entries[0].label, "1.5");
    let mut levels = Layout::default();
    levels.paths.push(&NewPath::default());
    let levels = self::scene(levels, &by("direction"));
    assert_eq!(levels.legend().unwrap().title(), "direction");
}

#[test]
fn many_distinct_numbers_form_a_scale() {
    let mut speeds = layout(20);
    for row in 0..20 {
        speeds
            .paths
            .attributes
            .set(row, "speed", Value::Float(row as f64 / 10.0));
    }
    let scene = scene(speeds, &by("speed"));
    let legend = scene.legend().unwrap();
    let scale = legend.scale.as_ref().unwrap();
    let labels: Vec<_> = legend.entries.iter().map(|e| e.label.as_str()).collect();
    assert_eq!(labels, ["0", "0.5", "1", "1.5"]);
    assert_eq!((scale.at[0], scale.at[2]), (0.0, 1.0 / 1.9));
    assert_eq!(scene.color(0), scale.colors[0]);
    assert_eq!(scene.color(10), legend.entries[2].color);
    assert_eq!(Some(&scene.color(19)), scale.colors.last());
}

#[test]
fn a_given_range_ends_the_scale_and_counts_paths_without_a_value() {
    let mut speeds = layout(4);
    for (row, speed) in [0.5, 1.0, 7.0].into_iter().enumerate() {
        let attributes = &mut speeds.paths.attributes;
        attributes.set(row, "speed", Value::Float(speed));
    }
    let mut options = by("speed");
    options.numbers.range = Some([0.0, 2.0]);
    options.numbers.palette = Palette::Viridis;
    let scene = scene(speeds, &options);
    let legend = scene.legend().unwrap();
    let colors = &legend.scale.as_ref().unwrap().colors;
    assert_eq!(scene.color(1), colors[colors.len() / 2]);
    assert_eq!(scene.color(2), colors[colors.len() - 1]);
    let last = legend.entries.last().unwrap();
    assert_eq!((last.label.as_str(), last.paths), ("no value", Some(1)));
}

#[test]
fn an_infinite_end_of_a_range_is_that_of_the_column() {
    let mut speeds = layout(12);
    for row in 0..12 {
        let attributes = &mut speeds.paths.attributes;
        attributes.set(row, "speed", Value::Float(1.0 + row as f64));
    }
    let column = by("speed").color_by.unwrap();
    assert_eq!(column.range(&speeds), Some([1.0, 12.0]));
    assert_eq!(by("level").color_by.unwrap().range(&speeds), None);
    let scale = |low, high| {
        let mut options = by("speed");
        options.numbers.range = Some([low, high]);
        let scene = scene(speeds.clone(), &options);
        let colors = [0, 3, 11].map(|row| scene.color(row));
        (colors, scene.legend().cloned())
    };
    let (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!(scale(least, most), scale(1.0, 12.0));
    assert_eq!(scale(4.0, most), scale(4.0, 12.0));
    assert_eq!(scale(least, 4.0), scale(1.0, 4.0));
    // One end beyond all numbers: those below have the color of the lower end.
    let (colors, _) = scale(99.0, most);
    assert!(colors.iter().all(|color| *color == colors[0]));
    assert_eq!(colors[0], scale(1.0, 12.0).0[0]);
}

#[test]
fn breaks_make_classes_along_the_ramp_whatever_the_numbers() {
    let mut speeds = layout(5);
    for (row, speed) in [0.2, 0.5, 0.7, 2.0].into_iter().enumerate() {
        let attributes = &mut speeds.paths.attributes;
        attributes.set(row, "speed", Value::Float(speed));
    }
    let mut options = by("speed");
    options.numbers.range = Some([0.0, 1.0]);
    let ramp = scene(speeds.clone(), &options).legend().unwrap().clone();
    let ramp = ramp.scale.unwrap().colors;
    // The range has no effect beside breaks.
    options.numbers.breaks = ClassBreaks::new(&[0.5, 1.0, 1.5, 2.0]).ok();
    let graduated = scene(speeds.clone(), &options);
    let legend = graduated.legend().unwrap();
    let entries = legend.entries.iter();
    let entries: Vec<_> = entries.map(|e| (e.label.as_str(), e.paths)).collect();
    let expected = [
        ("below 0.5", Some(1)),
        ("0.5 to 1", Some(2)),
        ("1 to 1.5", Some(0)),
        ("1.5 to 2", Some(0)),
        ("2 and more", Some(1)),
        ("no value", Some(1)),
    ];
    assert_eq!(entries, expected);
    assert!(legend.scale.is_none(), "no colors between those of classes");
    for (row, class) in [(0, 0), (1, 1), (2, 1), (3, 4), (4, 5)] {
        assert_eq!(graduated.color(row), legend.entries[class].color, "{row}");
    }
    for (class, entry) in legend.entries[..5].iter().enumerate() {
        assert_eq!(entry.color, ramp[class * (ramp.len() - 1) / 4], "{class}");
    }
    // Hidden paths are not counted, and texts have no breaks.
    options.level = Some("upper".into());
    let upper = scene(speeds.clone(), &options).legend().unwrap().clone();
    assert_eq!(upper.entries[0].paths, Some(0));
    options.color_by = by("level").color_by;
    let levels = scene(speeds, &options).legend().unwrap().clone();
    assert_eq!(levels.entries[0].label, "upper");
}

#[test]
fn round_breaks_are_the_ticks_of_the_scale_above_the_least_number() {
    let mut speeds = layout(12);
    for row in 0..12 {
        let speed = Value::Float(row as f64 / 10.0);
        speeds.paths.attributes.set(row, "speed", speed);
    }
    let breaks = |column: &str, range| {
        let by = by(column).color_by.unwrap();
        let breaks = by.round_breaks(&speeds, range)?;
        Some(breaks.numbers().to_vec())
    };
    assert_eq!(breaks("speed", None).unwrap(), [0.2, 0.4, 0.6, 0.8, 1.0]);
    let ends = Some([f64::NEG_INFINITY, 0.35]);
    assert_eq!(
        breaks("speed", ends).unwrap(),
        [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35]
    );
    assert_eq!(breaks("speed", Some([1.0, 3.0])).unwrap()[..2], [1.0, 1.5]);
    assert_eq!(breaks("level", None), None);
}

#[test]
fn walls_are_gray_below_the_ways_only_where_asked() {
    let mut hall = layout(3);
    hall.paths.attributes.set(1, "element", Value::Text("lane"));
    hall.paths.attributes.set(2, "element", Value::Text("wall"));
    let as_before = scene(hall.clone(), &SceneOptions::default());
    assert_eq!(as_before.draw_order(), [0, 1, 2]);
    assert_eq!(as_before.color(2), as_before.color(0));
    let options = SceneOptions {
        has_gray_structure: true,
        ..SceneOptions::default()
    };
    let mut styled = scene(hall, &options);
    assert!(as_before.draws_by_rows() && !styled.draws_by_rows());
    assert_eq!(styled.draw_order(), [2, 0, 1]);
    let set = |row, state| Edit::SetStates([(row, state)].into());
    styled.edit(&set(0, PathState::Removed)).unwrap();
    assert_eq!(styled.draw_order(), [2, 1]);
    styled.edit(&set(0, PathState::Shown)).unwrap();
    assert_eq!(styled.draw_order(), [2, 0, 1]);
    assert_ne!(styled.color(2), styled.color(0));
    assert_eq!(styled.color(1), as_before.color(1));
    // A copy of a wall is a wall, and a color of its own makes it no way.
    let mut runs = Runs::default();
    runs.push_line(Point::new(5.0, 0.0), Point::new(5.0, 1.0));
    let copy = Insertion {
        runs,
        attributes_of: Some(2),
        ..Insertion::default()
    };
    styled.edit(&Edit::Insert([copy].into())).unwrap();
    assert_eq!(styled.color(3), styled.color(2));
    assert_eq!(styled.draw_order(), [2, 3, 0, 1]);
    let red = OwnStyle {
        width_m: None,
        color_rgba: Some(0xff00_00ff),
    };
    let restyled = [(2, red), (1, red)].into();
    styled.edit(&Edit::Restyle(restyled)).unwrap();
    assert_eq!(styled.color(2), styled.color(3));
    assert_eq!(styled.color(1), Rgba::opaque(255, 0, 0));
    let below = [0, 1, 2, 3].map(|row| styled.is_below_ways(row));
    assert_eq!(below, [false, false, true, true]);
}

#[test]
fn colors_by_built_in_columns_and_rejects_unknown_ones() {
    let levels = scene(layout(4), &by("level"));
    assert_eq!(levels.legend().unwrap().entries.len(), 2);
    assert_ne!(levels.color(0), levels.color(1));
    let error = Scene::new(Arc::new(layout(1)), &by("color of the sky")).unwrap_err();
    assert!(error.to_string().contains("vehicle_type"), "{error}");
}

#[test]
fn legend_has_round_numbers_at_their_colors() {
    for tone in [ToneMap::Linear, ToneMap::Log, ToneMap::Equalized] {
        let counts: Vec<f32> = (0..1237).map(|i| i as f32).collect();
        let mut frame = Frame::new(FrameSize::new(1237, 1).unwrap());
        let legend = shade(&counts, tone, Rgba::WHITE, &mut frame);
        assert_eq!(legend.entries.last().unwrap().label, "1000");
        assert!((2..=9).contains(&legend.entries.len()), "{tone:?}");
        for entry in &legend.entries {
            let count: usize = entry.label.parse().unwrap();
            let [r, g, b, _] = frame.pixels()[count];
            let off = [entry.color.r.abs_diff(r), entry.color.g.abs_diff(g)];
            assert!(off.iter().all(|off| *off <= 2), "{tone:?} {count}");
            assert!(entry.color.b.abs_diff(b) <= 2, "{tone:?} {count}");
        }
    }
    let single = shade(
        &[1.0],
        ToneMap::Log,
        Rgba::WHITE,
        &mut Frame::new(FrameSize::new(1, 1).unwrap()),
    );
    assert_eq!(single.entries.len(), 1);
}
