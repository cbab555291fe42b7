//! The methods by compute shaders: `gpu`, `grid`, `tree` and `quadtree`.

use std::sync::{Arc, Mutex, PoisonError};

use guideway_gpu::{DeviceError, Gpu, Tiles, TilesOptions};
use guideway_grid::{Grid, GridOptions};
use guideway_scene::Method;
use guideway_tree::{Structure, TreeOptions, Trees};

use super::entry::{Implementation, MethodOption, StartError};

pub(super) const TILES: Implementation = Implementation {
    options: &[
        MethodOption {
            name: "rebuild",
            summary: "renders each frame from scratch, to measure the gain of reuse",
        },
        MethodOption {
            name: "stages",
            summary: "measures each stage of a frame; the device waits between stages",
        },
    ],
    start: |options| {
        let mut selected = TilesOptions::default();
        for option in options.split('+').filter(|option| !option.is_empty()) {
            match option {
                "rebuild" => selected.reuses_frames = false,
                "stages" => selected.times_stages = true,
                _ => {
                    let problem = format!("unknown option `{option}`; known are: rebuild, stages");
                    return Err(StartError::Options(problem));
                }
            }
        }
        let tiles = Tiles::new(device()?, selected).map_err(unavailable)?;
        Ok(Box::new(tiles))
    },
};

pub(super) const GRID: Implementation = Implementation {
    options: &[
        MethodOption {
            name: "scan",
            summary: "prefix sum of linear cost instead of the quadratic one of the thesis",
        },
        MethodOption {
            name: "radius",
            summary: "lists lines in every cell under their stroke, so that no border cuts them",
        },
        MethodOption {
            name: "exit",
            summary: "stops testing a pixel once it is fully covered",
        },
        MethodOption {
            name: "aa=none",
            summary: "no antialiasing",
        },
        MethodOption {
            name: "aa=subpixel",
            summary: "32 samples per pixel",
        },
        MethodOption {
            name: "samples=5",
            summary: "samples per segment, 10 in the thesis",
        },
        MethodOption {
            name: "cells=256",
            summary: "cells per side of the grid, 128 in the thesis",
        },
    ],
    start,
};

pub(super) const TREE: Implementation = Implementation {
    options: TREE_OPTIONS,
    start: |options| start_tree(Structure::Tree, options),
};

pub(super) const QUADTREE: Implementation = Implementation {
    options: TREE_OPTIONS,
    start: |options| start_tree(Structure::Quadtree, options),
};

const TREE_OPTIONS: &[MethodOption] = &[
    MethodOption {
        name: "tiles",
        summary: "the pixels of a tile search together, instead of each alone as in the thesis",
    },
    MethodOption {
        name: "exit",
        summary: "skips what lies below pixels that are fully covered",
    },
    MethodOption {
        name: "aa=none",
        summary: "no antialiasing",
    },
    MethodOption {
        name: "aa=subpixel",
        summary: "32 samples per pixel, and a color per path",
    },
    MethodOption {
        name: "samples=5",
        summary: "samples per segment, 10 in the thesis",
    },
];

/// Returns `true` if the graphics device is hardware, not a software implementation.
pub(super) fn is_in_hardware() -> bool {
    device().is_ok_and(|device| !device.is_software())
}

/// The graphics adapters of this computer with their drivers, hardware first.
pub(super) fn adapters() -> Option<Vec<String>> {
    Some(guideway_gpu::adapters())
}

/// Names and values of the limits of the graphics device; empty without one.
pub(super) fn limits() -> Vec<(String, String)> {
    device().map_or(Vec::new(), |device| device.limits())
}

/// The device of all methods and options, or why there is none; `None` until one is needed.
static DEVICE: Mutex<Option<Result<Arc<Gpu>, DeviceError>>> = Mutex::new(None);

/// Makes methods that start from now on draw on a device that the caller opened, with the limits
/// and features of [`Gpu::descriptor`], so that their pictures can stay on it.
pub fn share_device(gpu: Arc<Gpu>) {
    *DEVICE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Ok(gpu));
}

fn start(options: &str) -> Result<Box<dyn Method>, StartError> {
    let options =
        GridOptions::parse(options).map_err(|error| StartError::Options(error.to_string()))?;
    let grid = Grid::new(device()?, options).map_err(unavailable)?;
    Ok(Box::new(grid))
}

fn start_tree(structure: Structure, options: &str) -> Result<Box<dyn Method>, StartError> {
    let options =
        TreeOptions::parse(options).map_err(|error| StartError::Options(error.to_string()))?;
    let trees = Trees::new(device()?, structure, options).map_err(unavailable)?;
    Ok(Box::new(trees))
}

/// The device, or why there is none. A lost device is opened again.
fn device() -> Result<Arc<Gpu>, StartError> {
    let mut opened = DEVICE.lock().unwrap_or_else(PoisonError::into_inner);
    if opened
        .as_ref()
        .is_some_and(|known| matches!(known, Ok(gpu) if gpu.is_lost()))
    {
        *opened = None;
    }
    let opened = opened.get_or_insert_with(Gpu::new).as_ref();
    opened.map(Arc::clone).map_err(unavailable)
}

fn unavailable(error: impl std::fmt::Display) -> StartError {
    StartError::Unavailable(error.to_string())
}
