//! Options of the methods: reads, checks and writes the words after a name.

use std::fmt;

use guideway_grid::Antialias;

/// The structure over the segments, one per method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// A binary tree of boxes (LBVH): fitted again after edits, built again once it is worn out.
    Tree,
    /// Cells of a quadtree as sorted keys, built in each frame.
    Quadtree,
}

impl Structure {
    /// Name of the method in reports and errors.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tree => "tree",
            Self::Quadtree => "quadtree",
        }
    }
}

/// Options of a method. The default is what the thesis proposes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeOptions {
    /// Samples per segment, 2 to 64; a segment has one line less.
    pub samples: u32,
    /// The pixels of a tile walk together.
    pub tiles: bool,
    /// Skips what lies below pixels that are fully covered.
    pub early_exit: bool,
    /// Antialiasing of edges.
    pub antialias: Antialias,
}

impl Default for TreeOptions {
    fn default() -> Self {
        Self {
            samples: 10,
            tiles: false,
            early_exit: false,
            antialias: Antialias::default(),
        }
    }
}

/// The reason why options are rejected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OptionsError {
    /// The methods have no such option.
    #[error(
        "unknown option `{option}`; methods `tree` and `quadtree` take `tiles`, `exit`, \
         `aa=smooth`, `aa=none` or `aa=subpixel`, `samples=N`"
    )]
    Unknown {
        /// The option as written.
        option: String,
    },
    /// An option repeats an earlier one.
    #[error("`{text}`: `{option}` repeats or contradicts an earlier option; remove one of them")]
    Repeated {
        /// All options as written.
        text: String,
        /// The later one of the two options.
        option: String,
    },
    /// The samples per segment are out of range.
    #[error("invalid option `samples={samples}`: the range is 2 to 64")]
    Samples {
        /// The value as written.
        samples: String,
    },
}

impl TreeOptions {
    /// Parses the output of [`fmt::Display`]: words joined by `+`, such as
    /// `tiles+exit+aa=subpixel+samples=5`. Options without a word have their default.
    ///
    /// # Errors
    /// When a word is unknown, repeats an earlier one, or has a value out of range.
    pub fn parse(text: &str) -> Result<Self, OptionsError> {
        let mut options = Self::default();
        let mut topics: Vec<&str> = Vec::new();
        for word in text.split('+').filter(|_| !text.is_empty()) {
            let parts = word.split_once('=');
            let (topic, value) = parts.map_or((word, None), |(topic, value)| (topic, Some(value)));
            match (topic, value) {
                ("tiles", None) => options.tiles = true,
                ("exit", None) => options.early_exit = true,
                ("aa", Some("smooth")) => options.antialias = Antialias::Smooth,
                ("aa", Some("none")) => options.antialias = Antialias::None,
                ("aa", Some("subpixel")) => options.antialias = Antialias::Subpixel,
                ("samples", Some(number)) => {
                    options.samples = number.parse().map_err(|_| OptionsError::Samples {
                        samples: number.to_owned(),
                    })?;
                }
                _ => {
                    let option = word.to_owned();
                    return Err(OptionsError::Unknown { option });
                }
            }
            if topics.contains(&topic) {
                return Err(OptionsError::Repeated {
                    text: text.to_owned(),
                    option: word.to_owned(),
                });
            }
            topics.push(topic);
        }
        options.check()?;
        Ok(options)
    }

    /// Checks that all numbers are in range.
    ///
    /// # Errors
    /// When a number is out of range: the error names it and the range.
    pub fn check(&self) -> Result<(), OptionsError> {
        match self.samples {
            2..=64 => Ok(()),
            samples => Err(OptionsError::Samples {
                samples: samples.to_string(),
            }),
        }
    }

    /// Lines per segment.
    pub(super) fn lines_per_segment(&self) -> u32 {
        self.samples - 1
    }
}

impl fmt::Display for TreeOptions {
    /// Writes the words of [`TreeOptions::parse`] for all options that differ from their default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let antialias = match self.antialias {
            Antialias::Smooth => None,
            Antialias::None => Some("aa=none"),
            Antialias::Subpixel => Some("aa=subpixel"),
        };
        let samples = format!("samples={}", self.samples);
        let words = [
            self.tiles.then_some("tiles"),
            self.early_exit.then_some("exit"),
            antialias,
            (self.samples != Self::default().samples).then_some(samples.as_str()),
        ];
        let words: Vec<_> = words.into_iter().flatten().collect();
        f.write_str(&words.join("+"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_what_display_writes() {
        for text in [
            "",
            "tiles",
            "exit",
            "aa=none",
            "tiles+exit+aa=subpixel+samples=64",
        ] {
            assert_eq!(TreeOptions::parse(text).unwrap().to_string(), text);
        }
        assert_eq!(TreeOptions::parse("aa=smooth"), Ok(TreeOptions::default()));
    }

    #[test]
    fn names_the_wrong_option_and_the_limit() {
        for (text, named) in [
            ("tile", "unknown option `tile`"),
            ("tiles+", "unknown option ``"),
            ("aa=fast", "unknown option `aa=fast`"),
            ("samples=1", "2 to 64"),
            ("samples=", "2 to 64"),
            ("exit+exit", "`exit` repeats"),
        ] {
            let message = TreeOptions::parse(text).unwrap_err().to_string();
            assert!(message.contains(named), "{text}: {message}");
        }
    }
}
