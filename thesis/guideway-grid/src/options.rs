//! The variants of the method.

use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt;

use crate::params::HALF_EDGE_PX;

/// Which variant of the method to use. The default is the method as the thesis writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridOptions {
    /// Samples of each segment, 2 to 64; lines are one less.
    pub samples: u32,
    /// Cells along each side of the grid, 1 to 1024; at most 512 with the naive prefix sum.
    pub cells: u32,
    /// How the places of the cells' lists are found.
    pub prefix_sum: PrefixSum,
    /// Which cells a line is entered in.
    pub binning: Binning,
    /// Whether a pixel stops at lines that change nothing any more.
    pub early_exit: bool,
    /// How edges are smoothed.
    pub antialias: Antialias,
}

/// How the places of the cells' lists are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PrefixSum {
    /// Every cell adds up all cells before it (thesis, figure 4.6).
    #[default]
    Naive,
    /// By a work-efficient scan (Harris et al., GPU Gems 3, chapter 39).
    Scan,
}

/// Which cells a line is entered in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Binning {
    /// Those that its box meets (thesis, figure 4.4). What a line covers beyond its box and its cells is
    /// lost.
    #[default]
    LineBox,
    /// Those that its box meets when grown by the radius. Nothing is lost.
    LineBoxWithRadius,
}

/// How edges are smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialias {
    /// By the distance to the nearest line (thesis, 4.3.6).
    #[default]
    Smooth,
    /// Not at all.
    None,
    /// By 32 samples a pixel (thesis, 6.1.2).
    Subpixel,
}

impl Antialias {
    /// How far from a line's edge the middle of a pixel may be that the line leaves a mark on.
    pub(super) fn beyond_px(self) -> f64 {
        match self {
            Self::Smooth => f64::from(HALF_EDGE_PX),
            Self::None => 0.0,
            // Half of a pixel's diagonal.
            Self::Subpixel => FRAC_1_SQRT_2,
        }
    }
}

impl Default for GridOptions {
    fn default() -> Self {
        Self {
            samples: 10,
            cells: 128,
            prefix_sum: PrefixSum::default(),
            binning: Binning::default(),
            early_exit: false,
            antialias: Antialias::default(),
        }
    }
}

const WORDS: &str = "`naive` or `scan`, `radius`, `exit`, `aa=smooth`, `aa=none` or `aa=subpixel`, \
     `samples=` and a number, `cells=` and a number";

/// The prefix sum as written takes half a million times a million additions for 1024 x 1024 cells.
const MOST_NAIVE_CELLS: u32 = 512;

impl GridOptions {
    /// Reads what [`fmt::Display`] writes: words joined by `+`, such as
    /// `scan+radius+exit+aa=subpixel+samples=5+cells=256`. What is not named is as in the default.
    ///
    /// # Errors
    /// A sentence that names the word that is wrong and those that there are.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut options = Self::default();
        let mut topics: Vec<&str> = Vec::new();
        for word in text.split('+').filter(|_| !text.is_empty()) {
            let parts = word.split_once('=');
            let (topic, value) = parts.map_or((word, None), |(topic, value)| (topic, Some(value)));
            match (topic, value) {
                ("naive", None) => options.prefix_sum = PrefixSum::Naive,
                ("scan", None) => options.prefix_sum = PrefixSum::Scan,
                ("radius", None) => options.binning = Binning::LineBoxWithRadius,
                ("exit", None) => options.early_exit = true,
                ("aa", Some("smooth")) => options.antialias = Antialias::Smooth,
                ("aa", Some("none")) => options.antialias = Antialias::None,
                ("aa", Some("subpixel")) => options.antialias = Antialias::Subpixel,
                ("samples", Some(number)) => options.samples = parse_number(word, number)?,
                ("cells", Some(number)) => options.cells = parse_number(word, number)?,
                _ => return Err(format!("`{word}` is no option of `grid`; there is {WORDS}")),
            }
            let topic = if topic == "naive" { "scan" } else { topic };
            if topics.contains(&topic) {
                return Err(format!(
                    "`{text}`: `{word}` repeats or contradicts a word before it"
                ));
            }
            topics.push(topic);
        }
        options.check()?;
        Ok(options)
    }

    /// Whether all numbers are possible.
    ///
    /// # Errors
    /// A sentence that names the one that is not, and those that are.
    pub fn check(&self) -> Result<(), String> {
        if !(2..=64).contains(&self.samples) {
            return Err(format!(
                "{} samples are not possible: 2 to 64 are",
                self.samples
            ));
        }
        if !(1..=1024).contains(&self.cells) {
            return Err(format!(
                "{} cells a side are not possible: 1 to 1024 are",
                self.cells
            ));
        }
        if self.prefix_sum == PrefixSum::Naive && self.cells > MOST_NAIVE_CELLS {
            return Err(format!(
                "the naive prefix sum takes too long for {0} x {0} cells: add `scan`, or ask for \
                 {MOST_NAIVE_CELLS} at most",
                self.cells
            ));
        }
        Ok(())
    }

    /// Lines that a segment becomes.
    pub(super) fn lines_a_segment(&self) -> u32 {
        self.samples - 1
    }

    /// All cells of the grid.
    pub(super) fn cell_count(&self) -> u32 {
        self.cells * self.cells
    }
}

fn parse_number(word: &str, number: &str) -> Result<u32, String> {
    let number = number.parse();
    number.map_err(|_| format!("`{word}` is not possible: it takes a whole number"))
}

impl fmt::Display for GridOptions {
    /// The words of [`GridOptions::parse`] for what differs from the default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let usual = Self::default();
        let antialias = match self.antialias {
            Antialias::Smooth => "",
            Antialias::None => "aa=none",
            Antialias::Subpixel => "aa=subpixel",
        };
        let number = |name, value, usual| {
            let differs = value != usual;
            differs.then(|| format!("{name}={value}"))
        };
        let word = |holds: bool, word: &str| holds.then(|| word.to_owned());
        let words = [
            word(self.prefix_sum == PrefixSum::Scan, "scan"),
            word(self.binning == Binning::LineBoxWithRadius, "radius"),
            word(self.early_exit, "exit"),
            word(!antialias.is_empty(), antialias),
            number("samples", self.samples, usual.samples),
            number("cells", self.cells, usual.cells),
        ];
        let words: Vec<_> = words.into_iter().flatten().collect();
        f.write_str(&words.join("+"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_variant_is_read_as_it_is_written() {
        for text in [
            "",
            "scan",
            "radius",
            "exit",
            "aa=none",
            "samples=5",
            "cells=256",
            "scan+radius+exit+aa=subpixel+samples=64+cells=1024",
        ] {
            assert_eq!(GridOptions::parse(text).unwrap().to_string(), text);
        }
        assert_eq!(
            GridOptions::parse("aa=smooth+naive"),
            Ok(GridOptions::default())
        );
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, named) in [
            ("scam", "`scam` is no option"),
            ("scan+", "`` is no option"),
            ("scan=1", "`scan=1` is no option"),
            ("aa", "`aa` is no option"),
            ("aa=fast", "`aa=fast` is no option"),
            ("samples=1", "2 to 64"),
            ("samples=", "`samples=` is not possible"),
            ("scan+cells=1025", "1 to 1024"),
            ("cells=-1", "`cells=-1` is not possible"),
            ("cells=513", "add `scan`"),
            ("naive+scan", "`scan` repeats"),
            ("exit+exit", "`exit` repeats"),
        ] {
            let message = GridOptions::parse(text).unwrap_err();
            assert!(message.contains(named), "{text}: {message}");
        }
    }
}
