//! The dispatches of a frame, with what each of them binds.

use guideway_render::{RenderError, Stage};
use guideway_scene::Scene;
use wgpu::BufferUsages;

use super::canvas::Canvas;
use super::kernels::{Kernels, Painters};
use super::pack::Packed;
use super::params::{FrameParams, Samples, WORKGROUP};
use super::room::Room;
use crate::device::{Bindings, DeviceBuffer, Dispatch, Gpu, Kernel, Memory, Runner};

/// Most workgroups of a kernel that goes round until nothing is left.
const MOST_ROUNDS_GROUPS: u32 = 1 << 14;

/// The scene's buffers.
pub(super) struct Store {
    points_m: DeviceBuffer,
    strokes: DeviceBuffer,
    clusters: DeviceBuffer,
    seen: DeviceBuffer,
}

impl Store {
    /// Brings a scene to the device; none if there is nothing in it.
    pub(super) fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        packed: &Packed,
    ) -> Result<Option<Self>, RenderError> {
        if packed.strokes.is_empty() {
            return Ok(None);
        }
        let most = gpu.binding_bytes();
        let points_bytes = size_of_val(packed.points_m.as_slice()) as u64;
        let strokes_bytes = size_of_val(packed.strokes.as_slice()) as u64;
        if points_bytes.max(strokes_bytes) > most {
            return Err(RenderError::Unsupported {
                method: super::NAME,
                what: format!(
                    "control points of {points_bytes} bytes on a device that lets a shader see only {most} at \
                     once"
                ),
                remedy: "Draw fewer paths, or use `--method cpu`.".to_owned(),
            });
        }
        let seen_bytes = (packed.clusters.len() * size_of::<u32>()) as u64;
        Ok(Some(Self {
            points_m: memory.upload("the control points", &packed.points_m)?,
            strokes: memory.upload("the strokes", &packed.strokes)?,
            clusters: memory.upload("the clusters", &packed.clusters)?,
            seen: memory.zeros(
                "the list of clusters seen",
                seen_bytes,
                BufferUsages::STORAGE,
            )?,
        }))
    }
}

/// How the tiles are painted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    /// One opaque colour: no order is needed.
    One,
    Opaque,
    Translucent,
    Density,
}

impl Paint {
    /// What the colours of a scene make necessary.
    pub(super) fn of(scene: &Scene) -> Self {
        if !scene.is_opaque() {
            Self::Translucent
        } else if scene.common_color().is_some() {
            Self::One
        } else {
            Self::Opaque
        }
    }

    /// Times that a thread goes round its loops for each line of its tile: at most, with some to spare.
    pub(super) fn rounds_a_line(self) -> u32 {
        match self {
            Self::One => 10,
            Self::Opaque | Self::Translucent | Self::Density => 20,
        }
    }

    fn kernel(self, painters: &Painters) -> &Kernel {
        match self {
            Self::One => &painters.cover,
            Self::Opaque => &painters.opaque,
            Self::Translucent => &painters.translucent,
            Self::Density => &painters.density,
        }
    }
}

/// All buffers of a frame.
pub(super) struct Bound<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) kernels: &'a Kernels,
    pub(super) store: &'a Store,
    pub(super) room: &'a Room,
    pub(super) canvas: &'a Canvas,
    pub(super) found: &'a DeviceBuffer,
}

/// Stages with what they run.
pub(super) struct Passes<'a>(Vec<(&'static str, &'a Kernel, Bindings, u32)>);

impl<'a> Bound<'a> {
    pub(super) fn passes(
        &self,
        params: &FrameParams,
        paint: Paint,
        samples: Samples,
    ) -> Result<Passes<'a>, String> {
        let Self {
            gpu,
            kernels,
            store,
            room,
            canvas,
            found,
        } = *self;
        let Store {
            points_m,
            strokes,
            clusters,
            seen,
        } = store;
        let Room {
            lines_px,
            line_strokes,
            reference_list,
            ..
        } = room;
        let Canvas {
            frame,
            counts,
            starts,
            filled,
            pixels,
            ..
        } = canvas;
        let rounds = |items: u32| items.clamp(1, MOST_ROUNDS_GROUPS.min(gpu.most_workgroups()));
        let tiles = params.columns * params.rows;
        let mut passes = Vec::new();
        let mut add = |name, kernel: &'a Kernel, workgroups, buffers: &[&DeviceBuffer]| {
            passes.push((name, kernel, kernel.bind(gpu, buffers)?, workgroups));
            Ok::<(), String>(())
        };
        add(
            "cull",
            &kernels.cull,
            params.clusters.div_ceil(WORKGROUP),
            &[frame, clusters, found, seen],
        )?;
        add(
            "flatten",
            &kernels.flatten,
            rounds(params.clusters),
            &[
                frame,
                points_m,
                strokes,
                clusters,
                seen,
                found,
                lines_px,
                line_strokes,
                counts,
            ],
        )?;
        add(
            "starts",
            &kernels.starts,
            1,
            &[frame, counts, starts, filled, found],
        )?;
        add(
            "list",
            &kernels.scatter,
            rounds(room.size.lines.div_ceil(WORKGROUP)),
            &[
                frame,
                found,
                lines_px,
                line_strokes,
                strokes,
                filled,
                reference_list,
            ],
        )?;
        if paint != Paint::One {
            add(
                "sort",
                &kernels.sort,
                tiles,
                &[frame, starts, reference_list, line_strokes, strokes],
            )?;
        }
        add(
            "cover",
            paint.kernel(kernels.painters(samples)),
            tiles,
            &[
                frame,
                starts,
                reference_list,
                lines_px,
                line_strokes,
                strokes,
                pixels,
            ],
        )?;
        Ok(Passes(passes))
    }
}

impl Passes<'_> {
    /// Runs them one after the other.
    pub(super) fn run(
        &self,
        runner: &Runner,
        cleared: &[&DeviceBuffer],
    ) -> Result<Vec<Stage>, String> {
        let dispatches: Vec<_> = self
            .0
            .iter()
            .map(|(name, kernel, bindings, workgroups)| {
                let dispatch = Dispatch {
                    kernel,
                    bindings,
                    workgroups: *workgroups,
                };
                (*name, [dispatch])
            })
            .collect();
        let stages: Vec<_> = dispatches.iter().map(|(name, d)| (*name, &d[..])).collect();
        runner.run_stages("the frame", cleared, &stages)
    }
}
