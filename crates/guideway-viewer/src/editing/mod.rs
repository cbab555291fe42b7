//! The document of one open file, and everything that reads or changes it on other threads.
//!
//! | part | owns | file |
//! |---|---|---|
//! | [`DocumentSlot`] | document, queued edits, journal, overlay | `document_slot` |
//! | [`EditTask`] | one edit, run on another thread | `edit_task` |
//! | [`Journal`] | the record of unsaved edits | `journal`, `journal_file`, `journal_writes`, `unsaved_work` |
//! | [`Overlay`](overlay::Overlay) | marks and outlines of a view | `overlay` |
//! | [`BackgroundTasks`] | recoloring, queries, checks | `background_tasks` |

mod background_tasks;
mod document_slot;
mod edit_task;
mod findings;
mod journal;
mod journal_file;
mod journal_header;
mod journal_writes;
mod notice;
mod overlay;
mod unsaved_work;

pub(crate) use background_tasks::{BackgroundTasks, TaskEvent};
pub(crate) use document_slot::{DocumentSlot, EditReturn};
pub(crate) use edit_task::{EDIT_WAIT, EditOutcome, EditTask};
pub(crate) use findings::{Findings, MarkedSeverities, SEVERITIES};
pub(crate) use journal::Journal;
#[cfg(test)]
pub(crate) use journal_file::entries_on_disk;
pub(crate) use journal_file::{BaseCopy, JournalFile};
pub(crate) use overlay::{MovingOutline, OverlayContent};
pub(crate) use unsaved_work::UnsavedWork;
