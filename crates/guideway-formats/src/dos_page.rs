//! Code pages of DOS, which the Encoding Standard does not have: bytes in, text out.

/// A code page, by the characters of its bytes from 128 on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DosPage(&'static str);

/// Code page 437 of DOS.
const DOS_437: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒáíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐\
    └┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{a0}";
/// Code page 850 of DOS.
const DOS_850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐\
    └┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{ad}±‗¾¶§÷¸°¨·¹³²■\u{a0}";
/// Code page 852 of DOS.
const DOS_852: &str = "ÇüéâäůćçłëŐőîŹÄĆÉĹĺôöĽľŚśÖÜŤťŁ×čáíóúĄąŽžĘę¬źČş«»░▒▓│┤ÁÂĚŞ╣║╗╝Żż┐\
    └┴┬├─┼Ăă╚╔╩╦╠═╬¤đĐĎËďŇÍÎě┘┌█▄ŢŮ▀ÓßÔŃńňŠšŔÚŕŰýÝţ´\u{ad}˝˛ˇ˘§÷¸°¨˙űŘř■\u{a0}";
/// Code page 857 of DOS.
const DOS_857: &str = "ÇüéâäàåçêëèïîıÄÅÉæÆôöòûùİÖÜø£ØŞşáíóúñÑĞğ¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐\
    └┴┬├─┼ãÃ╚╔╩╦╠═╬¤ºªÊËÈ\u{fffd}ÍÎÏ\
    ┘┌█▄¦Ì▀ÓßÔÒõÕµ\u{fffd}×ÚÛÙìÿ¯´\u{ad}±\u{fffd}¾¶§÷¸°¨·¹³²■\u{a0}";

impl DosPage {
    /// The page of a number, such as `850`.
    pub(crate) fn of_number(number: &str) -> Option<Self> {
        match number {
            "437" => Some(Self(DOS_437)),
            "850" => Some(Self(DOS_850)),
            "852" => Some(Self(DOS_852)),
            "857" => Some(Self(DOS_857)),
            _ => None,
        }
    }

    /// The page of a label, such as `IBM850` or `cp-437`.
    pub(crate) fn of_label(label: &[u8]) -> Option<Self> {
        let label = str::from_utf8(label).ok()?.trim().to_ascii_lowercase();
        let names = ["csibm", "ibm", "cp", "dos"].into_iter();
        let number = names.filter_map(|name| label.strip_prefix(name)).next()?;
        Self::of_number(number.trim_start_matches(['-', '_']))
    }

    /// Decodes a text. A byte without a character becomes U+FFFD.
    pub(crate) fn decode(self, bytes: &[u8]) -> String {
        let letter = |&byte: &u8| match byte.checked_sub(128) {
            None => char::from(byte),
            Some(high_byte) => self.0.chars().nth(high_byte.into()).unwrap_or('\u{fffd}'),
        };
        bytes.iter().map(letter).collect()
    }
}
