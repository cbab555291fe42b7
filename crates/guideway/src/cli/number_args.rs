//! Options for the colors of numbers, beside `--color-by`.

use guideway::scene::{ClassBreaks, Palette};

use super::values;

#[derive(Debug, clap::Args)]
pub(crate) struct NumberArgs {
    /// Colors of the numbers of that column [default: warm]
    #[arg(long, value_name = "NAME", requires = "color_by", value_parser = values::palette())]
    pub(crate) palette: Option<Palette>,
    /// Numbers at both ends of the palette, such as 0..2 [default: the least and the largest one]
    #[arg(
        long,
        value_name = "MIN..MAX",
        requires = "color_by",
        value_parser = values::range,
        allow_hyphen_values = true
    )]
    pub(crate) range: Option<[f64; 2]>,
    /// Classes between these ascending numbers, such as 0.3,0.6,1, instead of a range [default: a
    /// continuous scale, or a class per number if there are few]
    #[arg(
        long,
        value_name = "A,B",
        requires = "color_by",
        conflicts_with = "range",
        value_parser = values::breaks,
        allow_hyphen_values = true
    )]
    pub(crate) breaks: Option<ClassBreaks>,
}
