//! Colors of a report on a terminal: the words that begin its lines, such as `error:` and `hint:`,
//! and `--color`, which says where they have colors.

use std::ffi::{OsStr, OsString};

use anstream::ColorChoice;
use clap::ValueEnum;
use clap::builder::{EnumValueParser, PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue};
use guideway::scene::Rgba;

// Documented variants would be a list in each help.
/// The condition for colors of words: `Auto` means a terminal, unless `NO_COLOR` is set, or that
/// `CLICOLOR_FORCE` is set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum When {
    #[default]
    Auto,
    Always,
    Never,
}

impl When {
    /// The parser of `--color`. A color in its place belongs to `--path-color`.
    pub(super) fn parser() -> impl TypedValueParser<Value = Self> {
        WhenParser(EnumValueParser::new())
    }

    /// The value in arguments that do not parse; their error or help has colors too.
    pub(super) fn in_arguments(args: &[OsString]) -> Self {
        let following = args.iter().skip(1).map(Some).chain([None]);
        let mut values = args.iter().zip(following).filter_map(|(arg, next)| {
            let arg = arg.to_str()?;
            let value = match arg.strip_prefix("--color=") {
                Some(value) => Some(value),
                None if arg == "--color" => next?.to_str(),
                None => None,
            };
            Self::from_str(value?, false).ok()
        });
        values.next().unwrap_or_default()
    }

    /// Holds for all that this process prints from now on.
    pub(super) fn apply(self) {
        let choice = match self {
            Self::Auto => ColorChoice::Auto,
            Self::Always => ColorChoice::Always,
            Self::Never => ColorChoice::Never,
        };
        choice.write_global();
    }
}

#[derive(Clone)]
struct WhenParser(EnumValueParser<When>);

impl TypedValueParser for WhenParser {
    type Value = When;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<When, clap::Error> {
        self.0
            .parse_ref(command, argument, value)
            .map_err(|mut error| {
                let text = value.to_string_lossy();
                if text.parse::<Rgba>().is_ok() {
                    let tip = format!("the color of paths is `--path-color {text}`");
                    let tip = ContextValue::StyledStrs(vec![tip.into()]);
                    error.insert(ContextKind::Suggested, tip);
                }
                error
            })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

/// The words and their colors (ECMA-48, select graphic rendition): bold red, yellow, blue, green.
const WORDS: [(&str, &str); 5] = [
    ("error", "\x1b[1;31m"),
    ("warning", "\x1b[1;33m"),
    ("info", "\x1b[1;34m"),
    ("note", "\x1b[1;34m"),
    ("hint", "\x1b[1;32m"),
];
const END: &str = "\x1b[0m";

/// Colors the first word of each line if it is a severity or a hint, with a colon, or behind a
/// count: `error: node-gap (2)`, `12  warning kink: ...`.
pub(crate) fn paint(text: &str) -> String {
    let mut painted = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let is_before = |c: char| c == ' ' || c == ',' || c.is_ascii_digit();
        let rest = line.trim_start_matches(is_before);
        let before = &line[..line.len() - rest.len()];
        let end = if before.trim().is_empty() { ':' } else { ' ' };
        let found = WORDS.iter().find_map(|(word, color)| {
            let after = rest.strip_prefix(word)?;
            after.starts_with(end).then_some((word, color, after))
        });
        painted += before;
        match found {
            Some((word, color, after)) => {
                for part in [*color, *word, END, after] {
                    painted += part;
                }
            }
            None => painted += rest,
        }
    }
    painted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_begin_a_line_have_colors() {
        let text = "error: kink (1)\n  - path \"a\": info\n    hint: do\n    \
                    1,234  warning kink: x\n";
        let painted = paint(text);
        assert_eq!(
            painted,
            "\x1b[1;31merror\x1b[0m: kink (1)\n  - path \"a\": info\n    \
             \x1b[1;32mhint\x1b[0m: do\n    \
             1,234  \x1b[1;33mwarning\x1b[0m kink: x\n"
        );
        for plain in [
            "errors: 2\n",
            "no hint: here",
            "12 errors",
            "error",
            "",
            "\n\n",
        ] {
            assert_eq!(paint(plain), plain);
        }
    }
}
