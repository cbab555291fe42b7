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
    let map = Arc::new(unsafe { memmap2::Mmap::map(file)? });
    #[cfg(unix)]
    read_ahead(file, map.len());
    let (start, len) = (map.as_ptr().cast_mut(), map.len());
    let start = NonNull::new(start).ok_or(Problem::Empty)?;
    // SAFETY: `start` is valid for `len` bytes as long as the map lives, and the buffer owns the map.
    Ok(unsafe { Buffer::from_custom_allocation(start, len, map) })
}

/// Has the system read ahead of who looks at a file: what is read here is thrown away, but is in memory then. A system that is asked for much at once
/// keeps it in few large pieces, which cost far less to find and to map than what it is advised to read.
#[cfg(all(feature = "mmap", unix))]
fn read_ahead(file: &File, len: usize) {
    use std::os::unix::fs::FileExt;
    const PIECE: usize = 1 << 20;
    /// No more than this, lest what comes pushes out what was not looked at yet.
    const MOST: usize = 1 << 28;
    /// What the end of a file tells is asked for first.
    const END: usize = 1 << 16;
    if len <= PIECE {
        return;
    }
    let Ok(file) = file.try_clone() else {
        return;
    };
    let read = move || {
        let mut piece = vec![0; PIECE];
        let _ = file.read_at(&mut piece[..END], (len - END) as u64);
        let mut is_there = true;
        for from in (0..len.min(MOST)).step_by(PIECE) {
            // Whatever follows what is not there has to be read, and asking would look as if reads were in no order.
            // The first bytes of a file and the end were looked at already: the middle of a piece tells.
            let middle = usize::midpoint(from, len.min(from + PIECE));
            is_there = is_there && is_in_memory(&file, middle as u64);
            if !is_there {
                let _ = file.read_at(&mut piece, from as u64);
            }
        }
    };
    // If the system has no thread for it, the file is read all the same.
    let _ = std::thread::Builder::new().spawn(read);
}

/// Whether a byte of a file can be had without waiting. What others have just written or read can, and need not be read once more.
#[cfg(all(feature = "mmap", target_os = "linux"))]
fn is_in_memory(file: &File, at: u64) -> bool {
    use rustix::io::{ReadWriteFlags, preadv2};
    let mut byte = [0];
    let mut bytes = [std::io::IoSliceMut::new(&mut byte)];
    preadv2(file, &mut bytes, at, ReadWriteFlags::NOWAIT).is_ok_and(|count| count > 0)
}

/// Elsewhere there is no telling.
#[cfg(all(feature = "mmap", unix, not(target_os = "linux")))]
fn is_in_memory(_file: &File, _at: u64) -> bool {
    false
}

/// The whole file, read into memory.
#[cfg(not(feature = "mmap"))]
pub(crate) fn load(mut file: &File) -> Result<Buffer, Problem> {
    use std::io::Read;

    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(Buffer::from_vec(bytes))
}
