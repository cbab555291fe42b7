//! Fingerprints of findings: equal for the same finding of a file whose lines moved.

use guideway::layout::Diagnostic;

/// A fingerprint, as 16 hexadecimal digits.
///
/// It covers the code, the element and the begin of the message, up to the first number: a node gap
/// that widens is the same finding. The number of an item, as in `edges[3]`, changes with the items
/// before it; the fingerprint omits it and covers the whole message instead. Findings of a file may
/// share a fingerprint: then their number counts.
pub(super) fn fingerprint(finding: &Diagnostic) -> String {
    let (element, is_numbered) = without_numbers(&finding.place.element);
    let message = finding.message.as_str();
    let message = match is_numbered {
        true => message,
        false => message
            .split(|c: char| c.is_ascii_digit())
            .next()
            .unwrap_or_default(),
    };
    let mut hash = Fnv::default();
    for part in [finding.code.name(), &element, message] {
        hash.add(part.as_bytes());
        hash.add(&[0]);
    }
    format!("{:016x}", hash.0)
}

/// Removes the numbers of items and lines from the name of an element: `edges[3]`, `line 12`,
/// `path number 5`. Returns `true` if there was one.
fn without_numbers(element: &str) -> (String, bool) {
    let (mut text, mut rest, mut has_number) = (String::new(), element, false);
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let digits = rest[at..].bytes().take_while(u8::is_ascii_digit).count();
        text.push_str(&rest[..at]);
        let is_item = text.ends_with('[') && rest[at + digits..].starts_with(']');
        if is_item || text.ends_with("line ") || text.ends_with("number ") {
            has_number = true;
        } else {
            text.push_str(&rest[at..at + digits]);
        }
        rest = &rest[at + digits..];
    }
    (text + rest, has_number)
}

/// The hash function FNV-1a, which gives the same value on every machine and in every version.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway::layout::{Code, Place};

    use super::*;

    fn of(element: &str, line: u32, message: &str) -> String {
        fingerprint(&Diagnostic {
            code: Code::NodeGap,
            severity: Code::NodeGap.severity(),
            place: Place::on_line(element, line),
            message: message.to_owned(),
            remedy: "Move it".to_owned(),
        })
    }

    #[test]
    fn fingerprints_survive_moved_lines_and_small_changes() {
        let first = of("path \"e7\"", 3, "begins at (1, 2) m, 0.2 m from node");
        assert_eq!(
            first,
            of("path \"e7\"", 90, "begins at (1, 3) m, 0.4 m from node")
        );
        assert_ne!(
            first,
            of("path \"e8\"", 3, "begins at (1, 2) m, 0.2 m from node")
        );
        assert_ne!(
            first,
            of("path \"e7\"", 3, "ends at (1, 2) m, 0.2 m from node")
        );
        let item = of("layouts[0].edges[3].degree", 3, "the degree is 2.5");
        assert_eq!(
            item,
            of("layouts[0].edges[12].degree", 9, "the degree is 2.5")
        );
        assert_ne!(
            item,
            of("layouts[0].edges[3].degree", 3, "the degree is 3.5")
        );
        assert_eq!(of("path \"line 4\"", 4, "a"), of("path \"line 5\"", 5, "a"));
    }

    #[test]
    fn hash_is_fnv_1a() {
        let mut hash = Fnv::default();
        hash.add(b"foobar");
        assert_eq!(hash.0, 0x8594_4171_f739_67e8);
    }
}
