//! Exit codes of the command.

/// Outcome of a subcommand that ran to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Success.
    Clean,
    /// `check` found what it must not pass, or `diff --exit-code` found differences.
    Found,
    /// `check` could read no file, or `bench` measured no method.
    Failed,
    /// Ctrl-C stopped the command; its results so far are saved.
    Interrupted,
}

impl Exit {
    /// The exit code of the process.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Clean => 0,
            Self::Found => 1,
            Self::Failed => ERROR,
            Self::Interrupted => INTERRUPTED as u8,
        }
    }
}

/// Exit code of every error.
pub(crate) const ERROR: u8 = 2;
/// Exit code after Ctrl-C: 128 plus the number of the signal, the convention of shells.
pub(crate) const INTERRUPTED: i32 = 130;
