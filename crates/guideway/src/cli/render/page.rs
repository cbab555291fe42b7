//! `render -o site.html`: the page of `share` with the view and the colors of a picture.

use std::path::Path;

use guideway::AUTO;
use guideway::layout::UserError;
use guideway::scene::{Palette, Rgba, Shading};

use super::args::Args;
use crate::cli::error::{Exit, usage_error};
use crate::cli::output::Output;
use crate::cli::share::{self, Content, SharedLook};

impl Args {
    /// Writes the page.
    pub(super) fn write_page(&self, output: &Path, out: &Output) -> Result<Exit, UserError> {
        let options = self.options()?;
        let others = [
            ("--world-file", self.world_file),
            ("--to", self.to.is_some()),
            ("--method", self.method() != AUTO),
        ];
        let decorations = self.decorations.absent_in_pages();
        let absent = others.into_iter().chain(decorations);
        let mut absent = absent.chain(self.style.absent_in_pages());
        if let Some((option, _)) = absent.find(|(_, is_given)| *is_given) {
            return Err(usage_error(
                format!("{option} does not apply to a page"),
                format!("Omit {option}, or save the picture as PNG"),
            ));
        }
        let viewport = options.viewport;
        let background = Some(options.style.background).filter(|color| *color != Rgba::WHITE);
        let decorations = self.decorations.decorations(&self.inputs);
        let numbers = &self.style.numbers;
        let look = SharedLook {
            width: Some(viewport.size.width()),
            height: Some(viewport.size.height()),
            center: viewport.center_m.map(|center| [center.x, center.y]),
            px_per_m: viewport.px_per_m,
            level: options.scene.level,
            color_by: options.scene.color_by.map(|by| by.column),
            palette: numbers.palette.map(Palette::name),
            range: numbers.range,
            breaks: numbers.breaks.map(|breaks| breaks.numbers().to_vec()),
            envelope: self.view.envelope,
            shade: (options.style.shading != Shading::Color).then_some("density"),
            background: background.map(|color| format!("{:06x}", color.to_u32() >> 8)),
            legend: (self.style.legend || decorations.has_legend).then_some(true),
        };
        let content = Content {
            inputs: &self.inputs,
            floor_plan: self.floor_plan(),
            title: decorations.title.as_deref(),
        };
        share::write(&content, output, &look, out)
    }
}
