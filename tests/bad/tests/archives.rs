//! The archives parse, every file has an expected outcome, and any bytes survive a round trip.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

use guideway_bad_files::{Archive, ArchiveError, FORMATS, inputs};
use proptest::prelude::*;

fn archive_of(files: &[(&str, &[u8])]) -> Archive {
    let mut archive = Archive::default();
    for (name, bytes) in files {
        assert!(archive.insert(name, bytes.to_vec()), "{name}");
    }
    archive
}

#[test]
fn stored_archives_print_as_they_parse() {
    for format in FORMATS {
        let archive = inputs(format).unwrap();
        assert!(archive.iter().count() > 10, "{format}");
        assert_eq!(Archive::parse(&archive.to_string()).unwrap(), archive);
        assert_eq!(archive.emptied().iter().count(), 0);
    }
}

#[test]
fn plain_files_stay_as_they_are() {
    let archive = archive_of(&[
        ("b.json", "{\"name\": \"Straße\\u0041\"}\n\n".as_bytes()),
        ("a", b""),
    ]);
    let text = "-- a --\n-- b.json --\n{\"name\": \"Straße\\u0041\"}\n\n";
    assert_eq!(archive.to_string(), text);
    assert_eq!(Archive::parse(text), Ok(archive));
}

#[test]
fn binary_files_are_base64() {
    let bytes = [&[1, 2, 0, 0, 0, 0, 3][..], &[255; 60]].concat();
    let archive = archive_of(&[("a", &bytes)]);
    let lines = [
        format!("AQIAAAAAA{}", "/".repeat(67)),
        "/".repeat(13) + "w==",
    ];
    let text = format!("-- a (base64) --\n{}\n", lines.join("\n"));
    assert_eq!(archive.to_string(), text);
    assert_eq!(Archive::parse(&text), Ok(archive));
    for line in ["AQI", "AQ I", "\\x00"] {
        let error = Archive::parse(&format!("-- a (base64) --\n{line}\n"));
        assert!(
            matches!(&error, Err(ArchiveError::Base64 { line: 2, .. })),
            "{line}: {error:?}"
        );
    }
}

#[test]
fn other_files_are_escaped() {
    for (bytes, lines) in [
        (&b"no newline"[..], "no newline\\\n"),
        (b"a\\b\0\n", "a\\\\b\\x00\n"),
        (b"\r\n\r", "\\r\n\\r\\\n"),
        (b"\n-- a --\n", "\n\\x2d- a --\n"),
        (b"\xff\xfel\0", "\\xff\\xfel\\x00\\\n"),
        (b"\xef\xbb\xbf{}\n", "\\xef\\xbb\\xbf{}\n"),
    ] {
        let archive = archive_of(&[("a", bytes)]);
        assert_eq!(archive.to_string(), format!("-- a (escaped) --\n{lines}"));
        assert_eq!(Archive::parse(&archive.to_string()), Ok(archive));
    }
}

proptest! {
    #[test]
    fn any_bytes_survive(
        files in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..300), 1..4),
        texts in prop::collection::vec(r"([-# a\\xr\n]|\r){0,300}", 1..4),
    ) {
        let mut archive = Archive::parse("# A comment.\n-- first --\n").unwrap();
        let all = files.into_iter().chain(texts.into_iter().map(String::into_bytes));
        for (index, bytes) in all.enumerate() {
            let name = format!("file-{index}");
            prop_assert!(archive.insert(&name, bytes));
        }
        let text = archive.to_string();
        prop_assert_eq!(Archive::parse(&text), Ok(archive));
    }
}

#[test]
fn malformed_archives_are_errors() {
    let name = || "a".to_owned();
    for (text, expected) in [
        ("", ArchiveError::Empty),
        ("# only a comment\n", ArchiveError::Empty),
        ("-- a --\nno newline", ArchiveError::Truncated),
        ("text\n-- a --\n", ArchiveError::Comment { line: 1 }),
        ("-- a\n", ArchiveError::Header { line: 1 }),
        ("-- a b --\n", ArchiveError::Header { line: 1 }),
        ("-- ../a --\n", ArchiveError::Header { line: 1 }),
        ("-- a (packed) --\n", ArchiveError::Header { line: 1 }),
        ("-- a --\n-- text\n", ArchiveError::Header { line: 2 }),
        (
            "-- a --\n-- a (escaped) --\n",
            ArchiveError::Duplicate {
                line: 2,
                name: name(),
            },
        ),
        (
            "-- a --\nx\r\n",
            ArchiveError::NotPlain {
                line: 2,
                name: name(),
            },
        ),
        (
            "-- a --\n\u{feff}\n",
            ArchiveError::NotPlain {
                line: 2,
                name: name(),
            },
        ),
    ] {
        assert_eq!(Archive::parse(text), Err(expected), "{text:?}");
    }
    for escape in ["\\n", "\\x0", "\\x+1", "\\xäö", "\\x0g"] {
        let error = Archive::parse(&format!("-- a (escaped) --\n{escape}\n"));
        assert!(
            matches!(&error, Err(ArchiveError::Escape { line: 2, .. })),
            "{escape}: {error:?}"
        );
    }
}

#[test]
fn names_are_plain_and_unique() {
    let mut archive = archive_of(&[("a", b"")]);
    for name in ["a", "", ".hidden", "a b", "a/b", "ä"] {
        assert!(!archive.insert(name, Vec::new()), "{name}");
    }
}

#[test]
fn missing_inputs_are_named() {
    let error = guideway_bad_files::input("lif/absent.json").unwrap_err();
    assert!(
        error.to_string().contains("no file `absent.json`"),
        "{error}"
    );
    let error = inputs("absent").unwrap_err();
    assert!(error.to_string().contains("inputs.txt"), "{error}");
}
