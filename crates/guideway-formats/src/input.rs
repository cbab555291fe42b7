//! What a reader reads that looks at parts of it at a time.

use std::ops::Range;

use crate::Problem;

#[cfg(unix)]
mod on_disk;
#[cfg(unix)]
pub(crate) use on_disk::OnDisk;

/// Bytes in memory, or those of a file.
pub(crate) enum Input<'a> {
    Bytes(&'a [u8]),
    #[cfg(unix)]
    File(&'a OnDisk),
}

impl Input<'_> {
    /// Number of bytes.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            #[cfg(unix)]
            Self::File(file) => file.len(),
        }
    }

    /// From now on all of it is read, from the beginning on.
    pub(crate) fn read_ahead(&self) {
        match self {
            Self::Bytes(_) => {}
            #[cfg(unix)]
            Self::File(file) => file.read_ahead(),
        }
    }

    /// Fills `to` with the bytes from `from` on. Any thread may, at any time.
    pub(crate) fn read(&self, from: usize, to: &mut [u8]) -> Result<(), Problem> {
        match self {
            Self::Bytes(bytes) => {
                let there = bytes.get(from..).and_then(|bytes| bytes.get(..to.len()));
                to.copy_from_slice(there.ok_or_else(|| self.shorter())?);
                Ok(())
            }
            #[cfg(unix)]
            Self::File(file) => file.read(from, to).map_err(|e| match e.kind() {
                std::io::ErrorKind::UnexpectedEof => self.shorter(),
                _ => Problem::Io(e),
            }),
        }
    }

    /// Some bytes, of which the caller knows that they are not more than there are.
    pub(crate) fn bytes(&self, range: Range<usize>) -> Result<Vec<u8>, Problem> {
        let mut bytes = vec![0; range.len()];
        self.read(range.start, &mut bytes)?;
        Ok(bytes)
    }

    fn shorter(&self) -> Problem {
        Problem::Truncated {
            at: self.len() as u64,
            detail: "it became shorter while it was read".into(),
        }
    }
}
