//! A prepared scene that takes other colors draws the bits of a scene prepared with them.

use std::sync::Arc;

use guideway_cpu::{Cpu, Oracle};
use guideway_layout::{Layout, OwnStyle, Value};
use guideway_scene::{
    Budget, ColorBy, Coloring, Edit, EditOutcome, Frame, Gesture, Method, PathState, Prepared,
    Scene, SceneOptions,
};
use guideway_spline::{Affine, Point};
use guideway_tests::devices::{available_or_skip, tiles};
use guideway_tests::methods::render_view;
use guideway_tests::scenes::site;
use guideway_tests::sketch::{Drawing, Sketch};

const PATHS: u32 = 700;

fn drawing() -> Drawing {
    site(Sketch::new(96, 64).width(1.2), PATHS as usize, 8).build()
}

/// Some paths with colors of their own, walls, and a column of numbers.
fn layout() -> Arc<Layout> {
    let mut layout = drawing().layout;
    for row in 0..PATHS as usize {
        let attributes = &mut layout.paths.attributes;
        attributes.set(row, "speed", Value::Float((row % 11) as f64));
        if row % 5 == 0 {
            attributes.set(row, "element", Value::Text("wall"));
        }
        let translucent = OwnStyle {
            width_m: None,
            color_rgba: (row % 9 == 0).then_some(0x3060_a080),
        };
        layout.paths.set_own_style(row, translucent);
    }
    Arc::new(layout)
}

/// Own colors, walls below the ways, colors by a column, and one color again.
fn options() -> [SceneOptions; 4] {
    [
        SceneOptions::default(),
        SceneOptions {
            has_gray_structure: true,
            ..SceneOptions::default()
        },
        SceneOptions {
            color_by: Some(ColorBy {
                column: "speed".into(),
            }),
            ..SceneOptions::default()
        },
        SceneOptions::default(),
    ]
}

fn methods() -> Vec<Box<dyn Method>> {
    let mut methods: Vec<Box<dyn Method>> = vec![Box::new(Oracle), Box::new(Cpu)];
    if let Some(tiles) = available_or_skip(tiles()) {
        methods.push(Box::new(tiles));
    }
    methods
}

fn prepare(method: &dyn Method, layout: &Arc<Layout>, options: &SceneOptions) -> Box<dyn Prepared> {
    let scene = Scene::new(Arc::clone(layout), options).expect("known columns");
    let prepared = method.prepare(Arc::new(scene), &Budget::default());
    prepared.expect("a small scene")
}

fn recolor(prepared: &mut dyn Prepared, layout: &Layout, options: &SceneOptions) -> EditOutcome {
    let coloring = Coloring::new(layout, options).expect("known columns");
    prepared.recolor(&coloring).expect("memory for colors")
}

fn picture(prepared: &mut dyn Prepared) -> Frame {
    let drawing = drawing();
    let drawn = render_view(prepared, &drawing.view, &drawing.style);
    drawn.expect("a small picture").0
}

#[test]
fn other_colors_give_the_bits_of_a_new_scene() {
    let layout = layout();
    for method in methods() {
        let name = method.info().name;
        let mut shown = prepare(method.as_ref(), &layout, &options()[0]);
        let mut before = picture(shown.as_mut());
        for options in &options()[1..] {
            let outcome = recolor(shown.as_mut(), &layout, options);
            assert_ne!(outcome, EditOutcome::NotInPlace, "{name}");
            let after = picture(shown.as_mut());
            let expected = picture(prepare(method.as_ref(), &layout, options).as_mut());
            assert!(after == expected, "{name}: {options:?}");
            assert!(after != before, "{name}: {options:?} shows");
            before = after;
        }
    }
}

#[test]
fn colors_come_after_edits_and_end_gestures() {
    let layout = layout();
    let [own, _, by_speed, _] = options();
    let hidden = Edit::SetStates((0..90).map(|row| (row, PathState::Hidden)).collect());
    let gesture = Gesture {
        paths: (90..200).collect(),
        by: Affine::translation(Point::new(3.0, 1.0)),
    };
    for method in methods() {
        let name = method.info().name;
        let mut shown = prepare(method.as_ref(), &layout, &own);
        let mut expected = prepare(method.as_ref(), &layout, &by_speed);
        for prepared in [&mut shown, &mut expected] {
            prepared.edit(&hidden).expect("a valid edit");
        }
        shown.show_gesture(Some(&gesture)).expect("a valid gesture");
        picture(shown.as_mut());
        recolor(shown.as_mut(), &layout, &by_speed);
        let drawn = picture(shown.as_mut());
        assert!(drawn == picture(expected.as_mut()), "{name}");
    }
}

#[test]
fn colors_of_another_layout_are_refused() {
    let [own, _, by_speed, _] = options();
    let layout = layout();
    let fewer = layout.first_rows([600, 0, 0]);
    for method in methods() {
        let name = method.info().name;
        let mut shown = prepare(method.as_ref(), &layout, &own);
        let before = picture(shown.as_mut());
        let outcome = recolor(shown.as_mut(), &fewer, &by_speed);
        assert_eq!(outcome, EditOutcome::NotInPlace, "{name}");
        assert!(picture(shown.as_mut()) == before, "{name}");
    }
}
