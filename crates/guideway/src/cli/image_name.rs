//! Errors of files that are named like images and begin like none: the reader of layouts would take
//! their bytes for a text in some format.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use guideway::compose::ImageError;
use guideway::formats::raster;
use guideway::layout::UserError;

/// Extensions of the images that are read as floor plans.
const EXTENSIONS: [&str; 7] = ["png", "jpg", "jpeg", "pbm", "pgm", "ppm", "pnm"];
/// Bytes that tell an image from other files, and that an error shows.
const EXAMINED: u64 = 8;

/// The error of a file that was not read as a layout, given that error: that it is no image, if it
/// is named like one.
pub fn explain(path: &Path, error: UserError) -> UserError {
    not_an_image(path).map_or(error, UserError::from)
}

/// The error of a file that is named like an image and begins like none.
fn not_an_image(path: &Path) -> Option<ImageError> {
    let extension = path.extension()?.to_str()?;
    let mut known = EXTENSIONS.iter();
    let is_named = known.any(|known| extension.eq_ignore_ascii_case(known));
    let mut bytes = Vec::new();
    let file = File::open(path).ok().filter(|_| is_named)?;
    file.take(EXAMINED).read_to_end(&mut bytes).ok()?;
    if bytes.is_empty() || raster::is_raster(&bytes) {
        return None;
    }
    raster::read_bytes(bytes, &path.to_string_lossy())
        .err()
        .map(ImageError)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::cli::view::window::read_floor_plan;

    /// Bytes of chance that begin as the lines of a text do.
    const CHANCE: &[u8] = b"\n \xED6\xBE\xDB\x8A\xCD\x11\xDC*y\nlevels:\n\xFE\xD3";

    #[test]
    fn chance_named_like_an_image_is_told_as_no_image() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["plan.png", "PLAN.JPG"] {
            let file = folder.path().join(name);
            fs::write(&file, CHANCE).unwrap();
            let error = read_floor_plan(&file.to_string_lossy()).err().unwrap();
            let text = error.to_string();
            assert!(text.contains("cannot read the image"), "{text}");
            assert!(
                text.contains("begins with") && text.contains("PNG, JPEG"),
                "{text}"
            );
            assert!(!text.contains("UTF-8"), "{text}");
        }
    }

    #[test]
    fn other_names_and_other_faults_keep_their_errors() {
        let folder = tempfile::tempdir().unwrap();
        let kept = |name: &str, bytes: Option<&[u8]>| {
            let file = folder.path().join(name);
            if let Some(bytes) = bytes {
                fs::write(&file, bytes).unwrap();
            }
            let error = UserError::new("other", "as it was", "");
            explain(&file, error).to_string().contains("as it was")
        };
        assert!(kept("plan.dxf", Some(CHANCE)));
        assert!(kept("absent.png", None));
        assert!(kept("empty.png", Some(b"")));
        assert!(kept("image.png", Some(b"\x89PNG\r\n\x1a\n")));
        assert!(!kept("chance.png", Some(CHANCE)));
    }
}
