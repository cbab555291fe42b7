//! The objects of a PDF file with one page, and the table of their places.

use std::collections::BTreeSet;
use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::content::{FACTOR_DECIMALS, operands};

/// Numbers of the objects that every file has.
const CATALOG: usize = 1;
const PAGES: usize = 2;
const PAGE: usize = 3;
const CONTENT: usize = 4;
const RESOURCES: usize = 5;
const INFO: usize = 6;

/// The resources of a page, by kind.
pub(super) struct Objects {
    /// Opacities of graphics states.
    alphas: BTreeSet<u8>,
    /// Dictionaries and compressed streams from the first number after [`INFO`], and the names of
    /// those that contents refer to.
    streams: Vec<(String, Vec<u8>)>,
    names: Vec<(String, usize)>,
}

impl Objects {
    pub(super) fn new() -> Self {
        Self {
            alphas: BTreeSet::new(),
            streams: Vec::new(),
            names: Vec::new(),
        }
    }

    /// The name of a graphics state with this opacity, 0 to 255.
    pub(super) fn alpha(&mut self, alpha: u8) -> String {
        self.alphas.insert(alpha);
        format!("A{alpha}")
    }

    /// Adds a group whose content is composited as a whole. Returns its name.
    pub(super) fn form(&mut self, content: Vec<u8>, size_px: [f64; 2]) -> String {
        let name = format!("F{}", self.names.len() + 1);
        let dictionary = format!(
            "/Type/XObject/Subtype/Form/BBox[0 0 {}]/Resources {RESOURCES} 0 R\
             /Group<</S/Transparency/CS/DeviceRGB>>",
            operands(&size_px, FACTOR_DECIMALS).trim_end()
        );
        self.add(name, dictionary, content)
    }

    /// Adds an image of straight RGBA. Returns its name.
    pub(super) fn image(
        &mut self,
        [width, height]: [u32; 2],
        pixels: impl Iterator<Item = [u8; 4]>,
    ) -> io::Result<String> {
        let mut colors = ZlibEncoder::new(Vec::new(), Compression::default());
        let mut alphas = ZlibEncoder::new(Vec::new(), Compression::default());
        for [r, g, b, a] in pixels {
            colors.write_all(&[r, g, b])?;
            alphas.write_all(&[a])?;
        }
        let common =
            format!("/Type/XObject/Subtype/Image/Width {width}/Height {height}/BitsPerComponent 8");
        self.streams
            .push((format!("{common}/ColorSpace/DeviceGray"), alphas.finish()?));
        let mask = INFO + self.streams.len();
        let name = format!("I{}", self.names.len() + 1);
        let dictionary = format!("{common}/ColorSpace/DeviceRGB/SMask {mask} 0 R");
        Ok(self.add(name, dictionary, colors.finish()?))
    }

    fn add(&mut self, name: String, dictionary: String, stream: Vec<u8>) -> String {
        self.streams.push((dictionary, stream));
        self.names.push((name.clone(), INFO + self.streams.len()));
        name
    }

    /// Writes the file: `units` are the sides of the page, each `user_unit` points long.
    pub(super) fn write(
        self,
        content: Vec<u8>,
        units: [f64; 2],
        user_unit: f64,
        info: &str,
        out: &mut impl Write,
    ) -> io::Result<()> {
        let mut file = File {
            out,
            bytes: 0,
            places: Vec::new(),
        };
        // Bytes beyond ASCII tell programs that the file is not a text.
        file.write(b"%PDF-1.6\n%\xC3\xA9\xC3\xA9\n")?;
        file.object(&format!("<</Type/Catalog/Pages {PAGES} 0 R>>"))?;
        file.object(&format!("<</Type/Pages/Kids[{PAGE} 0 R]/Count 1>>"))?;
        let media = operands(&units, FACTOR_DECIMALS);
        let unit = match user_unit > 1.0 {
            true => format!(
                "/UserUnit {}",
                operands(&[user_unit], FACTOR_DECIMALS).trim_end()
            ),
            false => String::new(),
        };
        file.object(&format!(
            "<</Type/Page/Parent {PAGES} 0 R/MediaBox[0 0 {}]{unit}/Resources {RESOURCES} 0 R\
             /Group<</S/Transparency/CS/DeviceRGB>>/Contents {CONTENT} 0 R>>",
            media.trim_end()
        ))?;
        file.stream("", &content)?;
        file.object(&self.resources())?;
        file.object(info)?;
        for (dictionary, stream) in &self.streams {
            file.stream(dictionary, stream)?;
        }
        file.finish()
    }

    fn resources(&self) -> String {
        let mut text = "<</ExtGState<<".to_owned();
        for alpha in &self.alphas {
            let opacity = operands(&[f64::from(*alpha) / 255.0], FACTOR_DECIMALS);
            text += &format!("/A{alpha}<</ca {opacity}/CA {opacity}>>");
        }
        text += ">>/XObject<<";
        for (name, number) in &self.names {
            text += &format!("/{name} {number} 0 R");
        }
        text + ">>>>"
    }
}

/// Writes objects in order and remembers their places.
struct File<'w, W> {
    out: &'w mut W,
    bytes: u64,
    places: Vec<u64>,
}

impl<W: Write> File<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.bytes += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    fn object(&mut self, body: &str) -> io::Result<()> {
        self.places.push(self.bytes);
        let text = format!("{} 0 obj\n{body}\nendobj\n", self.places.len());
        self.write(text.as_bytes())
    }

    fn stream(&mut self, dictionary: &str, stream: &[u8]) -> io::Result<()> {
        self.places.push(self.bytes);
        let head = format!(
            "{} 0 obj\n<<{dictionary}/Filter/FlateDecode/Length {}>>stream\n",
            self.places.len(),
            stream.len()
        );
        self.write(head.as_bytes())?;
        self.write(stream)?;
        self.write(b"\nendstream\nendobj\n")
    }

    fn finish(mut self) -> io::Result<()> {
        let (table, count) = (self.bytes, self.places.len() + 1);
        let mut text = format!("xref\n0 {count}\n0000000000 65535 f \n");
        for place in &self.places {
            text += &format!("{place:010} 00000 n \n");
        }
        text += &format!(
            "trailer\n<</Size {count}/Root {CATALOG} 0 R/Info {INFO} 0 R>>\nstartxref\n{table}\n\
             %%EOF\n"
        );
        self.write(text.as_bytes())
    }
}

/// A text as UTF-16 in hexadecimal digits.
pub(super) fn text_string(text: &str) -> String {
    let units = text.encode_utf16().map(|unit| format!("{unit:04X}"));
    format!("<FEFF{}>", units.collect::<String>())
}
