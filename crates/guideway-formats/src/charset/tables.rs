//! The tables of `encoding_rs`.

use encoding_rs::{DecoderResult, Encoding, WINDOWS_1252};

pub(super) fn name_of_label(label: &[u8]) -> Option<&'static str> {
    Encoding::for_label_no_replacement(label).map(Encoding::name)
}

pub(super) fn decode(name: &str, bytes: &[u8]) -> (String, bool) {
    let (text, is_wrong) = encoding(name).decode_without_bom_handling(bytes);
    (text.into_owned(), is_wrong)
}

pub(super) fn decode_strictly(name: &str, bytes: &[u8]) -> Result<String, Option<usize>> {
    let mut decoder = encoding(name).new_decoder_without_bom_handling();
    let length = decoder.max_utf8_buffer_length_without_replacement(bytes.len());
    let mut text = String::new();
    text.try_reserve_exact(length.unwrap_or(usize::MAX))
        .map_err(|_| None)?;
    match decoder.decode_to_string_without_replacement(bytes, &mut text, true) {
        (DecoderResult::InputEmpty, _) => Ok(text),
        (_, read) => Err(Some(read)),
    }
}

/// Every name comes from this library or from the constants, which are its names.
fn encoding(name: &str) -> &'static Encoding {
    Encoding::for_label(name.as_bytes()).unwrap_or(WINDOWS_1252)
}
