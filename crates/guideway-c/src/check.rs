//! The findings about a layout, each handed to a callback.

use std::ffi::{CString, c_char, c_void};

use guideway::layout::{Diagnostic, Severity};

use crate::arguments::{reference, refused};
use crate::border::{GuidewayStatus, status};
use crate::error::c_text;
use crate::layout::GuidewayLayout;

/// The weight of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum GuidewaySeverity {
    /// It is a fact worth knowing.
    Info = 0,
    /// Something is doubtful.
    Warning = 1,
    /// Something is wrong.
    Error = 2,
}

/// A finding. Its texts are valid during the callback.
#[derive(Debug)]
#[repr(C)]
pub struct GuidewayFinding {
    /// Its weight.
    pub severity: GuidewaySeverity,
    /// Line of the file, from 1; 0 if it is not known.
    pub line: u32,
    /// Column in the line, from 1; 0 if it is not known.
    pub column: u32,
    /// Stable name of the kind of finding, for programs.
    pub code: *const c_char,
    /// The element that it is about.
    pub element: *const c_char,
    /// The finding, without final period.
    pub message: *const c_char,
    /// The action that resolves it, without final period.
    pub remedy: *const c_char,
}

/// Receives a finding. Returns 0 to go on, another number to stop.
pub type GuidewayFindingCallback =
    Option<unsafe extern "C" fn(finding: *const GuidewayFinding, user: *mut c_void) -> i32>;

/// Checks a layout and hands each finding to a callback, which receives `user` too: those of the
/// reader, of the geometry and of the network.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_check(
    layout: *const GuidewayLayout,
    callback: GuidewayFindingCallback,
    user: *mut c_void,
) -> GuidewayStatus {
    status(|| {
        // SAFETY: the caller passes a layout.
        let layout = unsafe { reference(layout, "layout") }?;
        let Some(callback) = callback else {
            let message = "the argument `callback` is NULL".to_owned();
            return Err(refused(message, "Pass a function"));
        };
        for finding in guideway::check(&layout.0).iter() {
            let texts = texts(finding);
            let [code, element, message, remedy] = texts.each_ref().map(|text| text.as_ptr());
            let shown = GuidewayFinding {
                severity: match finding.severity {
                    Severity::Info => GuidewaySeverity::Info,
                    Severity::Warning => GuidewaySeverity::Warning,
                    Severity::Error => GuidewaySeverity::Error,
                },
                line: finding.place.line.unwrap_or(0),
                column: finding.place.column.unwrap_or(0),
                code,
                element,
                message,
                remedy,
            };
            // SAFETY: the finding and its texts live during the call, `user` is the callback's own.
            if unsafe { callback(&raw const shown, user) } != 0 {
                break;
            }
        }
        Ok(())
    })
}

fn texts(finding: &Diagnostic) -> [CString; 4] {
    let (message, remedy) = (&finding.message, &finding.remedy);
    [finding.code.name(), &finding.place.element, message, remedy].map(c_text)
}
