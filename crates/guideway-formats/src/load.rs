use std::fs::File;

use arrow_buffer::Buffer;

use crate::Problem;

/// The whole file, mapped where that can be done: nothing is read that is not looked at.
#[cfg(feature = "mmap")]
#[allow(
    unsafe_code,
    reason = "mapping a file is unsafe by its nature; see SAFETY"
)]
pub(crate) fn load(file: &File) -> Result<Buffer, Problem> {
    use std::ptr::NonNull;
    use std::sync::Arc;

    if file.metadata()?.len() == 0 {
        return Err(Problem::Empty);
    }
    // SAFETY: the map is read-only and lives only as long as this read, which copies all that it
    // keeps. It relies, as every program that maps a file must, on no other process changing the file
    // in that time; `docs/formats.md` tells writers to replace files rather than to change them.
    let map = unsafe { memmap2::Mmap::map(file)? };
    // Read ahead of who looks at it. If the system does not care to, it is read all the same.
    #[cfg(unix)]
    let _ = map.advise(memmap2::Advice::WillNeed);
    let (start, len) = (map.as_ptr().cast_mut(), map.len());
    let start = NonNull::new(start).ok_or(Problem::Empty)?;
    // SAFETY: `start` is valid for `len` bytes as long as the map lives, and the buffer owns the map.
    Ok(unsafe { Buffer::from_custom_allocation(start, len, Arc::new(map)) })
}

/// The whole file, read into memory.
#[cfg(not(feature = "mmap"))]
pub(crate) fn load(mut file: &File) -> Result<Buffer, Problem> {
    use std::io::Read;

    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(Buffer::from_vec(bytes))
}
