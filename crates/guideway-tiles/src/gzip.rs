//! [`Gzip`]: compresses many small contents with the memory of one compressor.

use flate2::{Compress, Compression, Crc, FlushCompress, Status};

/// Start of a file of gzip (RFC 1952, section 2.3): magic, deflate, no name, no time, compressed
/// fast, by any system.
const HEAD: [u8; 10] = [0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 4, 255];

/// A compressor by gzip, for contents that are needed soon.
pub(crate) struct Gzip {
    deflate: Compress,
}

impl Gzip {
    pub(crate) fn fast() -> Self {
        Self {
            deflate: Compress::new(Compression::fast(), false),
        }
    }

    /// Compresses a content.
    pub(crate) fn compress(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut out = Vec::with_capacity(bytes.len() / 2 + 64);
        out.extend(HEAD);
        self.deflate.reset();
        loop {
            let from = self.deflate.total_in() as usize;
            let done = self
                .deflate
                .compress_vec(&bytes[from..], &mut out, FlushCompress::Finish);
            if done.expect("a vector takes all bytes") == Status::StreamEnd {
                break;
            }
            out.reserve(bytes.len() / 2 + 64);
        }
        let mut sum = Crc::new();
        sum.update(bytes);
        out.extend(sum.sum().to_le_bytes());
        out.extend(sum.amount().to_le_bytes());
        out
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::GzDecoder;

    use super::*;

    #[test]
    fn contents_come_back_one_after_the_other() {
        let mut gzip = Gzip::fast();
        let noise = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
        for length in [0, 1, 700, 100_000, 3] {
            for content in [vec![7; length], (0..length as u32).map(noise).collect()] {
                let compressed = gzip.compress(&content);
                let mut again = Vec::new();
                let read = GzDecoder::new(&compressed[..]).read_to_end(&mut again);
                read.expect("gzip");
                assert!(again == content, "{length} bytes");
            }
        }
    }
}
