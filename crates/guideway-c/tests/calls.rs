//! Calls with arguments that a program in C gets wrong, and with memory that has gaps.

#![expect(
    unsafe_code,
    clippy::undocumented_unsafe_blocks,
    reason = "calls of the C interface, with pointers of this function or NULL"
)]
#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

use std::ffi::{CStr, CString, c_char, c_void};
use std::ptr::{null, null_mut};

use guideway_c::*;

const SITE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../guideway/examples/site.lif.json"
);

/// Code and message of the last error.
fn last_error() -> (String, String) {
    let text = |text: *const c_char| unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned();
    let error = unsafe { &*guideway_last_error() };
    (text(error.code), text(error.message))
}

fn open(file: &str) -> *mut GuidewayLayout {
    let file = CString::new(file).unwrap();
    unsafe { guideway_layout_open(file.as_ptr()) }
}

#[test]
fn null_is_refused_by_name() {
    let layout = open(SITE);
    let name = c"dock-1".as_ptr();
    let drawing = unsafe { guideway_drawing_new(layout, null(), null()) };
    let mut view = GuidewayView {
        center_x_m: 0.0,
        center_y_m: 0.0,
        px_per_m: 1.0,
        width_px: 2,
        height_px: 2,
    };
    let mut rgba = [0; 16];
    let refuses = |argument: &str, failed: bool| {
        let (code, message) = last_error();
        assert!(failed, "{argument}");
        assert_eq!(code, "argument");
        assert!(
            message.contains(&format!("`{argument}` is NULL")),
            "{message}"
        );
    };
    let failed = GuidewayStatus::Failed;
    unsafe {
        refuses("file", guideway_layout_open(null()).is_null());
        refuses(
            "name",
            guideway_layout_from_bytes(null(), null(), 0).is_null(),
        );
        refuses(
            "data",
            guideway_layout_from_bytes(name, null(), 1).is_null(),
        );
        refuses("layout", guideway_layout_info(null()).is_null());
        refuses(
            "layout",
            guideway_layout_save(null(), name, null_mut()) == failed,
        );
        refuses(
            "file",
            guideway_layout_save(layout, null(), null_mut()) == failed,
        );
        let write = |layout, format| {
            guideway_layout_write(layout, format, None, null_mut(), null_mut()) == failed
        };
        refuses("layout", write(null(), name));
        refuses("format", write(layout, null()));
        refuses("callback", write(layout, c"lif".as_ptr()));
        refuses(
            "layout",
            guideway_layout_check(null(), None, null_mut()) == failed,
        );
        refuses(
            "callback",
            guideway_layout_check(layout, None, null_mut()) == failed,
        );
        refuses(
            "layout",
            guideway_layout_route(null(), name, name, null()).is_null(),
        );
        refuses(
            "start",
            guideway_layout_route(layout, null(), name, null()).is_null(),
        );
        refuses(
            "goal",
            guideway_layout_route(layout, name, null(), null()).is_null(),
        );
        refuses("stream", guideway_layout_from_arrow(null_mut()).is_null());
        refuses(
            "layout",
            guideway_layout_to_arrow(null(), null_mut()) == failed,
        );
        refuses(
            "stream",
            guideway_layout_to_arrow(layout, null_mut()) == failed,
        );
        refuses(
            "layout",
            guideway_drawing_new(null(), null(), null()).is_null(),
        );
        refuses(
            "drawing",
            guideway_drawing_fit(null(), 1, 1, &raw mut view) == failed,
        );
        refuses(
            "view",
            guideway_drawing_fit(drawing, 1, 1, null_mut()) == failed,
        );
        let render = |drawing, view, rgba| {
            guideway_drawing_render(drawing, view, 0, rgba, 8, null_mut()) == failed
        };
        refuses(
            "drawing",
            render(null_mut(), &raw const view, rgba.as_mut_ptr()),
        );
        refuses("view", render(drawing, null(), rgba.as_mut_ptr()));
        refuses("rgba", render(drawing, &raw const view, null_mut()));
        let hit = |drawing, view| {
            guideway_drawing_hit_test(drawing, view, 0.0, 0.0, 1.0, null_mut(), null_mut())
                == failed
        };
        refuses("drawing", hit(null(), &raw const view));
        refuses("view", hit(drawing, null()));
        refuses("element", hit(drawing, &raw const view));
        guideway_text_free(null_mut());
        guideway_layout_free(null_mut());
        guideway_drawing_free(null_mut());
        guideway_layout_free(layout);
        guideway_drawing_free(drawing);
    }
}

#[test]
fn rows_have_their_stride_and_gaps_stay() {
    const STRIDE: usize = 4 * 64 + 12;
    let layout = open(SITE);
    let mut view = GuidewayView {
        center_x_m: 0.0,
        center_y_m: 0.0,
        px_per_m: 1.0,
        width_px: 0,
        height_px: 0,
    };
    // The last row needs no gap.
    let mut rgba = vec![7; STRIDE * 36 - 12];
    let drawn = unsafe {
        let drawing = guideway_drawing_new(layout, null(), null());
        // The drawing needs the layout no more.
        guideway_layout_free(layout);
        assert_eq!(
            guideway_drawing_fit(drawing, 64, 36, &raw mut view),
            GuidewayStatus::Ok
        );
        let view = &raw const view;
        let narrow = guideway_drawing_render(drawing, view, 0, rgba.as_mut_ptr(), 255, null_mut());
        assert_eq!(narrow, GuidewayStatus::Failed);
        let drawn = guideway_drawing_render(
            drawing,
            view,
            0x0102_0300,
            rgba.as_mut_ptr(),
            STRIDE,
            null_mut(),
        );
        guideway_drawing_free(drawing);
        drawn
    };
    assert_eq!(drawn, GuidewayStatus::Ok);
    let rows: Vec<&[u8]> = rgba.chunks(STRIDE).collect();
    assert_eq!(rows.len(), 36);
    assert!(
        rows.iter()
            .all(|row| row[4 * 64..].iter().all(|byte| *byte == 7))
    );
    let is_drawn = |row: &&[u8]| {
        row[..4 * 64]
            .as_chunks::<4>()
            .0
            .iter()
            .any(|of| of[3] == 255)
    };
    assert!(rows.iter().any(is_drawn));
    assert!(
        rows.iter().any(|row| row[3] == 0),
        "the background is transparent"
    );
}

#[test]
fn errors_are_those_of_the_command_and_callbacks_stop() {
    unsafe extern "C" fn go_on(_: *const GuidewayFinding, count: *mut c_void) -> i32 {
        unsafe { *count.cast::<u32>() += 1 };
        0
    }
    unsafe extern "C" fn stop(finding: *const GuidewayFinding, count: *mut c_void) -> i32 {
        unsafe { go_on(finding, count) };
        1
    }
    unsafe extern "C" fn full(_: *const u8, _: usize, calls: *mut c_void) -> i32 {
        unsafe { *calls.cast::<u32>() += 1 };
        28
    }
    assert!(open("no-such.lif.json").is_null());
    assert!(
        last_error().1.starts_with("no-such.lif.json: "),
        "{:?}",
        last_error()
    );
    let faulty = br#"{
        "metaInformation": {"lifVersion": "1.0.0"},
        "layouts": [{"layoutId": "a", "nodes": [
            {"nodeId": "n", "nodePosition": {"x": 0, "y": 0}},
            {"nodeId": "n", "nodePosition": {"x": 1, "y": 0}}
        ], "edges": [{"edgeId": "e", "startNodeId": "n", "endNodeId": "gone"}]}]
    }"#;
    unsafe {
        let name = c"faulty.lif.json".as_ptr();
        let layout = guideway_layout_from_bytes(name, faulty.as_ptr(), faulty.len());
        let (mut all, mut count) = (0u32, 0u32);
        let user = (&raw mut all).cast();
        assert_eq!(
            guideway_layout_check(layout, Some(go_on), user),
            GuidewayStatus::Ok
        );
        assert!(all > 1, "{all}");
        let user = (&raw mut count).cast();
        assert_eq!(
            guideway_layout_check(layout, Some(stop), user),
            GuidewayStatus::Ok
        );
        assert_eq!(count, 1);
        let mut calls = 0u32;
        let user = (&raw mut calls).cast();
        let written = guideway_layout_write(layout, c"lif".as_ptr(), Some(full), user, null_mut());
        assert_eq!(written, GuidewayStatus::Failed);
        assert_eq!(calls, 1, "it stopped");
        assert!(last_error().1.contains("returned 28"), "{:?}", last_error());
        let no_format =
            guideway_layout_write(layout, c"xls".as_ptr(), None, null_mut(), null_mut());
        assert_eq!(no_format, GuidewayStatus::Failed);
        assert!(last_error().1.contains("`xls`"));
        guideway_layout_free(layout);
    }
}
