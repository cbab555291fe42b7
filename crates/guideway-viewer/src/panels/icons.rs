//! Icons of the commands: lines in a square of 16 x 16, drawn in the color of the text.

use std::sync::Arc;

use eframe::egui::epaint::Tessellator;
use eframe::egui::{Color32, Id, Mesh, Pos2, Rect, Shape, Stroke, Ui, Vec2};

use crate::command::Command;

/// Side of the square in which the icons are given.
pub(super) const SIDE: f32 = 16.0;
/// Width of the lines, in sides of the square.
const LINE: f32 = 1.4 / SIDE;

pub(super) type Line = &'static [[f32; 2]];

const OPEN: &[Line] = &[
    &[
        [1.0, 13.0],
        [1.0, 3.0],
        [6.0, 3.0],
        [8.0, 5.0],
        [13.0, 5.0],
        [13.0, 7.0],
    ],
    &[
        [1.0, 13.0],
        [4.0, 7.0],
        [15.5, 7.0],
        [12.5, 13.0],
        [1.0, 13.0],
    ],
];
const SAVE: &[Line] = &[
    &[
        [2.0, 2.0],
        [12.0, 2.0],
        [14.0, 4.0],
        [14.0, 14.0],
        [2.0, 14.0],
        [2.0, 2.0],
    ],
    &[[5.0, 2.0], [5.0, 6.0], [11.0, 6.0], [11.0, 2.0]],
    &[[4.5, 14.0], [4.5, 9.0], [11.5, 9.0], [11.5, 14.0]],
];
const UNDO: &[Line] = &[
    &[[6.0, 2.5], [2.0, 6.5], [6.0, 10.5]],
    &[
        [2.0, 6.5],
        [10.0, 6.5],
        [13.0, 8.0],
        [14.0, 10.5],
        [12.5, 13.0],
        [8.0, 13.5],
    ],
];
const REDO: &[Line] = &[
    &[[10.0, 2.5], [14.0, 6.5], [10.0, 10.5]],
    &[
        [14.0, 6.5],
        [6.0, 6.5],
        [3.0, 8.0],
        [2.0, 10.5],
        [3.5, 13.0],
        [8.0, 13.5],
    ],
];
const SELECT: &[Line] = &[&[
    [3.5, 1.5],
    [3.5, 12.5],
    [6.5, 9.8],
    [8.6, 14.5],
    [10.6, 13.6],
    [8.5, 9.0],
    [12.5, 9.0],
    [3.5, 1.5],
]];
const POINTS: &[Line] = &[
    &[[3.5, 11.0], [5.0, 6.0], [8.0, 4.0], [12.0, 3.5]],
    &[
        [1.5, 11.0],
        [5.0, 11.0],
        [5.0, 14.5],
        [1.5, 14.5],
        [1.5, 11.0],
    ],
    &[
        [12.0, 1.5],
        [15.0, 1.5],
        [15.0, 5.0],
        [12.0, 5.0],
        [12.0, 1.5],
    ],
];
const NEW_LAYOUT: &[Line] = &[
    &[
        [3.0, 1.5],
        [9.5, 1.5],
        [13.0, 5.0],
        [13.0, 14.5],
        [3.0, 14.5],
        [3.0, 1.5],
    ],
    &[[9.5, 1.5], [9.5, 5.0], [13.0, 5.0]],
];
const START: Line = &[
    [1.0, 12.0],
    [4.0, 12.0],
    [4.0, 15.0],
    [1.0, 15.0],
    [1.0, 12.0],
];
const LINE_TOOL: &[Line] = &[START, &[[4.0, 12.0], [14.5, 1.5]]];
const ARC_TOOL: &[Line] = &[
    START,
    &[
        [2.5, 12.0],
        [3.4, 7.6],
        [6.0, 4.2],
        [10.0, 2.1],
        [14.5, 1.5],
    ],
];
const CURVE_TOOL: &[Line] = &[
    START,
    &[
        [4.0, 12.5],
        [7.5, 11.5],
        [8.5, 9.0],
        [7.5, 6.0],
        [9.0, 3.0],
        [14.5, 2.0],
    ],
];
const BEZIER_TOOL: &[Line] = &[
    &[[2.0, 14.0], [2.0, 2.0]],
    &[[14.0, 14.0], [14.0, 2.0]],
    &[
        [2.0, 14.0],
        [2.6, 9.5],
        [4.4, 6.2],
        [8.0, 5.0],
        [11.6, 6.2],
        [13.4, 9.5],
        [14.0, 14.0],
    ],
];
const NODE_TOOL: &[Line] = &[
    &[[8.0, 4.0], [12.0, 8.0], [8.0, 12.0], [4.0, 8.0], [8.0, 4.0]],
    &[[0.5, 8.0], [4.0, 8.0]],
    &[[12.0, 8.0], [15.5, 8.0]],
];
const STATION_TOOL: &[Line] = &[
    &[
        [3.0, 2.0],
        [13.0, 2.0],
        [13.0, 10.0],
        [3.0, 10.0],
        [3.0, 2.0],
    ],
    &[[8.0, 10.0], [8.0, 14.5]],
    &[[4.0, 14.5], [12.0, 14.5]],
];
const MEASURE: &[Line] = &[
    &[
        [1.5, 10.5],
        [10.5, 1.5],
        [14.5, 5.5],
        [5.5, 14.5],
        [1.5, 10.5],
    ],
    &[[4.5, 7.5], [6.5, 9.5]],
    &[[7.5, 4.5], [9.5, 6.5]],
];
const ZOOM_TO_ALL: &[Line] = &[
    &[[2.0, 6.0], [2.0, 2.0], [6.0, 2.0]],
    &[[10.0, 2.0], [14.0, 2.0], [14.0, 6.0]],
    &[[14.0, 10.0], [14.0, 14.0], [10.0, 14.0]],
    &[[6.0, 14.0], [2.0, 14.0], [2.0, 10.0]],
    &[[5.5, 8.0], [8.0, 5.5], [10.5, 8.0], [8.0, 10.5], [5.5, 8.0]],
];
const LENS: Line = &[
    [11.5, 7.0],
    [10.2, 10.2],
    [7.0, 11.5],
    [3.8, 10.2],
    [2.5, 7.0],
    [3.8, 3.8],
    [7.0, 2.5],
    [10.2, 3.8],
    [11.5, 7.0],
];
const HANDLE: Line = &[[10.2, 10.2], [14.5, 14.5]];
const MINUS: Line = &[[4.8, 7.0], [9.2, 7.0]];
const ZOOM_IN: &[Line] = &[LENS, HANDLE, MINUS, &[[7.0, 4.8], [7.0, 9.2]]];
const ZOOM_OUT: &[Line] = &[LENS, HANDLE, MINUS];
const FIND: &[Line] = &[LENS, HANDLE];

/// The lines of a command's icon; `None` if it has none.
pub(super) fn lines(command: Command) -> Option<&'static [Line]> {
    Some(match command {
        Command::NewLayout => NEW_LAYOUT,
        Command::Open => OPEN,
        Command::Save => SAVE,
        Command::Undo => UNDO,
        Command::Redo => REDO,
        Command::ToolSelect => SELECT,
        Command::ToolPoints => POINTS,
        Command::ToolLine => LINE_TOOL,
        Command::ToolArc => ARC_TOOL,
        Command::ToolCurve => CURVE_TOOL,
        Command::ToolBezier => BEZIER_TOOL,
        Command::ToolNode => NODE_TOOL,
        Command::ToolStation => STATION_TOOL,
        Command::ToolMeasure => MEASURE,
        Command::ZoomToAll => ZOOM_TO_ALL,
        Command::ZoomIn => ZOOM_IN,
        Command::ZoomOut => ZOOM_OUT,
        Command::Find => FIND,
        _ => return None,
    })
}

/// An icon in its square.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Icon {
    pub(super) command: Command,
    pub(super) square: Rect,
    pub(super) color: Color32,
}

/// Icons as triangles, which stay the same from frame to frame.
struct PaintedIcons {
    icons: Vec<Icon>,
    px_per_point: f32,
    mesh: Arc<Mesh>,
}

/// Paints icons. Their triangles are made anew only when one has changed: that takes longer than
/// all else about a button.
pub(super) fn paint(ui: &Ui, id: Id, icons: Vec<Icon>) {
    let px_per_point = ui.pixels_per_point();
    let painted = ui.data(|data| data.get_temp::<Arc<PaintedIcons>>(id));
    let is_same =
        |last: &Arc<PaintedIcons>| last.px_per_point == px_per_point && last.icons == icons;
    if let Some(painted) = painted.filter(is_same) {
        ui.painter().add(Shape::Mesh(Arc::clone(&painted.mesh)));
        return;
    }
    let options = ui.ctx().tessellation_options(|options| *options);
    let mut tessellator = Tessellator::new(px_per_point, options, [1, 1], Vec::new());
    let mut mesh = Mesh::default();
    for shape in icons.iter().flat_map(shapes) {
        tessellator.tessellate_shape(shape, &mut mesh);
    }
    let mesh = Arc::new(mesh);
    ui.painter().add(Shape::Mesh(Arc::clone(&mesh)));
    let painted = PaintedIcons {
        icons,
        px_per_point,
        mesh,
    };
    ui.data_mut(|data| data.insert_temp(id, Arc::new(painted)));
}

fn shapes(icon: &Icon) -> impl Iterator<Item = Shape> {
    let (min, side) = (icon.square.min, icon.square.width());
    let at = move |[x, y]: &[f32; 2]| -> Pos2 { min + Vec2::new(*x, *y) * (side / SIDE) };
    let stroke = Stroke::new((LINE * side).max(1.0), icon.color);
    let lines = lines(icon.command).unwrap_or_default().iter();
    lines.map(move |line| Shape::line(line.iter().map(at).collect(), stroke))
}
