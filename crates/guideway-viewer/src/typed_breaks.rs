//! [`TypedBreaks`]: the class breaks of the colors as they are typed.

use guideway_scene::ClassBreaks;

use crate::language::{say, translated};
use crate::units::decimal;

/// A text of class breaks, and the breaks of the last text that had no mistake.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TypedBreaks {
    text: String,
    breaks: Option<ClassBreaks>,
}

impl TypedBreaks {
    /// The text.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The breaks; `None` for a continuous scale.
    pub(crate) fn breaks(&self) -> Option<ClassBreaks> {
        self.breaks
    }

    /// Takes another text. One with a mistake leaves the breaks as they are.
    pub(crate) fn set_text(&mut self, text: String) {
        if let Ok(breaks) = parse(&text) {
            self.breaks = breaks;
        }
        self.text = text;
    }

    /// The mistake of the text, in the language of the window.
    pub(crate) fn error(&self) -> Option<String> {
        parse(&self.text).err()
    }
}

impl From<Option<ClassBreaks>> for TypedBreaks {
    fn from(breaks: Option<ClassBreaks>) -> Self {
        let numbers = breaks.iter().flat_map(ClassBreaks::numbers);
        let texts: Vec<String> = numbers.map(f64::to_string).collect();
        Self {
            text: texts.join(", "),
            breaks,
        }
    }
}

/// Reads numbers that blanks, semicolons or commas divide; `None` if there are none. Where blanks
/// or semicolons divide them, a comma within a number is its decimal point.
///
/// # Errors
/// The first mistake, for the user.
fn parse(text: &str) -> Result<Option<ClassBreaks>, String> {
    let is_divider = |sign: char| sign.is_whitespace() || sign == ';';
    let parts = text.split(is_divider).map(|part| part.trim_matches(','));
    let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
    let mut numbers = Vec::new();
    for part in &parts {
        match decimal(part).filter(|_| parts.len() > 1) {
            Some(number) => numbers.push(number),
            None => {
                for part in part.split(',').filter(|part| !part.is_empty()) {
                    numbers.push(number(part)?);
                }
            }
        }
    }
    if numbers.is_empty() {
        return Ok(None);
    }
    let breaks = ClassBreaks::new(&numbers);
    let breaks = breaks.map_err(|error| translated(&error.to_string()).into_owned());
    breaks.map(Some)
}

fn number(part: &str) -> Result<f64, String> {
    let value = part.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| say!("`{part}` is no number; write it as 1.5", part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, set_language};

    #[test]
    fn numbers_are_divided_as_people_divide_them() {
        for text in [
            "0.3 0.6 1",
            "0.3,0.6,1",
            "0.3, 0.6, 1",
            "0.3;0.6;1",
            " 0.3 ;0.6,1 ",
            "0,3 0,6 1",
            "0,3; 0,6; 1,0",
            "0,3, 0,6, 1",
        ] {
            let breaks = parse(text).unwrap().unwrap();
            assert_eq!(breaks.numbers(), [0.3, 0.6, 1.0], "{text}");
            let typed = TypedBreaks::from(Some(breaks));
            assert_eq!(typed.text(), "0.3, 0.6, 1");
            assert_eq!(parse(typed.text()), Ok(Some(breaks)));
        }
        let numbers = |text| parse(text).unwrap().unwrap().numbers().to_vec();
        assert_eq!(numbers("-2,5"), [-2.0, 5.0]);
        assert_eq!(numbers("1e3"), [1000.0]);
        for text in ["", " ", ",", ";"] {
            assert_eq!(parse(text), Ok(None), "{text}");
        }
    }

    #[test]
    fn mistakes_are_told_and_leave_the_breaks() {
        let mut typed = TypedBreaks::default();
        typed.set_text("0.5 1".into());
        let breaks = typed.breaks();
        assert!(breaks.is_some() && typed.error().is_none());
        let many: String = (0..16).map(|number| format!("{number} ")).collect();
        for (text, english, german) in [
            ("0.5 fast", "`fast` is no number", "„fast“ ist keine Zahl"),
            ("1e999", "`1e999` is no number", "„1e999“ ist keine Zahl"),
            ("1 0.5", "0.5 comes after 1", "0.5 kommt nach 1"),
            ("1 1", "1 comes after 1", "1 kommt nach 1"),
            (
                &*many,
                "there are 16 class breaks",
                "das sind 16 Klassengrenzen",
            ),
        ] {
            typed.set_text(text.into());
            let said = typed.error().unwrap();
            assert!(said.contains(english), "{text}: {said}");
            assert_eq!(typed.breaks(), breaks, "{text}");
            set_language(Language::German);
            let said = typed.error().unwrap();
            set_language(Language::English);
            assert!(said.contains(german), "{text}: {said}");
        }
        typed.set_text(String::new());
        assert_eq!(typed, TypedBreaks::default());
    }
}
