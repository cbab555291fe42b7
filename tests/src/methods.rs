//! Methods on the processor to test, and functions that draw with any method.

use std::sync::Arc;

use guideway_cpu::{Cpu, Oracle};
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, Prepared, RenderError, Report, Style, View,
};

use crate::BoxError;
use crate::compare::Tolerance;
use crate::sketch::Drawing;

/// A method to compare with the oracle.
pub struct Candidate {
    /// The method.
    pub method: Box<dyn Method>,
    /// Limit of its difference from the oracle.
    pub tolerance: Tolerance,
}

/// Every method on the processor except the oracle.
pub fn methods() -> Vec<Candidate> {
    vec![Candidate {
        method: Box::new(Cpu),
        tolerance: Tolerance::STANDARD,
    }]
}

/// Prepares and draws a drawing once.
///
/// # Errors
/// The error of the method.
///
/// # Panics
/// When the options of the drawing name a missing level or column.
pub fn draw(
    method: &dyn Method,
    drawing: &Drawing,
    budget: &Budget,
) -> Result<(Frame, Report), RenderError> {
    let mut prepared = method.prepare(Arc::new(drawing.scene()), budget)?;
    render_view(prepared.as_mut(), &drawing.view, &drawing.style)
}

/// Draws a view of a prepared scene.
///
/// # Errors
/// The error of the method.
pub fn render_view(
    prepared: &mut dyn Prepared,
    view: &View,
    style: &Style,
) -> Result<(Frame, Report), RenderError> {
    // One pixel: the method must resize the frame.
    let mut frame = Frame::new(FrameSize::new(1, 1)?);
    let report = prepared.render(view, style, &Cancel::default(), &mut frame)?;
    Ok((frame, report))
}

/// Draws with the oracle.
///
/// # Panics
/// When the oracle fails.
pub fn draw_reference(drawing: &Drawing) -> (Frame, Report) {
    draw(&Oracle, drawing, &Budget::default()).expect("the oracle draws everything")
}

/// Checks that a report counts every path of its drawing.
///
/// # Errors
/// When a count is wrong: the message holds the report.
pub fn check_counts(report: &Report, drawing: &Drawing) -> Result<(), BoxError> {
    let layout = &drawing.layout;
    if report.total != layout.path_count() as u64
        || report.refused != layout.refused.len() as u64
        || !report.accounts_for_all()
    {
        return Err(format!("the report does not count every path: {report:?}").into());
    }
    Ok(())
}
