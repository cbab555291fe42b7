//! Detects map files among YAML files.

/// Bytes of a text that are searched. Maps take 200 bytes, and comments may precede the keys.
const SEARCHED: usize = 1 << 16;

/// Returns `true` if a text has the top-level keys of a map: `image`, and one of those that place
/// it or tell the meaning of its pixels, or one that merges them.
pub fn is_ros_map(text: &[u8]) -> bool {
    let text = &text[..text.len().min(SEARCHED)];
    let has = |key: &[u8]| {
        let mut lines = text.split(|&byte| byte == b'\n');
        lines.any(|line| {
            let rest = line
                .strip_prefix(key)
                .and_then(|rest| rest.strip_prefix(b":"));
            rest.is_some_and(|rest| rest.first().is_none_or(u8::is_ascii_whitespace))
        })
    };
    let others: [&[u8]; 6] = [
        b"resolution",
        b"origin",
        b"negate",
        b"occupied_thresh",
        b"free_thresh",
        b"<<",
    ];
    has(b"image") && others.into_iter().any(has)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_an_image_and_its_placement() {
        assert!(is_ros_map(
            b"# hall\r\nimage: a.pgm\r\nresolution: 0.05\r\n"
        ));
        assert!(is_ros_map(b"negate: 0\nimage:\n"));
        assert!(is_ros_map(b"base: &b\n  negate: 0\nimage: a.pgm\n<<: *b\n"));
        for other in [
            &b"image: a.pgm\n"[..],
            b"resolution: 1\n",
            b"levels:\n  image: a.pgm\n  resolution: 1\n",
            b"images: a\norigin: b\n",
            b"",
        ] {
            assert!(!is_ros_map(other), "{}", other.escape_ascii());
        }
    }
}
