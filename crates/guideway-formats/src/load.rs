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
    // in that time; `docs/formats.md` tells writers to replace files rather than to change them. Who reads
    // ahead may hold it longer, but looks at no byte.
    let map = Arc::new(unsafe { memmap2::Mmap::map(file)? });
    #[cfg(unix)]
    read_ahead(Arc::clone(&map), file);
    let (start, len) = (map.as_ptr().cast_mut(), map.len());
    let start = NonNull::new(start).ok_or(Problem::Empty)?;
    // SAFETY: `start` is valid for `len` bytes as long as the map lives, and the buffer owns the map.
    Ok(unsafe { Buffer::from_custom_allocation(start, len, map) })
}

/// Has the system read ahead of who looks at a file. It is asked for a piece at a time, for of more it reads only the first.
#[cfg(all(feature = "mmap", unix))]
fn read_ahead(map: std::sync::Arc<memmap2::Mmap>, file: &File) {
    use std::os::unix::fs::FileExt;
    const PIECE: usize = 1 << 20;
    /// So many pieces come at a time: of more, all would come late.
    const PIECES: usize = 4;
    /// No more than this, lest what comes pushes out what was not looked at yet.
    const MOST: usize = 1 << 28;
    /// What the end of a file tells is asked for first.
    const END: usize = 1 << 16;
    let len = map.len();
    if len <= PIECE {
        return;
    }
    let Ok(file) = file.try_clone() else {
        return;
    };
    let ask = move || {
        let from = len.saturating_sub(END);
        let _ = map.advise_range(memmap2::Advice::WillNeed, from, len - from);
        for from in (0..len.min(MOST)).step_by(PIECE) {
            let piece = PIECE.min(len - from);
            let _ = map.advise_range(memmap2::Advice::WillNeed, from, piece);
            if let Some(before) = from.checked_sub(PIECES * PIECE) {
                // Waits until that is there.
                let _ = file.read_at(&mut [0], (before + PIECE - 1) as u64);
            }
        }
    };
    // If the system does not care to, or has no thread for it, the file is read all the same.
    let _ = std::thread::Builder::new().spawn(ask);
}

/// The whole file, read into memory.
#[cfg(not(feature = "mmap"))]
pub(crate) fn load(mut file: &File) -> Result<Buffer, Problem> {
    use std::io::Read;

    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(Buffer::from_vec(bytes))
}
