//! The interface between the window and the program around it.
//!
//! The window implements no file format and no render method. The program passes both in as
//! [`AppServices`].

mod app_services;
mod job;
mod picture_request;

pub use app_services::{AppServices, LoadStage, MethodChoice};
pub use job::Job;
pub use picture_request::{FloorPlan, PictureRequest, SweptAreas};

/// Code of the errors that the window itself reports.
pub(crate) const WINDOW_ERROR: &str = "window";
