//! A virtual screen: shows the window of a program, presses keys, and gives the pixels.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, bail};

use super::build::FOLDER;
use crate::step::command;

/// Polls before a wait fails: three minutes, for other tests can run beside.
const MAX_POLLS: usize = 1800;
/// Title of the window.
const TITLE: &str = "Guideway";

/// A server of X with one screen; it ends with this value.
pub(super) struct Screen {
    server: Child,
    display: String,
    pixels: PathBuf,
}

/// The pixels of a screen: red, green and blue, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Picture {
    width: u32,
    height: u32,
    rgb: Vec<[u8; 3]>,
}

impl Screen {
    /// Starts a screen of 1280 x 800 pixels.
    pub(super) fn start() -> Result<Self> {
        let folder = std::env::current_dir()?.join(FOLDER).join("screen");
        fs::create_dir_all(&folder)?;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24"])
            .args(["-nolisten", "tcp", "-noreset", "-r", "-fbdir"])
            .arg(&folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .context("cannot start Xvfb")?;
        let mut number = String::new();
        let said = server.stdout.take().context("Xvfb has an output")?;
        BufReader::new(said).read_line(&mut number)?;
        Ok(Self {
            server,
            display: format!(":{}", number.trim()),
            pixels: folder.join("Xvfb_screen0"),
        })
    }

    /// The variable `DISPLAY` of programs on this screen.
    pub(super) fn display(&self) -> &str {
        &self.display
    }

    /// Waits for the window, and gives it the keyboard.
    pub(super) fn focus_window(&self) -> Result<()> {
        let search = ["search", "--onlyvisible", "--name", TITLE];
        let is_there = polls().any(|()| self.xdotool(&search).is_ok());
        if !is_there {
            bail!("no window appeared within three minutes");
        }
        // Without a window manager nothing has the keyboard.
        self.xdotool(&[&search[..], &["windowfocus", "--sync"]].concat())
    }

    /// Presses a key, such as `ctrl+q`.
    pub(super) fn key(&self, key: &str) -> Result<()> {
        self.xdotool(&["key", key])
    }

    fn xdotool(&self, args: &[&str]) -> Result<()> {
        let done = command("xdotool").args(args).env("DISPLAY", &self.display);
        match done.succeeds() {
            true => Ok(()),
            false => bail!("xdotool {args:?} failed"),
        }
    }

    /// The pixels of now.
    pub(super) fn picture(&self) -> Result<Picture> {
        Picture::of_dump(&fs::read(&self.pixels)?).context("the screen is no X window dump")
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Picture {
    /// Reads an X window dump of 32 bits per pixel, as Xvfb writes it.
    fn of_dump(dump: &[u8]) -> Option<Self> {
        const COLOR_BYTES: usize = 12;
        let number = |index: usize| {
            let bytes = dump.get(4 * index..4 * index + 4)?;
            Some(u32::from_be_bytes(bytes.try_into().ok()?))
        };
        let (width, height) = (number(4)?, number(5)?);
        let (header_len, color_count) = (number(0)? as usize, number(19)? as usize);
        let pixels = dump.get(header_len + COLOR_BYTES * color_count..)?;
        let (pixels, _) = pixels.as_chunks::<4>();
        let pixels = pixels.get(..width as usize * height as usize)?;
        let rgb = pixels
            .iter()
            .map(|[blue, green, red, _]| [*red, *green, *blue]);
        Some(Self {
            width,
            height,
            rgb: rgb.collect(),
        })
    }

    /// Number of pixels within 8 of a color.
    pub(super) fn count(&self, color: [u8; 3]) -> usize {
        let is_near = |pixel: &&[u8; 3]| {
            let mut channels = pixel.iter().zip(color);
            channels.all(|(channel, wanted)| channel.abs_diff(wanted) <= 8)
        };
        self.rgb.iter().filter(is_near).count()
    }

    /// Writes a PNG file.
    pub(super) fn save(&self, file: &Path) -> Result<()> {
        let file = fs::File::create(file).with_context(|| file.display().to_string())?;
        let mut encoder = png::Encoder::new(file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.rgb.as_flattened())?;
        Ok(writer.finish()?)
    }
}

/// Waits a tenth of a second per item, for at most three minutes.
pub(super) fn polls() -> impl Iterator<Item = ()> {
    (0..MAX_POLLS).map(|_| thread::sleep(Duration::from_millis(100)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dump_becomes_pixels_and_a_short_one_none() {
        let mut header = [0_u32; 25];
        (header[0], header[4], header[5]) = (100, 2, 1);
        let mut dump: Vec<u8> = header.iter().flat_map(|word| word.to_be_bytes()).collect();
        dump.extend([3, 2, 1, 0, 0x7f, 0x6b, 0x5a, 0]);
        let picture = Picture::of_dump(&dump).unwrap();
        assert_eq!(picture.rgb, [[1, 2, 3], [0x5a, 0x6b, 0x7f]]);
        assert_eq!(picture.count([0x5f, 0x6b, 0x7a]), 1);
        assert_eq!(picture.count([0x6f, 0x6b, 0x7a]), 0);
        assert_eq!(Picture::of_dump(&dump[..dump.len() - 1]), None);
        assert_eq!(Picture::of_dump(b""), None);
    }
}
