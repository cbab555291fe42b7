use std::sync::{Arc, LazyLock};

use guideway_scene::Method;
use guideway_tessellation::{Commands, GlDevice, Tessellation, TessellationOptions};

use super::{Entry, MethodOption, Stop};

pub(super) const PER_PATH: Entry = Entry {
    name: "tessellation",
    summary: "The thesis' hardware tessellation, a draw command a path; one color, 1 pixel wide",
    options: OPTIONS,
    is_general: false,
    start: |options| start(options, Commands::PerPath),
};

pub(super) const COMPACT: Entry = Entry {
    name: "tessellation-compact",
    summary: "The same by one draw of all visible segments",
    options: OPTIONS,
    is_general: false,
    start: |options| start(options, Commands::Compact),
};

const OPTIONS: &[MethodOption] = &[MethodOption {
    name: "aa=multisample",
    summary: "8 samples a pixel, or 4 where the device has no more",
}];

/// Opened once, for all methods and options.
static DEVICE: LazyLock<Result<Arc<GlDevice>, String>> = LazyLock::new(GlDevice::new);

fn start(options: &str, commands: Commands) -> Result<Box<dyn Method>, Stop> {
    let options = TessellationOptions {
        commands,
        ..TessellationOptions::parse(options).map_err(Stop::Options)?
    };
    let device = DEVICE.as_ref().map_err(|why| Stop::Missing(why.clone()))?;
    Ok(Box::new(Tessellation::new(Arc::clone(device), options)))
}
