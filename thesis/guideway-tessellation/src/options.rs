//! Options of the method: reads and writes the words after its name.

use std::fmt;

/// The draw commands for visible paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Commands {
    /// One indirect command per path, as in the thesis.
    #[default]
    PerPath,
    /// A single command for the patches of all visible paths.
    Compact,
}

/// Antialiasing of lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialias {
    /// No antialiasing: a pixel is either line or background.
    #[default]
    None,
    /// Eight samples per pixel, or four if the device has no more.
    Multisample,
}

impl Antialias {
    /// Samples per pixel on a device with at most `max_samples`.
    pub(crate) fn samples(self, max_samples: u32) -> u32 {
        match self {
            Self::None => 1,
            Self::Multisample => max_samples.min(8),
        }
    }
}

/// Options of method `tessellation`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessellationOptions {
    /// The draw commands for visible paths.
    pub commands: Commands,
    /// Antialiasing of lines.
    pub antialias: Antialias,
}

const KNOWN: &str = "aa=none, aa=multisample";

/// An option that the method does not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown option `{option}`; known are: {}", KNOWN)]
pub struct UnknownOption {
    /// The option as written.
    pub option: String,
}

impl TessellationOptions {
    /// Parses the options after the name of the method, such as `aa=multisample`, joined by `+`.
    /// Other options have their default; the name itself selects the [`Commands`].
    ///
    /// # Errors
    /// When an option is unknown: the error names it and all known ones.
    pub fn parse(text: &str) -> Result<Self, UnknownOption> {
        let mut options = Self::default();
        for option in text.split('+').filter(|option| !option.is_empty()) {
            options.antialias = match option {
                "aa=none" => Antialias::None,
                "aa=multisample" => Antialias::Multisample,
                _ => {
                    let option = option.to_owned();
                    return Err(UnknownOption { option });
                }
            };
        }
        Ok(options)
    }
}

/// Writes all options that differ from their default, in the syntax of
/// [`TessellationOptions::parse`].
impl fmt::Display for TessellationOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.antialias {
            Antialias::None => Ok(()),
            Antialias::Multisample => f.write_str("aa=multisample"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_what_display_writes_and_names_unknown_options() {
        for antialias in [Antialias::None, Antialias::Multisample] {
            let options = TessellationOptions {
                antialias,
                ..TessellationOptions::default()
            };
            assert_eq!(
                TessellationOptions::parse(&options.to_string()),
                Ok(options)
            );
        }
        assert!(TessellationOptions::default().to_string().is_empty());
        for known in KNOWN.split(", ") {
            assert!(TessellationOptions::parse(known).is_ok(), "{known}");
        }
        for bad in ["aa", "aa=smooth", "aa=none;", "commands=compact"] {
            let error = TessellationOptions::parse(bad).unwrap_err().to_string();
            assert!(error.contains(bad) && error.contains(KNOWN), "{error}");
        }
    }
}
