//! Encodings other than Unicode's, by the Encoding Standard: bytes in, text out.
//!
//! A browser has the tables of them all, which would be a tenth of the engine of the page.

#[cfg(all(target_arch = "wasm32", target_os = "unknown"))]
#[path = "browser.rs"]
mod tables;
#[cfg(not(all(target_arch = "wasm32", target_os = "unknown")))]
mod tables;

/// An encoding, by its name in the Encoding Standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Charset(&'static str);

impl Charset {
    pub(crate) const BIG5: Self = Self("Big5");
    pub(crate) const EUC_KR: Self = Self("EUC-KR");
    pub(crate) const GBK: Self = Self("GBK");
    pub(crate) const IBM866: Self = Self("IBM866");
    pub(crate) const ISO_8859_2: Self = Self("ISO-8859-2");
    pub(crate) const ISO_8859_3: Self = Self("ISO-8859-3");
    pub(crate) const ISO_8859_4: Self = Self("ISO-8859-4");
    pub(crate) const ISO_8859_5: Self = Self("ISO-8859-5");
    pub(crate) const ISO_8859_6: Self = Self("ISO-8859-6");
    pub(crate) const ISO_8859_7: Self = Self("ISO-8859-7");
    pub(crate) const ISO_8859_8: Self = Self("ISO-8859-8");
    pub(crate) const MACINTOSH: Self = Self("macintosh");
    pub(crate) const SHIFT_JIS: Self = Self("Shift_JIS");
    pub(crate) const WINDOWS_874: Self = Self("windows-874");
    pub(crate) const WINDOWS_1250: Self = Self("windows-1250");
    pub(crate) const WINDOWS_1251: Self = Self("windows-1251");
    pub(crate) const WINDOWS_1252: Self = Self("windows-1252");
    pub(crate) const WINDOWS_1253: Self = Self("windows-1253");
    pub(crate) const WINDOWS_1254: Self = Self("windows-1254");
    pub(crate) const WINDOWS_1255: Self = Self("windows-1255");
    pub(crate) const WINDOWS_1256: Self = Self("windows-1256");
    pub(crate) const WINDOWS_1257: Self = Self("windows-1257");
    pub(crate) const WINDOWS_1258: Self = Self("windows-1258");

    /// The encoding that a label such as `latin1` names. `None` if the standard knows none, or one
    /// that nobody may read.
    pub(crate) fn of_label(label: &[u8]) -> Option<Self> {
        tables::name_of_label(label).map(Self)
    }

    pub(crate) fn name(self) -> &'static str {
        self.0
    }

    /// Returns `true` for UTF-8 and UTF-16.
    pub(crate) fn is_unicode(self) -> bool {
        self.0.starts_with("UTF-")
    }

    /// Returns `true` if two bytes may be one letter.
    pub(crate) fn is_east_asian(self) -> bool {
        matches!(
            self,
            Self::BIG5 | Self::EUC_KR | Self::GBK | Self::SHIFT_JIS
        ) || matches!(self.0, "EUC-JP" | "ISO-2022-JP" | "gb18030")
    }

    /// Decodes a text; what is not in the encoding becomes U+FFFD. Returns `true` with it if there
    /// was any such.
    pub(crate) fn decode(self, bytes: &[u8]) -> (String, bool) {
        tables::decode(self.0, bytes)
    }

    /// Decodes a text.
    ///
    /// # Errors
    /// With the bytes before the end of the first letter that is not in the encoding. `None` if
    /// there is no memory for the text.
    pub(crate) fn decode_strictly(self, bytes: &[u8]) -> Result<String, Option<usize>> {
        tables::decode_strictly(self.0, bytes)
    }
}
