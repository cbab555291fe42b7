use std::sync::{Arc, LazyLock};

use guideway_gpu::{DeviceError, Gpu, Tiles, TilesOptions};
use guideway_grid::{Grid, GridOptions};
use guideway_scene::Method;

use super::{Entry, MethodOption, Stop};

pub(super) const TILES: Entry = Entry {
    name: "gpu",
    summary: "Every frame from the control points, by compute shaders; every path its own color and width",
    options: &[
        MethodOption {
            name: "rebuild",
            summary: "keeps nothing from frame to frame, to measure what that costs",
        },
        MethodOption {
            name: "stages",
            summary: "tells how long each stage of a frame takes, for which the device stops between them",
        },
    ],
    is_general: true,
    start: |options| {
        let mut asked = TilesOptions::default();
        for option in options.split('+').filter(|option| !option.is_empty()) {
            match option {
                "rebuild" => asked.reuses_frames = false,
                "stages" => asked.times_stages = true,
                _ => {
                    let what = format!("there is no option `{option}`; there are: rebuild, stages");
                    return Err(Stop::Options(what));
                }
            }
        }
        let device = DEVICE
            .as_ref()
            .map_err(|error| Stop::Missing(error.to_string()))?;
        let tiles = Tiles::new(Arc::clone(device), asked);
        Ok(Box::new(
            tiles.map_err(|error| Stop::Missing(error.to_string()))?,
        ))
    },
};

pub(super) const GRID: Entry = Entry {
    name: "grid",
    summary: "The thesis' test of every pixel against the lines of its cell; one color",
    options: &[
        MethodOption {
            name: "scan",
            summary: "prefix sum in linear work, not the quadratic one as written",
        },
        MethodOption {
            name: "radius",
            summary: "lines are listed in every cell that they cover: none is cut at a border",
        },
        MethodOption {
            name: "exit",
            summary: "a pixel stops once it is fully covered",
        },
        MethodOption {
            name: "aa=none",
            summary: "hard edges, not smooth ones",
        },
        MethodOption {
            name: "aa=subpixel",
            summary: "32 sub-samples a pixel",
        },
        MethodOption {
            name: "samples=5",
            summary: "samples a segment, 10 as written",
        },
        MethodOption {
            name: "cells=256",
            summary: "cells a side of the grid, 128 as written",
        },
    ],
    is_general: false,
    start,
};

/// Whether there is a graphics device that is more than a program on the processor.
pub(super) fn is_in_hardware() -> bool {
    DEVICE.as_ref().is_ok_and(|device| !device.is_software())
}

/// Opened once, for all methods and options.
static DEVICE: LazyLock<Result<Arc<Gpu>, DeviceError>> = LazyLock::new(Gpu::new);

fn start(options: &str) -> Result<Box<dyn Method>, Stop> {
    let options = GridOptions::parse(options).map_err(Stop::Options)?;
    let device = DEVICE
        .as_ref()
        .map_err(|error| Stop::Missing(error.to_string()))?;
    let grid = Grid::new(Arc::clone(device), options).map_err(Stop::Missing)?;
    Ok(Box::new(grid))
}
