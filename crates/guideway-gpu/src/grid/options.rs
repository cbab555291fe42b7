//! The variants of the method.

use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt;

use super::params::HALF_EDGE_PX;

/// Which variant of the method to use. The default is the method as the thesis writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridOptions {
    /// Samples of each segment, 2 to 64: one line less.
    pub samples: u32,
    /// Cells along each side of the grid, 1 to 1024.
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
     `samples=` 2 to 64 and `cells=` 1 to 1024";

impl GridOptions {
    /// Reads what [`fmt::Display`] writes: words joined by `+`, such as
    /// `scan+radius+exit+aa=subpixel+samples=5+cells=256`. What is not named is as in the default.
    ///
    /// # Errors
    /// A sentence that names the word that is wrong and those that there are.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut options = Self::default();
        let mut given: Vec<&str> = Vec::new();
        for word in text.split('+').filter(|_| !text.is_empty()) {
            let (topic, value) = word.split_once('=').unwrap_or((word, ""));
            let topic = match (topic, value) {
                ("naive", "") => {
                    options.prefix_sum = PrefixSum::Naive;
                    "the prefix sum"
                }
                ("scan", "") => {
                    options.prefix_sum = PrefixSum::Scan;
                    "the prefix sum"
                }
                ("radius", "") => {
                    options.binning = Binning::LineBoxWithRadius;
                    "`radius`"
                }
                ("exit", "") => {
                    options.early_exit = true;
                    "`exit`"
                }
                ("aa", _) => {
                    options.antialias = match value {
                        "smooth" => Antialias::Smooth,
                        "none" => Antialias::None,
                        "subpixel" => Antialias::Subpixel,
                        _ => {
                            return Err(format!(
                                "`{word}` is no option of `grid`; there is {WORDS}"
                            ));
                        }
                    };
                    "`aa`"
                }
                ("samples", _) => {
                    options.samples = number(word, value, 2, 64)?;
                    "`samples`"
                }
                ("cells", _) => {
                    options.cells = number(word, value, 1, 1024)?;
                    "`cells`"
                }
                _ => return Err(format!("`{word}` is no option of `grid`; there is {WORDS}")),
            };
            if given.contains(&topic) {
                return Err(format!("`{text}` names {topic} twice"));
            }
            given.push(topic);
        }
        Ok(options)
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

fn number(word: &str, value: &str, least: u32, most: u32) -> Result<u32, String> {
    let found = value.parse().ok().filter(|n| (least..=most).contains(n));
    found.ok_or_else(|| {
        format!("`{word}` is not possible: it takes a number from {least} to {most}")
    })
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
            ("scam", "`scam`"),
            ("scan+", "``"),
            ("scan=1", "`scan=1`"),
            ("aa", "`aa`"),
            ("aa=fast", "`aa=fast`"),
            ("samples=1", "from 2 to 64"),
            ("samples=", "`samples=`"),
            ("cells=1025", "from 1 to 1024"),
            ("cells=-1", "`cells=-1`"),
            ("naive+scan", "the prefix sum twice"),
            ("exit+exit", "`exit` twice"),
        ] {
            let message = GridOptions::parse(text).unwrap_err();
            assert!(message.contains(named), "{text}: {message}");
        }
    }
}
