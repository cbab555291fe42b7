//! Random-access input: bytes in memory or a file on disk, read in parts by any thread.

use std::ops::Range;

use guideway_layout::SourceFile;
#[cfg(unix)]
use guideway_layout::try_reserve;

use crate::Problem;

#[cfg(unix)]
mod read_ahead;
#[cfg(unix)]
pub(crate) use read_ahead::ReadAheadFile;

/// Largest text that a layout keeps; of a longer one, parts are read.
pub(crate) const MAX_KEPT_BYTES: usize = 256 << 20;

/// Bytes in memory, or those of a file.
pub(crate) enum Input<'a> {
    Bytes(&'a [u8]),
    #[cfg(unix)]
    File(&'a ReadAheadFile),
}

impl Input<'_> {
    /// Returns the number of bytes.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            #[cfg(unix)]
            Self::File(file) => file.len(),
        }
    }

    /// The file, to be read again later; `None` if the bytes are in memory.
    pub(crate) fn source_file(&self) -> Option<SourceFile> {
        match self {
            Self::Bytes(_) => None,
            #[cfg(unix)]
            Self::File(file) => file.source_file(),
        }
    }

    /// Starts to read the whole input ahead, from its beginning.
    pub(crate) fn read_ahead(&self) {
        match self {
            Self::Bytes(_) => {}
            #[cfg(unix)]
            Self::File(file) => file.read_ahead(),
        }
    }

    /// Fills `to` with the bytes from offset `from` on. Any thread may call it at any time.
    ///
    /// # Errors
    /// When the input is shorter, or the operating system reports an error.
    pub(crate) fn read(&self, from: usize, to: &mut [u8]) -> Result<(), Problem> {
        match self {
            Self::Bytes(bytes) => {
                let range = bytes.get(from..).and_then(|bytes| bytes.get(..to.len()));
                to.copy_from_slice(range.ok_or_else(|| self.truncated())?);
                Ok(())
            }
            #[cfg(unix)]
            Self::File(file) => file.read(from, to).map_err(|e| match e.kind() {
                std::io::ErrorKind::UnexpectedEof => self.truncated(),
                _ => Problem::Io(e),
            }),
        }
    }

    /// Returns the bytes of a range, which are read into `buffer` unless they are in memory. The
    /// caller checks its length.
    ///
    /// # Errors
    /// See [`Self::read`].
    pub(crate) fn part<'b>(
        &'b self,
        range: Range<usize>,
        buffer: &'b mut Vec<u8>,
    ) -> Result<&'b [u8], Problem> {
        match self {
            Self::Bytes(bytes) => bytes.get(range).ok_or_else(|| self.truncated()),
            #[cfg(unix)]
            Self::File(_) => {
                buffer.clear();
                try_reserve(buffer, range.len())
                    .map_err(|_| Problem::Io(std::io::ErrorKind::OutOfMemory.into()))?;
                buffer.resize(range.len(), 0);
                self.read(range.start, buffer)?;
                Ok(buffer)
            }
        }
    }

    /// Returns the bytes of a range. The caller checks its length: memory for it is allocated
    /// first.
    pub(crate) fn bytes(&self, range: Range<usize>) -> Result<Vec<u8>, Problem> {
        let mut bytes = vec![0; range.len()];
        self.read(range.start, &mut bytes)?;
        Ok(bytes)
    }

    fn truncated(&self) -> Problem {
        Problem::Truncated {
            at: self.len() as u64,
            detail: "it became shorter during the read".into(),
        }
    }
}
