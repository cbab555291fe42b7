//! The methods by hardware tessellation: `tessellation` and `tessellation-compact`.

use std::sync::{Arc, LazyLock};

use guideway_scene::Method;
use guideway_tessellation::{Commands, GlDevice, GlError, Tessellation, TessellationOptions};

use super::entry::{Implementation, MethodOption, StartError};

pub(super) const PER_PATH: Implementation = Implementation {
    options: OPTIONS,
    start: |options| start(options, Commands::PerPath),
};

pub(super) const COMPACT: Implementation = Implementation {
    options: OPTIONS,
    start: |options| start(options, Commands::Compact),
};

const OPTIONS: &[MethodOption] = &[MethodOption {
    name: "aa=multisample",
    summary: "8 samples per pixel, or 4 if the device has no more",
}];

/// Opened once for all methods and options.
static DEVICE: LazyLock<Result<Arc<GlDevice>, GlError>> = LazyLock::new(GlDevice::new);

fn start(options: &str, commands: Commands) -> Result<Box<dyn Method>, StartError> {
    let options = TessellationOptions {
        commands,
        ..TessellationOptions::parse(options)
            .map_err(|error| StartError::Options(error.to_string()))?
    };
    let device = DEVICE
        .as_ref()
        .map_err(|error| StartError::Unavailable(error.to_string()))?;
    Ok(Box::new(Tessellation::new(Arc::clone(device), options)))
}
