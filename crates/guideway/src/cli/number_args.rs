//! Options for the colors of numbers, beside `--color-by`.

use guideway::scene::Palette;

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
}
