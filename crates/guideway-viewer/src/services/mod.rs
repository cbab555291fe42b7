//! The interface between the window and the program around it.
//!
//! The window implements no file format and no render method. The program passes both in as
//! [`AppServices`].

mod app_services;
mod file_question;
mod file_stamp;
mod folder;
mod job;
mod picture_request;
mod saved;

pub(crate) use app_services::WINDOW_ERROR;
pub use app_services::{AppServices, LoadStage, MAX_PROJECT_BYTES, MethodChoice};
pub use file_question::{FileAnswer, FileFormat, FileQuestion, PendingFileAnswer};
pub use file_stamp::FileStamp;
pub(crate) use folder::names_in;
pub use job::Job;
pub use picture_request::{PictureRequest, SweptAreas};
pub use saved::{LostPart, Saved};
