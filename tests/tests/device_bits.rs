//! Method `gpu` draws the same bits on every device: `tests/checksums/gpu.txt` has a checksum of
//! each picture, and holds wherever the test runs.
//!
//! `GUIDEWAY_CHECKSUMS=FILE` writes the checksums of this device to a file instead.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use guideway_datasets::{RUN_POINTS, d1, d2};
use guideway_gpu::Tiles;
use guideway_layout::{Geometry, Layout, OwnStyle, Paths};
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, Frame, FrameSize, LineRule, Method, RenderError, Scene, SceneOptions, Shading, Style,
    View,
};
use guideway_spline::{Point, Runs};
use guideway_tests::devices::{available_or_skip, tiles};
use guideway_tests::methods::{draw, render_view};
use guideway_tests::scenes;

/// Name and checksum of each picture, one per line.
const CHECKSUMS: &str = include_str!("../checksums/gpu.txt");

/// FNV-1a over the bytes of all pixels.
fn checksum(frame: &Frame) -> u64 {
    let bytes = frame.pixels().iter().flatten();
    bytes.fold(0xcbf2_9ce4_8422_2325, |sum, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Checksums by the names of pictures.
type Checksums = BTreeMap<String, u64>;

fn kept(text: &str) -> Checksums {
    let lines = text.lines().filter_map(|line| line.rsplit_once(' '));
    let lines =
        lines.map(|(name, sum)| Some((name.to_owned(), u64::from_str_radix(sum, 16).ok()?)));
    lines
        .map(|line| line.expect("a name and a number"))
        .collect()
}

/// Names of the pictures that only one of both has, or whose checksums differ.
fn differing(a: &Checksums, b: &Checksums) -> Vec<String> {
    let names = a
        .keys()
        .chain(b.keys().filter(|name| !a.contains_key(*name)));
    let differing = names.filter(|name| a.get(*name) != b.get(*name));
    differing.cloned().collect()
}

#[test]
fn every_device_draws_the_same_bits() {
    let Some(gpu) = available_or_skip(tiles()) else {
        return;
    };
    let mut drawn = Checksums::new();
    for case in scenes::all() {
        match draw(&gpu, &case.build(), &Budget::default()) {
            Ok((frame, _)) => drawn.insert(case.name, checksum(&frame)),
            Err(RenderError::Unsupported { .. }) => continue,
            Err(error) => panic!("{}: {error}", case.name),
        };
    }
    for crowd in crowds() {
        crowd.draw(&gpu, &mut drawn);
    }
    if let Some(file) = std::env::var_os("GUIDEWAY_CHECKSUMS") {
        let mut text = String::new();
        for (name, sum) in &drawn {
            writeln!(text, "{name} {sum:016x}").expect("a text holds any line");
        }
        std::fs::write(file, text).expect("the file can be written");
        return;
    }
    let differing = differing(&drawn, &kept(CHECKSUMS));
    assert!(
        differing.is_empty(),
        "{} of {} pictures differ from those of other devices on {}:\n{}",
        differing.len(),
        drawn.len(),
        gpu.info().device,
        differing.join("\n")
    );
}

#[test]
fn one_pixel_changes_the_checksum() {
    let mut frame = Frame::new(FrameSize::new(30, 20).expect("a picture has pixels"));
    let mut expected = Checksums::from([("a scene".to_owned(), checksum(&frame))]);
    let drawn = expected.clone();
    assert!(differing(&drawn, &expected).is_empty());
    frame.pixels_mut()[319][2] ^= 1;
    expected.insert("a scene".to_owned(), checksum(&frame));
    assert_eq!(differing(&drawn, &expected), ["a scene"]);
    expected.clear();
    assert_eq!(differing(&drawn, &expected), ["a scene"]);
}

/// A large scene and the style that draws it.
struct LargeScene {
    name: &'static str,
    scene: Arc<Scene>,
    style: Style,
}

impl LargeScene {
    /// Draws the whole layout, and ever nearer views.
    fn draw(&self, gpu: &Tiles, into: &mut Checksums) {
        let budget = Budget::default();
        let prepared = gpu.prepare(Arc::clone(&self.scene), &budget);
        let mut prepared = prepared.expect("there is memory enough");
        let size = FrameSize::new(960, 540).expect("a picture has pixels");
        let all = View::fit(size, self.scene.bounds()).expect("the view is usable");
        for zoom in [1.0, 7.3, 61.0] {
            // Beside the middle, at no whole number of pixels.
            let center = all.center_m() + Point::new(1.37, -0.71) * (zoom - 1.0);
            let view = View::new(size, center, all.px_per_m() * zoom);
            let view = view.expect("the view is usable");
            let drawn = render_view(prepared.as_mut(), &view, &self.style);
            let (frame, _) = drawn.unwrap_or_else(|error| panic!("{}: {error}", self.name));
            into.insert(format!("{} x{zoom}", self.name), checksum(&frame));
        }
    }
}

fn crowds() -> Vec<LargeScene> {
    let crowd = |name, layout, style| LargeScene {
        name,
        scene: {
            let scene = Scene::new(Arc::new(layout), &SceneOptions::default());
            Arc::new(scene.expect("options that fit any layout"))
        },
        style,
    };
    let d1_runs = |paths| layout(d1(paths, 1).map(|path| path.run));
    let default = Style::default;
    let thesis = || Style {
        line_rule: LineRule::Thesis,
        ..default()
    };
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..default()
    };
    let fine = Style {
        line_rule: LineRule::World {
            width_m: 0.01,
            min_px: 0.3,
            max_px: 2.0,
        },
        ..default()
    };
    let shares = Style {
        background: guideway_scene::Rgba {
            r: 200,
            g: 100,
            b: 50,
            a: 77,
        },
        ..default()
    };
    vec![
        crowd("d1 100000", d1_runs(100_000), default()),
        crowd("d1 100000, rule of the thesis", d1_runs(100_000), thesis()),
        crowd(
            "d1 60000, many colors",
            colored(d1_runs(60_000), 255),
            default(),
        ),
        crowd(
            "d1 20000, translucent",
            colored(d1_runs(20_000), 100),
            default(),
        ),
        crowd("d1 20000, on glass", colored(d1_runs(20_000), 150), shares),
        crowd("d1 20000, density", d1_runs(20_000), density),
        crowd("d1 30000, thin", d1_runs(30_000), fine),
        crowd(
            "d2 20000",
            layout(d2(20_000, 1).map(|path| path.run)),
            thesis(),
        ),
        crowd("fans", fans(), default()),
    ]
}

fn layout<R: Into<Vec<Point<f32>>>>(runs: impl Iterator<Item = R>) -> Layout {
    let runs: Vec<Vec<Point<f32>>> = runs.map(Into::into).collect();
    let names: Vec<String> = (0..runs.len()).map(|row| row.to_string()).collect();
    let ends = (1..=runs.len()).map(|row| (row * RUN_POINTS) as u32);
    let geometry = Geometry::from_f32(runs.concat(), ends.collect());
    Layout {
        paths: Paths::from_columns(names.iter().map(String::as_str).collect(), geometry),
        ..Layout::default()
    }
}

/// Gives each path a color and every third a width of its own.
fn colored(mut layout: Layout, alpha: u32) -> Layout {
    for row in 0..layout.paths.len() {
        let hash = (row as u32).wrapping_mul(0x9e37_79b9);
        let style = OwnStyle {
            width_m: (row % 3 == 0).then_some(0.05 * f32::from((row % 17) as u16)),
            color_rgba: Some(hash & 0xffff_ff00 | alpha),
        };
        layout.paths.set_own_style(row, style);
    }
    layout
}

/// Fans of long lines in all directions, many of them level or upright, and curves of all sizes.
fn fans() -> Layout {
    let mut layout = Layout::default();
    for fan in 0..40_u32 {
        let at = Point::new(f64::from(fan % 8) * 130.0, f64::from(fan / 8) * 110.0);
        for ray in 0..60_u32 {
            let turn = f64::from(ray) * std::f64::consts::TAU / 60.0;
            let reach = f64::from(3 + (ray * 37 + fan * 11) % 400);
            let to = at + Point::new(turn.cos(), turn.sin()) * reach;
            let mut runs = Runs::default();
            if ray % 4 == 0 {
                let aside = Point::new(-turn.sin(), turn.cos()) * (reach * 0.4);
                runs.push(&[at, at + aside, to + aside, to, to - aside]);
            } else {
                runs.push_line(at, to);
            }
            layout.paths.push(&guideway_layout::NewPath {
                runs: &runs,
                ..guideway_layout::NewPath::default()
            });
        }
    }
    layout
}
