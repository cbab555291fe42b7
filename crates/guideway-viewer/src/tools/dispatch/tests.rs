use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use guideway_document::Document;
use guideway_document::decorations::MarkedKinds;
use guideway_scene::{FrameSize, LineRule, View};

use super::*;
use crate::background::RepaintHandle;
use crate::editing::DocumentSlot;
use crate::tests::services::lanes;

const NONE: Modifiers = Modifiers::NONE;

/// Tools over a document of three lanes, without a window.
struct Bench {
    tools: Tools,
    slot: DocumentSlot,
    view: View,
}

impl Bench {
    fn new() -> Self {
        let mut slot = DocumentSlot::default();
        slot.replace(Document::new(lanes(3).into(), &Default::default()).unwrap());
        let size = FrameSize::new(400, 300).unwrap();
        Self {
            tools: Tools::default(),
            slot,
            view: View::new(size, Point::new(5.0, 2.0), 20.0).unwrap(),
        }
    }

    fn send(&mut self, event: PointerEvent) {
        let context = ToolContext {
            view: self.view,
            document: self.slot.document(),
            line_rule: LineRule::default(),
            picks: MarkedKinds {
                nodes: false,
                stations: false,
                ..MarkedKinds::default()
            },
            grid_step_m: Some(1.0),
        };
        if let Some(ToolEffect::Edit(edit)) = self.tools.handle(event, &context) {
            let repaint: RepaintHandle = Arc::new(|| {});
            let (file, wait) = (Path::new("site.arrow"), Duration::from_secs(60));
            self.slot.run(edit, wait, file, &repaint);
        }
    }

    fn pixel(&self, x: f64, y: f64) -> Point<f64> {
        self.view.pixel_from_world(Point::new(x, y))
    }

    fn drag(&mut self, from: Point<f64>, to: Point<f64>) {
        self.send(PointerEvent::DragStarted(from));
        self.send(PointerEvent::Dragged(to, NONE));
        self.send(PointerEvent::DragEnded(NONE));
    }

    fn selected(&self) -> Vec<u32> {
        self.slot.document().unwrap().selection().iter().collect()
    }
}

#[test]
fn click_selects_and_drag_moves_the_selection() {
    let mut bench = Bench::new();
    let at = bench.pixel(5.0, 2.0);
    bench.send(PointerEvent::Clicked(at, NONE));
    assert_eq!(bench.selected(), [1]);
    bench.drag(at, bench.pixel(6.0, 3.0));
    let document = bench.slot.document().unwrap();
    let (start, _) = document.layout().paths.get(1).ends().unwrap();
    assert!(start.distance(Point::new(1.0, 3.0)) < 1e-6, "{start:?}");
}

#[test]
fn box_from_the_right_selects_what_it_crosses() {
    let mut bench = Bench::new();
    let (left, right) = (bench.pixel(2.0, -1.0), bench.pixel(8.0, 3.0));
    bench.drag(left, right);
    assert!(bench.selected().is_empty());
    bench.drag(right, left);
    assert_eq!(bench.selected(), [0, 1]);
}

#[test]
fn drawn_path_joins_the_nodes_near_its_ends() {
    let mut bench = Bench::new();
    bench.tools.select(Tool::Curve);
    for (x, y) in [(10.0, 0.1), (12.0, 1.0), (10.0, 1.9)] {
        let at = bench.pixel(x, y);
        bench.send(PointerEvent::Clicked(at, NONE));
    }
    bench.send(PointerEvent::DoubleClicked);
    let path = bench.slot.document().unwrap().layout().paths.get(3);
    assert_eq!((path.start_node(), path.end_node()), (Some(1), Some(3)));
}

#[test]
fn last_point_is_removed_until_none_is_left() {
    let mut bench = Bench::new();
    bench.tools.select(Tool::Measure);
    for x in [5.0, 6.0] {
        let at = bench.pixel(x, 2.0);
        bench.send(PointerEvent::Clicked(at, NONE));
    }
    let removed = [(); 3].map(|()| bench.tools.remove_last_point());
    assert_eq!(removed, [true, true, false]);
    assert!(!bench.tools.has_gesture());
}

#[test]
fn cancelled_drag_of_a_node_changes_nothing() {
    let mut bench = Bench::new();
    bench.tools.select(Tool::Points);
    let end = |bench: &Bench| {
        let document = bench.slot.document().unwrap();
        document.layout().paths.get(1).ends().unwrap().1
    };
    let before = end(&bench);
    let (from, to) = (bench.pixel(10.0, 2.0), bench.pixel(12.0, 2.5));
    bench.send(PointerEvent::DragStarted(from));
    bench.send(PointerEvent::Dragged(to, NONE));
    assert_ne!(end(&bench), before);
    bench.send(PointerEvent::Cancelled);
    assert_eq!(end(&bench), before);
    // The rest of the drag has no effect.
    bench.send(PointerEvent::Dragged(to, NONE));
    bench.send(PointerEvent::DragEnded(NONE));
    assert_eq!(end(&bench), before);
}
