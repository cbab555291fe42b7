//! The tables of the browser, by its `TextDecoder`.

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    type TextDecoder;

    #[wasm_bindgen(constructor, catch)]
    fn new(label: &str, options: &JsValue) -> Result<TextDecoder, JsValue>;

    #[wasm_bindgen(method, getter)]
    fn encoding(this: &TextDecoder) -> String;

    #[wasm_bindgen(method, catch)]
    fn decode(this: &TextDecoder, bytes: &JsValue, options: &JsValue) -> Result<String, JsValue>;

    /// A copy: memory that threads share, no decoder takes.
    #[wasm_bindgen(js_namespace = ["Uint8Array", "prototype", "slice"], js_name = call)]
    fn copy(bytes: &[u8]) -> JsValue;

    /// Objects of options are written as JSON.
    #[wasm_bindgen(js_namespace = JSON)]
    fn parse(json: &str) -> JsValue;
}

const STRICT: &str = r#"{"fatal": true, "ignoreBOM": true}"#;
const LENIENT: &str = r#"{"ignoreBOM": true}"#;
const WHOLE: &str = "{}";
const PART: &str = r#"{"stream": true}"#;

/// The names of the standard, which a browser writes in lower case.
const NAMES: [&str; 39] = [
    "Big5",
    "EUC-JP",
    "EUC-KR",
    "GBK",
    "IBM866",
    "ISO-2022-JP",
    "ISO-8859-10",
    "ISO-8859-13",
    "ISO-8859-14",
    "ISO-8859-15",
    "ISO-8859-16",
    "ISO-8859-2",
    "ISO-8859-3",
    "ISO-8859-4",
    "ISO-8859-5",
    "ISO-8859-6",
    "ISO-8859-7",
    "ISO-8859-8",
    "ISO-8859-8-I",
    "KOI8-R",
    "KOI8-U",
    "Shift_JIS",
    "UTF-16BE",
    "UTF-16LE",
    "UTF-8",
    "gb18030",
    "macintosh",
    "windows-1250",
    "windows-1251",
    "windows-1252",
    "windows-1253",
    "windows-1254",
    "windows-1255",
    "windows-1256",
    "windows-1257",
    "windows-1258",
    "windows-874",
    "x-mac-cyrillic",
    "x-user-defined",
];

pub(super) fn name_of_label(label: &[u8]) -> Option<&'static str> {
    let decoder = TextDecoder::new(str::from_utf8(label).ok()?, &parse(LENIENT)).ok()?;
    let name = decoder.encoding();
    let known = NAMES.iter().find(|known| known.eq_ignore_ascii_case(&name));
    known.copied()
}

pub(super) fn decode(name: &str, bytes: &[u8]) -> (String, bool) {
    if let Ok(text) = decoded(name, STRICT, bytes, WHOLE) {
        return (text, false);
    }
    let text = decoded(name, LENIENT, bytes, WHOLE);
    (text.unwrap_or_default(), true)
}

pub(super) fn decode_strictly(name: &str, bytes: &[u8]) -> Result<String, Option<usize>> {
    decoded(name, STRICT, bytes, WHOLE).map_err(|_| Some(first_wrong(name, bytes)))
}

/// A browser does not say where a text is wrong: the shortest beginning that is.
fn first_wrong(name: &str, bytes: &[u8]) -> usize {
    let (mut right, mut wrong) = (0, bytes.len() + 1);
    while wrong - right > 1 {
        let middle = right.midpoint(wrong);
        match decoded(name, STRICT, &bytes[..middle], PART) {
            Ok(_) => right = middle,
            Err(_) => wrong = middle,
        }
    }
    match bytes.get(right) {
        // A letter of its own after half of another.
        Some(byte) if byte.is_ascii() => right,
        Some(_) => wrong,
        None => bytes.len(),
    }
}

fn decoded(name: &str, decoder: &str, bytes: &[u8], part: &str) -> Result<String, JsValue> {
    TextDecoder::new(name, &parse(decoder))?.decode(&copy(bytes), &parse(part))
}
