//! Random-access input: bytes in memory, a file on disk or parts that the caller reads, by any
//! thread.

use std::io;
use std::ops::Range;

use guideway_layout::{SourceFile, try_reserve};

use crate::Problem;

#[cfg(unix)]
mod read_ahead;
#[cfg(unix)]
pub(crate) use read_ahead::ReadAheadFile;

/// Largest text that a layout keeps; of a longer one, parts are read.
pub(crate) const MAX_KEPT_BYTES: usize = 256 << 20;

/// Bytes that stay where they are and are read in parts, such as those that a browser holds.
pub trait Parts: Sync {
    /// Returns the number of bytes.
    fn byte_count(&self) -> usize;

    /// Fills `to` with the bytes from offset `from` on. Any thread may call it at any time.
    ///
    /// # Errors
    /// When they cannot be read; `UnexpectedEof` if there are fewer.
    fn read(&self, from: usize, to: &mut [u8]) -> io::Result<()>;
}

impl Parts for &[u8] {
    fn byte_count(&self) -> usize {
        self.len()
    }

    fn read(&self, from: usize, to: &mut [u8]) -> io::Result<()> {
        let part = self.get(from..).and_then(|bytes| bytes.get(..to.len()));
        to.copy_from_slice(part.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    }
}

/// Bytes in memory, those of a file, or parts.
pub(crate) enum Input<'a> {
    Bytes(&'a [u8]),
    Parts(&'a dyn Parts),
    #[cfg(unix)]
    File(&'a ReadAheadFile),
}

impl Input<'_> {
    /// Returns the number of bytes.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Parts(parts) => parts.byte_count(),
            #[cfg(unix)]
            Self::File(file) => file.len(),
        }
    }

    /// The file, to be read again later; `None` if it is none.
    pub(crate) fn source_file(&self) -> Option<SourceFile> {
        match self {
            Self::Bytes(_) | Self::Parts(_) => None,
            #[cfg(unix)]
            Self::File(file) => file.source_file(),
        }
    }

    /// Starts to read the whole input ahead, from its beginning.
    pub(crate) fn read_ahead(&self) {
        match self {
            Self::Bytes(_) | Self::Parts(_) => {}
            #[cfg(unix)]
            Self::File(file) => file.read_ahead(),
        }
    }

    /// Fills `to` with the bytes from offset `from` on. Any thread may call it at any time.
    ///
    /// # Errors
    /// When the input is shorter, or the operating system reports an error.
    pub(crate) fn read(&self, from: usize, to: &mut [u8]) -> Result<(), Problem> {
        let read = match self {
            Self::Bytes(bytes) => bytes.read(from, to),
            Self::Parts(parts) => parts.read(from, to),
            #[cfg(unix)]
            Self::File(file) => file.read(from, to),
        };
        read.map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => self.truncated(),
            _ => Problem::Io(error),
        })
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
            _ => {
                buffer.clear();
                try_reserve(buffer, range.len())
                    .map_err(|_| Problem::Io(io::ErrorKind::OutOfMemory.into()))?;
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
