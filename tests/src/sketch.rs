//! A sketch describes a drawing in pixels (y up, the origin in the lower left corner) and builds
//! layout, style and view from it.

use std::sync::Arc;

use guideway_layout::{Code, Geometry, Layout, Level, NewPath, Paths, TextColumn};
use guideway_scene::density::ToneMap;
use guideway_scene::{FrameSize, LineRule, Rgba, Scene, SceneOptions, Shading, Style, View};
use guideway_spline::{Point, Runs};

/// Layout, style and view of one picture.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The paths.
    pub layout: Layout,
    /// Options of the scene.
    pub options: SceneOptions,
    /// Style of the frame.
    pub style: Style,
    /// View of the scene.
    pub view: View,
}

impl Drawing {
    /// The scene of the layout and the options.
    ///
    /// # Panics
    /// When the options name a missing level or column.
    pub fn scene(&self) -> Scene {
        Scene::new(Arc::new(self.layout.clone()), &self.options)
            .expect("the options of a drawing suit its layout")
    }
}

/// Builder of a [`Drawing`].
#[derive(Clone, Debug)]
pub struct Sketch {
    size: FrameSize,
    px_per_m: f64,
    origin_m: Point<f64>,
    width_px: f64,
    rule: Option<LineRule>,
    style: Style,
    options: SceneOptions,
    strokes: Vec<Stroke>,
    refused: usize,
    holds_f32: bool,
}

#[derive(Clone, Debug, Default)]
struct Stroke {
    runs_px: Vec<Vec<Point<f64>>>,
    color_rgba: u32,
    rank: i32,
    width_px: Option<f64>,
    level: Option<u32>,
}

impl Sketch {
    /// An empty picture at one pixel per meter, with lines 2 pixels wide.
    ///
    /// # Panics
    /// When the width or height is 0.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            size: FrameSize::new(width, height).expect("a picture has pixels"),
            px_per_m: 1.0,
            origin_m: Point::new(0.0, 0.0),
            width_px: 2.0,
            rule: None,
            style: Style::default(),
            options: SceneOptions::default(),
            strokes: Vec::new(),
            refused: 0,
            holds_f32: false,
        }
    }

    /// Sets the scale. The drawing in pixels stays the same.
    pub fn px_per_m(mut self, px_per_m: f64) -> Self {
        self.px_per_m = px_per_m;
        self
    }

    /// Moves the layout and the view to another position in the world, in meters.
    pub fn at(mut self, x_m: f64, y_m: f64) -> Self {
        self.origin_m = Point::new(x_m, y_m);
        self
    }

    /// Sets the common width of all lines.
    pub fn width(mut self, width_px: f64) -> Self {
        self.width_px = width_px;
        self
    }

    /// Sets the line rule, instead of a common width.
    pub fn rule(mut self, rule: LineRule) -> Self {
        self.rule = Some(rule);
        self
    }

    /// Sets the background, 0xRRGGBBAA.
    pub fn background(mut self, rgba: u32) -> Self {
        self.style.background = Rgba::from_u32(rgba);
        self
    }

    /// Shades by the number of paths per pixel.
    pub fn density(mut self, tone: ToneMap) -> Self {
        self.style.shading = Shading::Density(tone);
        self
    }

    /// Sets the color of all paths without a color, 0xRRGGBBAA.
    pub fn common_color(mut self, rgba: u32) -> Self {
        self.options.color = Some(Rgba::from_u32(rgba));
        self
    }

    /// Draws only one level.
    pub fn only_level(mut self, name: &str) -> Self {
        self.options.level = Some(name.to_owned());
        self
    }

    /// Adds refused paths.
    pub fn refused(mut self, count: usize) -> Self {
        self.refused = count;
        self
    }

    /// Holds control points in `f32`.
    pub fn in_f32(mut self) -> Self {
        self.holds_f32 = true;
        self
    }

    /// Adds a path of one run with these control points.
    pub fn curve(self, control_px: &[(f64, f64)]) -> Self {
        self.runs(&[control_px])
    }

    /// Adds a path of several runs.
    pub fn runs(mut self, runs_px: &[&[(f64, f64)]]) -> Self {
        let points = |run: &&[(f64, f64)]| run.iter().map(|&(x, y)| Point::new(x, y)).collect();
        self.strokes.push(Stroke {
            runs_px: runs_px.iter().map(points).collect(),
            ..Stroke::default()
        });
        self
    }

    /// Adds a straight path.
    pub fn line(self, from: (f64, f64), to: (f64, f64)) -> Self {
        self.curve(&line_control(from, to))
    }

    /// Adds a path of straight runs, one per side, from corner to corner.
    pub fn polyline(self, corners: &[(f64, f64)]) -> Self {
        let sides: Vec<_> = corners
            .windows(2)
            .map(|c| line_control(c[0], c[1]))
            .collect();
        let runs: Vec<&[(f64, f64)]> = sides.iter().map(|side| side.as_slice()).collect();
        self.runs(&runs)
    }

    /// Sets the color of the path added last, 0xRRGGBBAA.
    pub fn color(self, rgba: u32) -> Self {
        self.of_last(|stroke| stroke.color_rgba = rgba)
    }

    /// Sets the draw rank of the path added last.
    pub fn rank(self, rank: i32) -> Self {
        self.of_last(|stroke| stroke.rank = rank)
    }

    /// Sets the width of the path added last.
    pub fn own_width(self, width_px: f64) -> Self {
        self.of_last(|stroke| stroke.width_px = Some(width_px))
    }

    /// Puts the path added last on level 0, "ground", or 1, "upper".
    pub fn level(self, level: u32) -> Self {
        self.of_last(|stroke| stroke.level = Some(level))
    }

    fn of_last(mut self, set: impl FnOnce(&mut Stroke)) -> Self {
        set(self.strokes.last_mut().expect("a path was added before"));
        self
    }

    /// The same paths without colors.
    pub fn in_one_color(mut self) -> Self {
        for stroke in &mut self.strokes {
            stroke.color_rgba = 0;
        }
        self
    }

    /// The paths in another order: path `order[i]` moves to index `i`.
    pub fn reordered(mut self, order: &[usize]) -> Self {
        self.strokes = order.iter().map(|&i| self.strokes[i].clone()).collect();
        self
    }

    /// The first `count` paths only.
    pub fn first(mut self, count: usize) -> Self {
        self.strokes.truncate(count);
        self
    }

    /// Number of paths added.
    pub fn len(&self) -> usize {
        self.strokes.len()
    }

    /// Returns `true` if no path was added.
    pub fn is_empty(&self) -> bool {
        self.strokes.is_empty()
    }

    /// The drawing.
    ///
    /// # Panics
    /// When the scale or position is out of range for a view.
    pub fn build(&self) -> Drawing {
        let (width, height) = (f64::from(self.size.width()), f64::from(self.size.height()));
        let center_m = self.world_from_sketch(Point::new(width / 2.0, height / 2.0));
        let view = View::new(self.size, center_m, self.px_per_m).expect("the view is usable");
        let line_rule = self.rule.unwrap_or(LineRule::World {
            width_m: self.width_px / self.px_per_m,
            min_px: 0.0,
            max_px: f64::INFINITY,
        });
        Drawing {
            layout: self.layout(),
            options: self.options.clone(),
            style: Style {
                line_rule,
                ..self.style
            },
            view,
        }
    }

    fn world_from_sketch(&self, point_px: Point<f64>) -> Point<f64> {
        self.origin_m + point_px * (1.0 / self.px_per_m)
    }

    fn layout(&self) -> Layout {
        let strokes = &self.strokes;
        let mut layout = Layout {
            paths: if self.holds_f32 {
                self.paths_in_f32()
            } else {
                self.paths_in_f64()
            },
            ..Layout::default()
        };
        let paths = &mut layout.paths;
        paths.set_levels(
            strokes
                .iter()
                .map(|s| s.level.unwrap_or(u32::MAX))
                .collect(),
        );
        // Without empty columns, as file readers do.
        if strokes.iter().any(|s| s.color_rgba != 0) {
            paths.set_color_rgba(strokes.iter().map(|s| s.color_rgba).collect());
        }
        if strokes.iter().any(|s| s.rank != 0) {
            paths.set_rank(strokes.iter().map(|s| s.rank).collect());
        }
        if strokes.iter().any(|s| s.width_px.is_some()) {
            let width_m = |s: &Stroke| s.width_px.map_or(f64::NAN, |w| w / self.px_per_m) as f32;
            paths.set_width_m(strokes.iter().map(width_m).collect());
        }
        for id in ["ground", "upper"] {
            layout.levels.push(Level {
                id: id.to_owned(),
                ..Level::default()
            });
        }
        for i in 0..self.refused {
            let id = format!("R{i}");
            layout.refused.push(&id, Code::NonFinite, "x is NaN");
        }
        layout
    }

    fn paths_in_f64(&self) -> Paths {
        let mut paths = Paths::default();
        for (row, stroke) in self.strokes.iter().enumerate() {
            let mut runs = Runs::default();
            for run in &stroke.runs_px {
                let run_m: Vec<_> = run.iter().map(|&p| self.world_from_sketch(p)).collect();
                runs.push(&run_m);
            }
            paths.push(&NewPath {
                id: &format!("P{row}"),
                runs: &runs,
                ..NewPath::default()
            });
        }
        paths
    }

    fn paths_in_f32(&self) -> Paths {
        let (mut ids, mut points) = (TextColumn::default(), Vec::new());
        let (mut run_ends, mut path_ends) = (Vec::new(), Vec::new());
        for (row, stroke) in self.strokes.iter().enumerate() {
            ids.push(&format!("P{row}"));
            for run in &stroke.runs_px {
                points.extend(run.iter().map(|&p| self.world_from_sketch(p).to_f32()));
                run_ends.push(points.len() as u32);
            }
            path_ends.push(run_ends.len() as u32);
        }
        let geometry = Geometry::from_f32(points, run_ends).with_path_ends(path_ends);
        Paths::from_columns(ids, geometry)
    }
}

/// Control points of a straight run.
pub fn line_control(from: (f64, f64), to: (f64, f64)) -> [(f64, f64); 4] {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    [(from.0 - dx, from.1 - dy), from, to, (to.0 + dx, to.1 + dy)]
}
