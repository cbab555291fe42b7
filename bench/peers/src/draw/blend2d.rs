//! Blend2D, by its C functions. The variable `BLEND2D_LIB_DIR` names the folder of the static
//! library, which the Python package `blend2d-python` 1.0.0 contains.

use std::ffi::c_void;
use std::mem::ManuallyDrop;
use std::slice;
use std::sync::Arc;

use anyhow::{Result, ensure};
use guideway_layout::{Layout, PathRef};
use guideway_scene::{Frame, View};

use super::shared::{FRAMES, WIDTH_PX, curves, store_words, time};

/// Builds the paths in every frame, or once if `REUSES_PATHS`. With zero threads, each call returns
/// when its pixels are drawn; with two, the calling thread is one of them.
pub(super) fn draw<const THREADS: u32, const REUSES_PATHS: bool>(
    layout: &Arc<Layout>,
    view: &View,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    const BLACK: u32 = 0xff00_0000;
    const WHITE: u32 = 0xffff_ffff;
    const ROUND_CAP: u32 = 2;
    const ROUND_JOIN: u32 = 4;
    let mut paths: Vec<Object> = Vec::new();
    let [width, height] = [view.size().width(), view.size().height()].map(|side| side as i32);
    // SAFETY: the function initializes the object that it gets.
    let mut image = Object::new(|image| unsafe { blImageInitAs(image, width, height, PRGB32) })?;
    let options = ContextOptions {
        threads: THREADS,
        ..ContextOptions::default()
    };
    let times_ms = time(FRAMES, |_| {
        if !REUSES_PATHS || paths.is_empty() {
            paths.clear();
            let built = layout.paths.iter().map(|path| build_path(&path, view));
            paths = built.collect::<Result<_>>()?;
        }
        // SAFETY: image, options and paths live longer than the context.
        let begin = |context: *mut _| unsafe { blContextInitAs(context, &mut image, &options) };
        let mut context = Object::new(begin)?;
        // SAFETY: each function gets an initialized object of its type. `blContextEnd` waits for
        // all drawing.
        unsafe {
            check(blContextFillAllRgba32(&mut context, WHITE))?;
            check(blContextSetStrokeWidth(&mut context, WIDTH_PX))?;
            check(blContextSetStrokeCaps(&mut context, ROUND_CAP))?;
            check(blContextSetStrokeJoin(&mut context, ROUND_JOIN))?;
            for path in &paths {
                check(blContextStrokePathDRgba32(
                    &mut context,
                    &[0.0; 2],
                    path,
                    BLACK,
                ))?;
            }
            check(blContextEnd(&mut context))
        }
    })?;
    copy_pixels(&image, frame)?;
    Ok(times_ms)
}

fn build_path(path: &PathRef<'_>, view: &View) -> Result<Object> {
    // SAFETY: `blPathInit` initializes the object; the other functions get an initialized path.
    let mut built = Object::new(|path| unsafe { blPathInit(path) })?;
    for run in curves(path, view) {
        for (i, [a, b, c, d]) in run.enumerate() {
            if i == 0 {
                check(unsafe { blPathMoveTo(&mut built, a.x, a.y) })?;
            }
            check(unsafe { blPathCubicTo(&mut built, b.x, b.y, c.x, c.y, d.x, d.y) })?;
        }
    }
    Ok(built)
}

fn copy_pixels(image: &Object, frame: &mut Frame) -> Result<()> {
    let mut data = ImageData::default();
    // SAFETY: `blImageGetData` states the address and stride of the rows, valid while the image
    // lives.
    check(unsafe { blImageGetData(image, &mut data) })?;
    let stride = usize::try_from(data.stride_bytes)?;
    let bytes = unsafe { slice::from_raw_parts(data.pixels, stride * data.height as usize) };
    store_words(bytes, stride, data.width as usize, frame);
    Ok(())
}

fn check(result: u32) -> Result<()> {
    ensure!(result == 0, "blend2d failed with error {result:#x}");
    Ok(())
}

/// Pixel format `BL_FORMAT_PRGB32`: premultiplied alpha, red, green, blue from high to low byte.
const PRGB32: u32 = 1;

/// `BLObjectCore`: an image, a path or a context.
#[repr(C)]
struct Object([u64; 2]);

impl Object {
    fn new(init: impl FnOnce(*mut Self) -> u32) -> Result<Self> {
        // A failed initialization leaves nothing to destroy.
        let mut object = ManuallyDrop::new(Self([0; 2]));
        check(init(&mut *object))?;
        Ok(ManuallyDrop::into_inner(object))
    }
}

impl Drop for Object {
    fn drop(&mut self) {
        // SAFETY: the object is initialized, and this is its last use.
        unsafe { blVarDestroy((&raw mut *self).cast()) };
    }
}

#[repr(C)]
#[derive(Default)]
struct ContextOptions {
    flags: u32,
    threads: u32,
    others: [u32; 6],
}

#[repr(C)]
#[derive(Default)]
struct ImageData {
    pixels: *mut u8,
    stride_bytes: isize,
    width: i32,
    height: i32,
    format: u32,
    flags: u32,
}

unsafe extern "C" {
    fn blVarDestroy(object: *mut c_void) -> u32;
    fn blImageInitAs(image: *mut Object, width: i32, height: i32, format: u32) -> u32;
    fn blImageGetData(image: *const Object, data: *mut ImageData) -> u32;
    fn blPathInit(path: *mut Object) -> u32;
    fn blPathMoveTo(path: *mut Object, x: f64, y: f64) -> u32;
    fn blPathCubicTo(
        path: *mut Object,
        x1: f64,
        y1: f64,
        x2: f64,
        y2: f64,
        x3: f64,
        y3: f64,
    ) -> u32;
    fn blContextInitAs(
        context: *mut Object,
        image: *mut Object,
        options: *const ContextOptions,
    ) -> u32;
    fn blContextFillAllRgba32(context: *mut Object, rgba32: u32) -> u32;
    fn blContextSetStrokeWidth(context: *mut Object, width: f64) -> u32;
    fn blContextSetStrokeCaps(context: *mut Object, cap: u32) -> u32;
    fn blContextSetStrokeJoin(context: *mut Object, join: u32) -> u32;
    fn blContextStrokePathDRgba32(
        context: *mut Object,
        origin: *const [f64; 2],
        path: *const Object,
        rgba32: u32,
    ) -> u32;
    fn blContextEnd(context: *mut Object) -> u32;
}
