//! Options of the method: reads, checks and writes the words after its name.

use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt;

use crate::error::OptionsError;
use crate::params::HALF_EDGE_PX;

/// Options of the method. The default is the method of the thesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridOptions {
    /// Samples per segment, 2 to 64; a segment has one line less.
    pub samples: u32,
    /// Cells per side of the grid, 1 to 1024; at most 512 with the naive prefix sum.
    pub cells: u32,
    /// Algorithm that computes the starts of the cells' lists.
    pub prefix_sum: PrefixSum,
    /// Rule that selects the cells that list a line.
    pub binning: Binning,
    /// Stops testing a pixel once it is fully covered.
    pub early_exit: bool,
    /// Antialiasing of edges.
    pub antialias: Antialias,
}

/// Algorithm that computes the starts of the cells' lists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PrefixSum {
    /// Every cell sums all cells before it (thesis, figure 4.6): quadratic cost.
    #[default]
    Naive,
    /// A work-efficient scan (Harris et al., GPU Gems 3, chapter 39): linear cost.
    Scan,
}

/// Rule that selects the cells that list a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Binning {
    /// Cells that overlap the bounds of the line without its width (thesis, figure 4.4). The parts
    /// of the stroke in other cells are missing.
    #[default]
    LineBox,
    /// Cells that overlap the bounds of the whole stroke. No part is missing.
    LineBoxWithRadius,
}

/// Antialiasing of edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialias {
    /// Coverage from the distance to the nearest line (thesis, 4.3.6).
    #[default]
    Smooth,
    /// No antialiasing.
    None,
    /// 32 samples per pixel (thesis, 6.1.2).
    Subpixel,
}

impl Antialias {
    /// Largest distance from a line's edge to the center of a pixel that the line changes, in
    /// pixels.
    pub fn margin_px(self) -> f64 {
        match self {
            Self::Smooth => f64::from(HALF_EDGE_PX),
            Self::None => 0.0,
            // derived: half the diagonal of a pixel.
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

/// derived: the naive prefix sum of 1024 x 1024 cells would take 5.5e11 additions; 512 x 512 cells
/// take a sixteenth of that.
const MAX_NAIVE_CELLS: u32 = 512;

impl GridOptions {
    /// Parses the output of [`fmt::Display`]: words joined by `+`, such as
    /// `scan+radius+exit+aa=subpixel+samples=5+cells=256`. Options without a word have their
    /// default.
    ///
    /// # Errors
    /// When a word is unknown, repeats an earlier one, or has a value out of range.
    pub fn parse(text: &str) -> Result<Self, OptionsError> {
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
                _ => {
                    let option = word.to_owned();
                    return Err(OptionsError::Unknown { option });
                }
            }
            let topic = if topic == "naive" { "scan" } else { topic };
            if topics.contains(&topic) {
                return Err(OptionsError::Repeated {
                    text: text.to_owned(),
                    option: word.to_owned(),
                });
            }
            topics.push(topic);
        }
        options.check()?;
        Ok(options)
    }

    /// Checks that all numbers are in range.
    ///
    /// # Errors
    /// When a number is out of range: the error names it and the range.
    pub fn check(&self) -> Result<(), OptionsError> {
        let (samples, cells) = (self.samples, self.cells);
        if !(2..=64).contains(&samples) {
            return Err(OptionsError::Samples { samples });
        }
        if !(1..=1024).contains(&cells) {
            return Err(OptionsError::Cells { cells });
        }
        if self.prefix_sum == PrefixSum::Naive && cells > MAX_NAIVE_CELLS {
            let limit = MAX_NAIVE_CELLS;
            return Err(OptionsError::TooManyNaiveCells { cells, limit });
        }
        Ok(())
    }

    /// Lines per segment.
    pub(super) fn lines_per_segment(&self) -> u32 {
        self.samples - 1
    }

    /// Number of cells of the grid.
    pub(super) fn cell_count(&self) -> u32 {
        self.cells * self.cells
    }
}

fn parse_number(word: &str, number: &str) -> Result<u32, OptionsError> {
    number.parse().map_err(|_| OptionsError::NotANumber {
        option: word.to_owned(),
    })
}

impl fmt::Display for GridOptions {
    /// Writes the words of [`GridOptions::parse`] for all options that differ from their default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let default = Self::default();
        let antialias = match self.antialias {
            Antialias::Smooth => "",
            Antialias::None => "aa=none",
            Antialias::Subpixel => "aa=subpixel",
        };
        let number = |name, value, default| (value != default).then(|| format!("{name}={value}"));
        let word = |is_set: bool, word: &str| is_set.then(|| word.to_owned());
        let words = [
            word(self.prefix_sum == PrefixSum::Scan, "scan"),
            word(self.binning == Binning::LineBoxWithRadius, "radius"),
            word(self.early_exit, "exit"),
            word(!antialias.is_empty(), antialias),
            number("samples", self.samples, default.samples),
            number("cells", self.cells, default.cells),
        ];
        let words: Vec<_> = words.into_iter().flatten().collect();
        f.write_str(&words.join("+"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_what_display_writes() {
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
    fn names_the_wrong_option_and_the_limit() {
        for (text, named) in [
            ("scam", "unknown option `scam`"),
            ("scan+", "unknown option ``"),
            ("scan=1", "unknown option `scan=1`"),
            ("aa", "unknown option `aa`"),
            ("aa=fast", "unknown option `aa=fast`"),
            ("samples=1", "2 to 64"),
            ("samples=", "invalid option `samples=`"),
            ("scan+cells=1025", "1 to 1024"),
            ("cells=-1", "invalid option `cells=-1`"),
            ("cells=513", "add `scan`"),
            ("naive+scan", "`scan` repeats"),
            ("exit+exit", "`exit` repeats"),
        ] {
            let message = GridOptions::parse(text).unwrap_err().to_string();
            assert!(message.contains(named), "{text}: {message}");
        }
    }
}
