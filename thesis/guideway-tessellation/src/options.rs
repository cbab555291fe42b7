use std::fmt;

/// How visible paths reach the tessellator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Commands {
    /// One indirect command a path, as the thesis has it.
    #[default]
    PerPath,
    /// One draw of the patches of all visible paths.
    Compact,
}

/// What is done against jagged lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialias {
    /// Nothing: a pixel is either line or background.
    #[default]
    None,
    /// Eight samples a pixel, or four where the device has no more.
    Multisample,
}

impl Antialias {
    /// Samples a pixel on a device that has at most so many.
    pub(crate) fn samples(self, most: u32) -> u32 {
        match self {
            Self::None => 1,
            Self::Multisample => most.min(8),
        }
    }
}

/// How method `tessellation` draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessellationOptions {
    /// How visible paths reach the tessellator.
    pub commands: Commands,
    /// What is done against jagged lines.
    pub antialias: Antialias,
}

const KNOWN: &str = "aa=none, aa=multisample";

impl TessellationOptions {
    /// Reads what may follow the name of the method, such as `aa=multisample`, with a plus sign between
    /// several. What is not named stays at its default; [`Commands`] are chosen by the name itself.
    ///
    /// # Errors
    /// When there is no such option: a sentence with those that there are.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut options = Self::default();
        for option in text.split('+').filter(|option| !option.is_empty()) {
            options.antialias = match option {
                "aa=none" => Antialias::None,
                "aa=multisample" => Antialias::Multisample,
                _ => return Err(format!("there is no option `{option}`; there is: {KNOWN}")),
            };
        }
        Ok(options)
    }
}

/// The options that are not at their default, as [`TessellationOptions::parse`] reads them.
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
    fn options_are_read_as_they_are_written() {
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
            let refused = TessellationOptions::parse(bad).unwrap_err();
            assert!(
                refused.contains(bad) && refused.contains(KNOWN),
                "{refused}"
            );
        }
    }
}
