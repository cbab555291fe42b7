//! A picture drawn in strips is the one drawn at once, with all that may lie on it.

use guideway::render::density::ToneMap;
use guideway::render::{Preparation, Prepared, Sheet, Strip, Text};
use guideway::scene::ColorBy;

use super::*;
use crate::cli::envelope;

/// Method `cpu`, which draws so many pixels at once.
struct InStrips(usize);

struct PreparedInStrips(usize, Box<dyn Prepared>);

impl Method for InStrips {
    fn info(&self) -> MethodInfo {
        guideway::method("cpu").unwrap().info()
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let cpu = guideway::method("cpu").unwrap().prepare(scene, budget)?;
        Ok(Box::new(PreparedInStrips(self.0, cpu)))
    }
}

impl Prepared for PreparedInStrips {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.1.render(view, style, cancel, frame)
    }

    fn strip_pixels(&self) -> usize {
        self.0
    }

    fn render_strip(
        &mut self,
        strip: &Strip,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.1.render_strip(strip, style, cancel, frame)
    }

    fn preparation(&self) -> &Preparation {
        self.1.preparation()
    }
}

fn site() -> guideway::layout::Layout {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/site.lif.json");
    guideway::open(path).unwrap()
}

/// All pixels, how many calls brought them, and the report.
fn drawn(strip_pixels: usize, wishes: &Wishes, below: &Below) -> (Vec<[u8; 4]>, usize, Report) {
    struct Quiet;
    impl Progress for Quiet {}
    let scene = Arc::new(Scene::new(Arc::new(site()), &wishes.scene).unwrap());
    let (mut pixels, mut calls) = (Vec::new(), 0);
    let mut take = |frame: &Frame| {
        pixels.extend_from_slice(frame.pixels());
        calls += 1;
        Ok(())
    };
    let method = InStrips(strip_pixels);
    let drawn = draw(&method, &scene, below, wishes, &Quiet, &mut take).unwrap();
    (pixels, calls, drawn.report)
}

/// A bar and a name across the border of two strips.
fn sheet() -> Sheet {
    let mut sheet = Sheet::default();
    let red = Rgba::opaque(255, 0, 0);
    sheet.add_rectangle(red, Point::new(100.0, 30.5), Point::new(110.0, 300.0));
    sheet.texts.push(Text {
        text: "a name".into(),
        at_px: Point::new(200.0, 64.0),
        char_px: 9.0,
        ink: red,
        paper: Rgba::WHITE,
    });
    sheet
}

#[test]
fn strips_together_are_the_picture_drawn_at_once() {
    let wishes = |shading, has_legend: bool| Wishes {
        size: FrameSize::new(500, 400).unwrap(),
        center_m: None,
        px_per_m: None,
        scene: SceneOptions {
            color_by: has_legend.then(|| ColorBy {
                column: "maxSpeed".into(),
            }),
            ..SceneOptions::default()
        },
        style: Style {
            shading,
            ..Style::default()
        },
        has_legend,
        budget: Budget::default(),
        marks: sheet(),
    };
    let plan = Scene::new(Arc::new(site()), &SceneOptions::default()).unwrap();
    let plan = Arc::new(plan);
    let below = Below {
        floor_plan: Some(floor_plan::FloorPlan::Paths(Arc::clone(&plan))),
        lines: sheet(),
        envelope: Some(envelope::source("2x1.2").unwrap()),
        swept: Some(vec![0, 2]),
        others: vec![plan],
    };
    for (wishes, below) in [
        (wishes(Shading::Color, true), Below::default()),
        (
            wishes(Shading::Density(ToneMap::Equalized), false),
            Below::default(),
        ),
        (wishes(Shading::Color, false), below),
    ] {
        let (whole, calls, report) = drawn(usize::MAX, &wishes, &below);
        assert_eq!((calls, whole.len()), (1, 500 * 400));
        let (strips, calls, of_strips) = drawn(0, &wishes, &below);
        assert_eq!(calls, 7);
        assert!(strips == whole);
        assert_eq!(
            (
                of_strips.drawn,
                of_strips.culled,
                of_strips.lines,
                of_strips.notes
            ),
            (report.drawn, report.culled, report.lines, report.notes)
        );
    }
}
