//! [`GuidewayDrawing`]: a layout prepared for pictures; draws views into memory of the caller, and
//! finds the element under a pointer.

use std::ffi::{CString, c_char};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock};
use std::time::Instant;

use guideway::cpu::Cpu;
use guideway::document::{Element, Index, pick_element};
use guideway::layout::UserError;
use guideway::scene::{
    Budget, Cancel, ColorBy, Frame, FrameSize, Method, Prepared, Rgba, Scene, SceneOptions, Style,
    View,
};
use guideway::spline::Point;

use crate::arguments::{optional_text, reference, refused, write};
use crate::border::{GuidewayStatus, owned, status};
use crate::error::c_text;
use crate::layout::GuidewayLayout;

/// Paths among which the one under a pointer is sought.
const MAX_CANDIDATES: usize = 100_000;
/// Bytes of a pixel: red, green, blue, alpha.
const PIXEL_BYTES: usize = 4;

/// A layout prepared for pictures.
pub struct GuidewayDrawing {
    scene: Arc<Scene>,
    index: OnceLock<Index>,
    state: Mutex<State>,
}

/// The method, and the last picture, whose memory the next one uses again.
type State = (Box<dyn Prepared>, Frame);

/// The part of a layout that a picture shows, and its size.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct GuidewayView {
    /// The point in the middle of the picture, in meters.
    pub center_x_m: f64,
    /// The point in the middle of the picture, in meters.
    pub center_y_m: f64,
    /// Pixels per meter.
    pub px_per_m: f64,
    /// Width in pixels.
    pub width_px: u32,
    /// Height in pixels.
    pub height_px: u32,
}

/// The account of a picture: drawn + culled + hidden + refused = total.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct GuidewayReport {
    /// Paths of the layout.
    pub total: u64,
    /// Paths in the picture.
    pub drawn: u64,
    /// Paths outside the view.
    pub culled: u64,
    /// Paths of other levels.
    pub hidden: u64,
    /// Paths that cannot be drawn: `guideway_layout_check` has the reasons.
    pub refused: u64,
    /// Time of the call in milliseconds.
    pub elapsed_ms: f64,
}

/// Kind of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum GuidewayElementKind {
    /// There is no element.
    None = 0,
    /// A path.
    Path = 1,
    /// A node.
    Node = 2,
    /// A station.
    Station = 3,
}

/// An element of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct GuidewayElement {
    /// Its kind.
    pub kind: GuidewayElementKind,
    /// Its row in the table of its kind, from 0.
    pub row: u32,
}

/// Prepares pictures of a layout. Free the drawing with `guideway_drawing_free`.
///
/// `color_by` is a column of the paths by whose values they are colored, such as "maxSpeed", and
/// `level` the level to show. Either may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_drawing_new(
    layout: *const GuidewayLayout,
    color_by: *const c_char,
    level: *const c_char,
) -> *mut GuidewayDrawing {
    owned(|| {
        // SAFETY: the caller passes a layout.
        let layout = unsafe { reference(layout, "layout") }?;
        // SAFETY: the caller passes texts, or NULL.
        let (color_by, level) = unsafe {
            (
                optional_text(color_by, "color_by")?,
                optional_text(level, "level")?,
            )
        };
        let options = SceneOptions {
            color_by: color_by.map(|column| ColorBy {
                column: column.to_owned(),
            }),
            level: level.map(str::to_owned),
            ..SceneOptions::default()
        };
        let scene = Arc::new(Scene::new(Arc::clone(&layout.0), &options)?);
        let prepared = Cpu.prepare(Arc::clone(&scene), &Budget::default())?;
        Ok(GuidewayDrawing {
            scene,
            index: OnceLock::new(),
            state: Mutex::new((prepared, Frame::new(FrameSize::new(1, 1)?))),
        })
    })
}

/// Frees a drawing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_drawing_free(drawing: *mut GuidewayDrawing) {
    if !drawing.is_null() {
        // SAFETY: `owned` made it of a box, and the caller gives it back.
        drop(unsafe { Box::from_raw(drawing) });
    }
}

/// Writes the view that shows the whole layout in a picture of this size to `view`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_drawing_fit(
    drawing: *const GuidewayDrawing,
    width_px: u32,
    height_px: u32,
    view: *mut GuidewayView,
) -> GuidewayStatus {
    status(|| {
        // SAFETY: the caller passes a drawing.
        let drawing = unsafe { reference(drawing, "drawing") }?;
        let fit = View::fit(FrameSize::new(width_px, height_px)?, drawing.scene.bounds())?;
        let fit = GuidewayView {
            center_x_m: fit.center_m().x,
            center_y_m: fit.center_m().y,
            px_per_m: fit.px_per_m(),
            width_px,
            height_px,
        };
        // SAFETY: the caller passes a place for a view.
        unsafe { write(view, fit, "view") }
    })
}

/// Draws a view: red, green, blue and alpha of each pixel, rows from the top, each row
/// `stride_bytes` after the one before. Bytes between the rows stay as they are. Alpha is straight.
///
/// `background` is the color below all paths as 0xRRGGBBAA: 0xFFFFFFFF is white, 0 transparent.
/// `report` may be NULL.
///
/// `rgba` has `stride_bytes` times the height of the view bytes; of the last row, four bytes per
/// pixel are enough. No other thread uses them meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_drawing_render(
    drawing: *mut GuidewayDrawing,
    view: *const GuidewayView,
    background: u32,
    rgba: *mut u8,
    stride_bytes: usize,
    report: *mut GuidewayReport,
) -> GuidewayStatus {
    status(|| {
        let started = Instant::now();
        // SAFETY: the caller passes a drawing and a view.
        let (drawing, view) = unsafe { (reference(drawing.cast_const(), "drawing")?, seen(view)?) };
        // SAFETY: the caller passes the first byte, which is not read.
        unsafe {
            reference(
                rgba.cast_const().cast::<std::mem::MaybeUninit<u8>>(),
                "rgba",
            )
        }?;
        let row_bytes = view.size().width() as usize * PIXEL_BYTES;
        if stride_bytes < row_bytes {
            let message = format!("rows of {row_bytes} bytes every {stride_bytes} bytes");
            return Err(refused(
                message,
                "Pass a stride of 4 bytes per pixel or more",
            ));
        }
        let mut state = drawing.state()?;
        let (prepared, frame) = &mut *state;
        frame.resize(view.size());
        let style = Style {
            background: Rgba::from_u32(background),
            ..Style::default()
        };
        let drawn = prepared.render(&view, &style, &Cancel::default(), frame)?;
        for (row, bytes) in frame.bytes().chunks_exact(row_bytes).enumerate() {
            // SAFETY: the caller's memory has this row, and is not the frame's.
            unsafe {
                let to = rgba.add(row * stride_bytes);
                to.copy_from_nonoverlapping(bytes.as_ptr(), row_bytes);
            }
        }
        if !report.is_null() {
            let account = GuidewayReport {
                total: drawn.total,
                drawn: drawn.drawn,
                culled: drawn.culled,
                hidden: drawn.hidden,
                refused: drawn.refused,
                elapsed_ms: started.elapsed().as_secs_f64() * 1e3,
            };
            // SAFETY: the caller passes a place for a report.
            unsafe { write(report, account, "report") }?;
        }
        Ok(())
    })
}

/// Finds the station, node or path at a pixel of a view, within `reach_px` pixels, and writes it to
/// `element`; its kind is GUIDEWAY_ELEMENT_KIND_NONE if there is none.
///
/// Unless `id` is NULL it receives the identifier of the element, or NULL if there is none; free it
/// with `guideway_text_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_drawing_hit_test(
    drawing: *const GuidewayDrawing,
    view: *const GuidewayView,
    x_px: f64,
    y_px: f64,
    reach_px: f64,
    element: *mut GuidewayElement,
    id: *mut *mut c_char,
) -> GuidewayStatus {
    status(|| {
        // SAFETY: the caller passes a drawing and a view.
        let (drawing, view) = unsafe { (reference(drawing, "drawing")?, seen(view)?) };
        let layout = drawing.scene.layout();
        let index = drawing.index.get_or_init(|| Index::new(layout));
        let rule = Style::default().line_rule;
        let at = Point::new(x_px, y_px);
        let place = (&*drawing.scene, index);
        let hit = pick_element(place, rule, &view, at, reach_px, MAX_CANDIDATES);
        let (kind, row) = match hit {
            None => (GuidewayElementKind::None, 0),
            Some(Element::Path(row)) => (GuidewayElementKind::Path, row),
            Some(Element::Node(row)) => (GuidewayElementKind::Node, row),
            Some(Element::Station(row)) => (GuidewayElementKind::Station, row),
        };
        // SAFETY: the caller passes a place for an element.
        unsafe { write(element, GuidewayElement { kind, row }, "element") }?;
        if !id.is_null() {
            let name = hit.map(|hit| c_text(hit.id(layout)));
            let name = name.map_or(std::ptr::null_mut(), CString::into_raw);
            // SAFETY: the caller passes a place for a pointer.
            unsafe { write(id, name, "id") }?;
        }
        Ok(())
    })
}

impl GuidewayDrawing {
    /// The method and its frame, prepared anew where a fault stopped the last picture.
    fn state(&self) -> Result<MutexGuard<'_, State>, UserError> {
        match self.state.lock() {
            Ok(state) => Ok(state),
            Err(poisoned) => {
                let mut state = poisoned.into_inner();
                state.0 = Cpu.prepare(Arc::clone(&self.scene), &Budget::default())?;
                self.state.clear_poison();
                Ok(state)
            }
        }
    }
}

/// A view of C as one of Rust.
///
/// # Safety
/// It is NULL, or a view.
unsafe fn seen(view: *const GuidewayView) -> Result<View, UserError> {
    // SAFETY: as above.
    let view = unsafe { reference(view, "view") }?;
    let size = FrameSize::new(view.width_px, view.height_px)?;
    let center_m = Point::new(view.center_x_m, view.center_y_m);
    Ok(View::new(size, center_m, view.px_per_m)?)
}
