//! Encodes frames as PNG, at once or strip by strip, and writes them to files or streams; texts and
//! world files that say where a picture lies.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use guideway_formats::{SaveError, replace_file};
use guideway_scene::{Frame, FrameSize, View};
use guideway_spline::{Bounds, Point};
use png::PixelDimensions;

/// Saves a frame as a PNG file, atomically.
///
/// # Errors
/// When the folder cannot be written or its disk is full. An existing file is then unchanged.
pub fn save_png(frame: &Frame, path: impl AsRef<Path>) -> Result<(), SaveError> {
    save_png_by(path, frame.size(), &PngHeader::default(), |sink| {
        sink(frame)
    })
}

/// Saves a picture that is never in memory as a whole as a PNG file, atomically: `draw` hands its
/// rows to the sink, top first, a strip per call.
///
/// # Errors
/// See [`save_png`]; also those of `draw`.
pub fn save_png_by<T, E: From<SaveError>>(
    path: impl AsRef<Path>,
    size: FrameSize,
    header: &PngHeader,
    draw: impl FnOnce(&mut dyn FnMut(&Frame) -> Result<(), E>) -> Result<T, E>,
) -> Result<T, E> {
    let path = path.as_ref();
    let fail = |problem| {
        E::from(SaveError {
            path: path.to_owned(),
            problem,
        })
    };
    replace_file(path, |file| write_png_by(file, size, header, fail, draw))
}

/// Writes a picture as PNG to a stream, strip by strip: see [`save_png_by`]. `fail` converts the
/// errors of the stream.
///
/// # Errors
/// When the stream fails, `draw` hands over too few rows, or `draw` fails.
pub fn write_png_by<T, E>(
    target: impl Write,
    size: FrameSize,
    header: &PngHeader,
    fail: impl Fn(io::Error) -> E,
    draw: impl FnOnce(&mut dyn FnMut(&Frame) -> Result<(), E>) -> Result<T, E>,
) -> Result<T, E> {
    let fail_png = |error| fail(as_io(error));
    let mut target = BufWriter::with_capacity(1 << 16, target);
    let mut encoder = encoder(&mut target, [size.width(), size.height()]);
    encoder.set_pixel_dims(header.print_px_per_m.map(|px_per_m| PixelDimensions {
        xppu: px_per_m.round() as u32,
        yppu: px_per_m.round() as u32,
        unit: png::Unit::Meter,
    }));
    for (keyword, text) in &header.texts {
        let added = encoder.add_itxt_chunk((*keyword).to_owned(), text.clone());
        added.map_err(fail_png)?;
    }
    let mut writer = encoder.write_header().map_err(fail_png)?;
    let stream = writer.stream_writer_with_size(1 << 16);
    let mut stream = stream.map_err(fail_png)?;
    let result = draw(&mut |rows| stream.write_all(rows.bytes()).map_err(&fail))?;
    stream.finish().map_err(fail_png)?;
    writer.finish().map_err(fail_png)?;
    target.flush().map_err(fail)?;
    Ok(result)
}

/// Encodes an image of this width and height, whose sides may exceed those of a frame.
///
/// # Errors
/// When there are fewer pixels than the size has.
pub fn encode_png(size: [u32; 2], pixels: impl Iterator<Item = [u8; 4]>) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut writer = encoder(&mut bytes, size).write_header().map_err(as_io)?;
    let mut stream = writer.stream_writer_with_size(1 << 16).map_err(as_io)?;
    for pixel in pixels {
        stream.write_all(&pixel)?;
    }
    stream.finish().map_err(as_io)?;
    writer.finish().map_err(as_io)?;
    Ok(bytes)
}

fn encoder<'a, W: Write>(target: W, [width, height]: [u32; 2]) -> png::Encoder<'a, W> {
    let mut encoder = png::Encoder::new(target, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    // Measured on D1 at 1920 x 1080: 6 ms instead of the 47 ms of default compression, which is as
    // long as rendering its million paths; files are 1.1 to 1.7 times as large.
    encoder.set_compression(png::Compression::Fast);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder
}

fn as_io(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

/// Texts and size on paper of a PNG file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PngHeader {
    /// Keywords and values of the text chunks (PNG, third edition, 11.3.3).
    pub texts: Vec<(&'static str, String)>,
    /// Pixels per meter of paper or screen, the chunk pHYs; `None` leaves it to the program.
    pub print_px_per_m: Option<f64>,
}

impl PngHeader {
    /// The header of a picture: the program, its title, and its size on paper, at which a point of
    /// its texts is as large as on a screen of 96 dpi.
    pub fn new(title: Option<&str>, px_per_point: f64) -> Self {
        const POINTS_PER_M: f64 = 96.0 / 0.0254;
        let program = format!("Guideway {}", env!("CARGO_PKG_VERSION"));
        let mut texts = vec![("Software", program)];
        texts.extend(title.map(|title| ("Title", title.to_owned())));
        Self {
            texts,
            print_px_per_m: Some(POINTS_PER_M * px_per_point),
        }
    }

    /// Adds where the picture lies: bounds in meters, and scale.
    pub fn push_place(&mut self, view: &View) {
        let Bounds { min, max } = view.world_bounds();
        let bounds = format!("{} {} {} {}", min.x, min.y, max.x, max.y);
        self.texts.push(("guideway:bounds_m", bounds));
        let px_per_m = view.px_per_m().to_string();
        self.texts.push(("guideway:px_per_m", px_per_m));
    }
}

/// The content of a world file, by which QGIS and other geographic information systems place an
/// image: six lines with the size of a pixel, two rotations, and the center of the upper left
/// pixel, in meters (Esri, "World files for raster datasets").
pub fn world_file(view: &View) -> String {
    let pixel_m = 1.0 / view.px_per_m();
    let corner = view.world_bounds();
    let center = Point::new(corner.min.x + 0.5 * pixel_m, corner.max.y - 0.5 * pixel_m);
    format!(
        "{pixel_m}\n0\n0\n{}\n{}\n{}\n",
        -pixel_m, center.x, center.y
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: u32, height: u32) -> Frame {
        let mut frame = Frame::new(FrameSize::new(width, height).unwrap());
        for (i, pixel) in frame.pixels_mut().iter_mut().enumerate() {
            *pixel = [i as u8, 50, 255, 128 + i as u8];
        }
        frame
    }

    #[test]
    fn decodes_to_the_pixels_written_at_once_or_in_strips() {
        let rows = frame(3, 2);
        for times in [1, 5] {
            let size = FrameSize::new(3, 2 * times).unwrap();
            let mut bytes = Vec::new();
            let draw = |sink: &mut dyn FnMut(&Frame) -> io::Result<()>| {
                (0..times).try_for_each(|_| sink(&rows))
            };
            let header = PngHeader {
                print_px_per_m: Some(3779.53),
                ..PngHeader::default()
            };
            write_png_by(&mut bytes, size, &header, |problem| problem, draw).unwrap();

            let mut reader = png::Decoder::new(io::Cursor::new(bytes))
                .read_info()
                .unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            assert_eq!((info.width, info.height), (3, 2 * times));
            assert_eq!(pixels, rows.bytes().repeat(times as usize));
            let printed = reader.info().pixel_dims.unwrap();
            assert_eq!((printed.xppu, printed.yppu), (3780, 3780));
        }
    }

    #[test]
    fn unfinished_picture_leaves_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let size = FrameSize::new(3, 4).unwrap();
        let rows = frame(3, 2);
        let half: Result<(), SaveError> =
            save_png_by(&path, size, &PngHeader::default(), |sink| sink(&rows));
        assert!(half.is_err());
        let stopped = save_png_by(&path, size, &PngHeader::default(), |sink| {
            sink(&rows)?;
            Err(SaveError {
                path: path.clone(),
                problem: io::ErrorKind::Interrupted.into(),
            })
        });
        let stopped: Result<(), SaveError> = stopped;
        assert!(stopped.is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let whole: Result<(), SaveError> =
            save_png_by(&path, size, &PngHeader::default(), |sink| {
                sink(&rows).and_then(|()| sink(&rows))
            });
        assert!(whole.is_ok() && path.is_file());
    }

    #[test]
    fn world_file_maps_pixels_to_their_points() {
        let size = FrameSize::new(40, 20).unwrap();
        let view = View::new(size, Point::new(100.0, -7.0), 8.0).unwrap();
        let text = world_file(&view);
        let numbers: Vec<f64> = text.lines().map(|line| line.parse().unwrap()).collect();
        let [a, d, b, e, c, f] = numbers[..] else {
            panic!("six lines: {text}");
        };
        for pixel in [
            Point::new(0.0, 0.0),
            Point::new(39.0, 19.0),
            Point::new(7.0, 11.0),
        ] {
            let world = Point::new(a * pixel.x + b * pixel.y + c, d * pixel.x + e * pixel.y + f);
            let back = view.pixel_from_world(world);
            let center = pixel + Point::new(0.5, 0.5);
            assert!(back.distance(center) < 1e-9, "{pixel:?}: {back:?}");
        }
    }
}
