//! Unpacks gzip, as in `.svgz` files: bytes in, unpacked bytes within a bound out.

use std::borrow::Cow;
use std::io::{ErrorKind, Read};

use flate2::bufread::GzDecoder;
use guideway_layout::{Limits, Place};

use crate::Problem;

/// Bytes that any packed file may unpack to.
const BASE_BYTES: u64 = 64 << 20;

/// Bytes that it may unpack to in addition, per packed byte. Texts of drawings pack to a fifth or a
/// twentieth; gzip can pack a thousand to one.
const BYTES_PER_PACKED_BYTE: u64 = 64;

/// First bytes of each part of a gzip file.
const MAGIC: [u8; 2] = [0x1F, 0x8B];

/// Returns the unpacked bytes of a gzip file; other bytes unchanged. Zeros may follow, which fill
/// blocks of tapes.
///
/// # Errors
/// When the file is cut or damaged, or when it unpacks to more than the limit.
pub(crate) fn unpack<'b>(bytes: &'b [u8], limits: &Limits) -> Result<Cow<'b, [u8]>, Problem> {
    if !(bytes.starts_with(&MAGIC) && bytes.get(2) == Some(&8)) {
        return Ok(Cow::Borrowed(bytes));
    }
    let limit = BASE_BYTES + BYTES_PER_PACKED_BYTE * bytes.len() as u64;
    let limit = limit.min(limits.file_bytes);
    let (mut unpacked, mut rest) = (Vec::new(), bytes);
    while unpacked.len() as u64 <= limit && rest.iter().any(|&byte| byte != 0) {
        if !rest.starts_with(&MAGIC) {
            return Err(damaged(format!("{} bytes follow its end", rest.len())));
        }
        let mut decoder = GzDecoder::new(rest);
        let room = limit + 1 - unpacked.len() as u64;
        let read = decoder.by_ref().take(room).read_to_end(&mut unpacked);
        read.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => Problem::Truncated {
                at: bytes.len() as u64,
                detail: "the gzip data has no end".into(),
            },
            ErrorKind::OutOfMemory => Problem::Io(error),
            _ => damaged(error.to_string()),
        })?;
        rest = decoder.into_inner();
    }
    match unpacked.len() as u64 {
        0 => Err(Problem::Empty),
        actual if actual > limit => Err(Problem::LimitReached {
            what: "bytes in the unpacked file",
            limit,
            actual,
        }),
        _ => Ok(Cow::Owned(unpacked)),
    }
}

fn damaged(detail: String) -> Problem {
    Problem::Damaged {
        place: Place::element("the gzip data"),
        detail,
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn pack(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn unpacks_all_members_and_leaves_other_bytes_alone() {
        let limits = Limits::default();
        let twice = [pack(b"<svg"), pack(b"/>")].concat();
        assert_eq!(*unpack(&twice, &limits).unwrap(), *b"<svg/>");
        assert_eq!(*unpack(b"<svg/>", &limits).unwrap(), *b"<svg/>");
        let padded = [pack(b"<svg/>"), vec![0; 512]].concat();
        assert_eq!(*unpack(&padded, &limits).unwrap(), *b"<svg/>");
    }

    #[test]
    fn refuses_cut_damaged_and_huge_files() {
        let limits = Limits::default();
        let packed = pack(b"<svg/>");
        let cut = unpack(&packed[..packed.len() - 3], &limits);
        assert!(matches!(cut, Err(Problem::Truncated { .. })), "{cut:?}");
        let followed = [&packed[..], b"and more"].concat();
        let error = unpack(&followed, &limits).unwrap_err().to_string();
        assert!(error.contains("8 bytes follow"), "{error}");
        let mut wrong = packed.clone();
        wrong[packed.len() - 6] ^= 1;
        let wrong = unpack(&wrong, &limits);
        assert!(matches!(wrong, Err(Problem::Damaged { .. })), "{wrong:?}");
        assert!(matches!(unpack(&pack(b""), &limits), Err(Problem::Empty)));
        let bomb = pack(&vec![b' '; 100 << 20]);
        let bomb = unpack(&bomb, &limits);
        assert!(matches!(bomb, Err(Problem::LimitReached { .. })));
        let small = Limits {
            file_bytes: 5,
            ..limits
        };
        let bomb = unpack(&packed, &small);
        assert!(matches!(bomb, Err(Problem::LimitReached { .. })));
    }
}
