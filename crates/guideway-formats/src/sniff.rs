/// A file format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The Layout Interchange Format of the VDMA, 1.0 and 2.0.
    Lif,
    /// A plant model of openTCS, 0.0.2 to 7.0.0.
    OpenTcs,
    /// A table of paths in an Apache Arrow IPC file.
    Arrow,
}

impl Format {
    /// Every format there is.
    pub const ALL: &[Self] = &[Self::Lif, Self::OpenTcs, Self::Arrow];

    /// The name, as in [`guideway_layout::Provenance::format`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Lif => "LIF",
            Self::OpenTcs => "openTCS",
            Self::Arrow => "Arrow",
        }
    }

    /// The name with what a file of it looks like.
    pub fn description(self) -> &'static str {
        match self {
            Self::Lif => "VDMA LIF 1.0 and 2.0 (JSON)",
            Self::OpenTcs => "openTCS plant models (XML)",
            Self::Arrow => "Arrow IPC files of paths",
        }
    }
}

/// The only format that the bytes can be of, from how they begin; the file name has no say.
///
/// JSON can only be LIF and XML can only be openTCS. Whether they truly are is for the reader to find,
/// which can then say what it found instead.
pub fn sniff(bytes: &[u8]) -> Option<Format> {
    // A stream has no magic; it begins with the mark that every one of its messages begins with.
    if bytes.starts_with(b"ARROW1") || bytes.starts_with(&[0xFF; 4]) {
        return Some(Format::Arrow);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    match text.trim_ascii_start().first()? {
        b'{' => Some(Format::Lif),
        b'<' => Some(Format::OpenTcs),
        _ => None,
    }
}
