//! Names that the files and the report of a run share.

/// Name of the report, in the JSON answer and in the run file.
pub(super) const REPORT: &str = "reproduce";
/// Name of the file that holds the measurements of a run.
pub(super) const RUN_FILE: &str = "run.json";
