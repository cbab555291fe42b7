use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use guideway_render::Frame;

use crate::{SaveError, replace_file};

/// Saves a picture as PNG. The file appears whole or not at all, in place of one of the same name.
///
/// # Errors
/// When the folder cannot be written, or its disk is full; then nothing is left behind.
pub fn save_png(frame: &Frame, path: impl AsRef<Path>) -> Result<(), SaveError> {
    let path = path.as_ref();
    replace_file(path, |file| {
        write_file(frame, file).map_err(|problem| SaveError {
            path: path.to_owned(),
            problem,
        })
    })
}

fn write_file(frame: &Frame, path: &Path) -> io::Result<()> {
    let mut file = BufWriter::with_capacity(1 << 16, File::create(path)?);
    write_png(frame, &mut file)?;
    file.flush()
}

/// Writes a picture as PNG to anything that takes bytes.
///
/// # Errors
/// When the target does not take them.
pub fn write_png(frame: &Frame, target: impl Write) -> io::Result<()> {
    let size = frame.size();
    let mut encoder = png::Encoder::new(target, size.width(), size.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(as_io)?;
    writer.write_image_data(frame.bytes()).map_err(as_io)?;
    writer.finish().map_err(as_io)
}

fn as_io(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use guideway_render::FrameSize;

    use super::*;

    #[test]
    fn a_picture_comes_back_as_it_was_saved() {
        let mut frame = Frame::new(FrameSize::new(3, 2).unwrap());
        for (i, pixel) in frame.pixels_mut().iter_mut().enumerate() {
            *pixel = [i as u8, 50, 255, 128 + i as u8];
        }
        let mut bytes = Vec::new();
        write_png(&frame, &mut bytes).unwrap();

        let mut reader = png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(pixels, frame.bytes());
    }
}
