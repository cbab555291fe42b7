//! The interface between the window and the program around it.
//!
//! The window implements no file format and no render method. The program passes both in as
//! [`AppServices`].

mod app_services;
mod file_stamp;
mod job;
mod picture_request;
mod window_error;

pub use app_services::{AppServices, LoadStage, MethodChoice};
pub use file_stamp::FileStamp;
pub use job::Job;
pub use picture_request::{PictureRequest, SweptAreas};
pub(crate) use window_error::WINDOW_ERROR;
