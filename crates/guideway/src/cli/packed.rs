//! The texts that the build packs into the program, as gzip: unpacked where they are used.

use std::io::Read;

use flate2::read::GzDecoder;
use guideway::layout::UserError;

use super::error::usage_error;

/// The example site, part of the program so that the demo runs anywhere.
const SITE: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/site.lif.json.gz"));
/// JSON Schema of all answers: `$defs` has one per command.
const ANSWERS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/answers.schema.json.gz"));

/// The file of the example site.
///
/// # Errors
/// When the program is damaged.
pub(crate) fn site() -> Result<String, UserError> {
    unpacked(SITE, "the example site")
}

/// The schema of all answers.
///
/// # Errors
/// When the program is damaged.
pub(crate) fn answers() -> Result<String, UserError> {
    unpacked(ANSWERS, "the schema of answers")
}

/// The text in a packed file, which errors call `name`.
///
/// # Errors
/// When the file is damaged.
pub(crate) fn unpacked(file: &[u8], name: &str) -> Result<String, UserError> {
    let mut text = String::new();
    match GzDecoder::new(file).read_to_string(&mut text) {
        Ok(_) => Ok(text),
        Err(problem) => Err(usage_error(
            format!("{name} of this program is damaged: {problem}"),
            "Install the program again",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_texts_are_those_of_the_repository() {
        let site_file = include_str!("../../examples/site.lif.json");
        assert_eq!(site().unwrap(), site_file);
        let answers_file = include_str!("../../docs/answers.schema.json");
        assert_eq!(answers().unwrap(), answers_file);
    }

    #[test]
    fn damaged_text_is_an_error() {
        let damaged = &SITE[..SITE.len() / 2];
        let error = unpacked(damaged, "the example site").unwrap_err();
        assert!(error.to_string().contains("damaged"), "{error}");
    }
}
