//! The methods under test, and one way to run them all.

use std::sync::Arc;

use guideway_cpu::{Cpu, Oracle};
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, Prepared, RenderError, Report, Style, View,
};

use crate::compare::Tolerance;
use crate::sketch::Drawing;

/// A method that must agree with the oracle.
pub struct Candidate {
    /// The method.
    pub method: Box<dyn Method>,
    /// How far from the oracle it may be.
    pub tolerance: Tolerance,
}

/// Every method but the oracle.
pub fn methods() -> Vec<Candidate> {
    vec![Candidate {
        method: Box::new(Cpu),
        tolerance: Tolerance::STANDARD,
    }]
}

/// Draws once.
///
/// # Errors
/// What the method says.
///
/// # Panics
/// When the drawing's options name a level or column that it has not.
pub fn draw(
    method: &dyn Method,
    drawing: &Drawing,
    budget: &Budget,
) -> Result<(Frame, Report), RenderError> {
    let mut prepared = method.prepare(Arc::new(drawing.scene()), budget)?;
    show(prepared.as_mut(), &drawing.view, &drawing.style)
}

/// Draws a view of a scene that was made ready.
///
/// # Errors
/// What the method says.
pub fn show(
    prepared: &mut dyn Prepared,
    view: &View,
    style: &Style,
) -> Result<(Frame, Report), RenderError> {
    // One pixel: the method has to give the frame its size.
    let mut frame = Frame::new(FrameSize::new(1, 1)?);
    let report = prepared.render(view, style, &Cancel::default(), &mut frame)?;
    Ok((frame, report))
}

/// Draws by the oracle.
///
/// # Panics
/// When it fails: it has memory enough for every drawing here.
pub fn judge(drawing: &Drawing) -> (Frame, Report) {
    draw(&Oracle, drawing, &Budget::default()).expect("the oracle draws everything")
}

/// Whether a report accounts for every path of its drawing.
///
/// # Errors
/// When it does not: a sentence with the report.
pub fn account(report: &Report, drawing: &Drawing) -> Result<(), String> {
    let layout = &drawing.layout;
    if report.total != layout.path_count() as u64
        || report.refused != layout.refused.len() as u64
        || !report.accounts_for_all()
    {
        return Err(format!("not every path is accounted for: {report:?}"));
    }
    Ok(())
}
