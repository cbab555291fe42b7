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

/// How method `tessellation` draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessellationOptions {
    /// How visible paths reach the tessellator.
    pub commands: Commands,
    /// What is done against jagged lines.
    pub antialias: Antialias,
}

const KNOWN: &str = "commands=per-path, commands=compact, aa=none, aa=multisample";

impl TessellationOptions {
    /// Reads options such as `aa=multisample`, with a plus sign between several; what is not named stays at its
    /// default.
    ///
    /// # Errors
    /// When there is no such option: a sentence with those that there are.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut options = Self::default();
        for option in text.split('+').map(str::trim).filter(|o| !o.is_empty()) {
            match option {
                "commands=per-path" => options.commands = Commands::PerPath,
                "commands=compact" => options.commands = Commands::Compact,
                "aa=none" => options.antialias = Antialias::None,
                "aa=multisample" => options.antialias = Antialias::Multisample,
                _ => return Err(format!("there is no option `{option}`; there is: {KNOWN}")),
            }
        }
        Ok(options)
    }
}

/// The options that are not at their default, as [`TessellationOptions::parse`] reads them.
impl fmt::Display for TessellationOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let commands = match self.commands {
            Commands::PerPath => None,
            Commands::Compact => Some("commands=compact"),
        };
        let antialias = match self.antialias {
            Antialias::None => None,
            Antialias::Multisample => Some("aa=multisample"),
        };
        let set: Vec<_> = [commands, antialias].into_iter().flatten().collect();
        f.write_str(&set.join("+"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read_as_they_are_written() {
        let mut written = std::collections::HashSet::new();
        for commands in [Commands::PerPath, Commands::Compact] {
            for antialias in [Antialias::None, Antialias::Multisample] {
                let options = TessellationOptions {
                    commands,
                    antialias,
                };
                let text = options.to_string();
                assert_eq!(TessellationOptions::parse(&text), Ok(options));
                assert!(written.insert(text));
            }
        }
        for known in KNOWN.split(", ") {
            assert!(TessellationOptions::parse(known).is_ok(), "{known}");
        }
        for bad in ["aa", "aa=smooth", "aa=none;", "Commands=compact"] {
            let refused = TessellationOptions::parse(bad).unwrap_err();
            assert!(
                refused.contains(bad) && refused.contains(KNOWN),
                "{refused}"
            );
        }
    }
}
