//! The dispatches of a frame, with what each of them binds: made once for as long as the buffers are the same.

use guideway_render::Stage;
use guideway_scene::Scene;

use super::canvas::Canvas;
use super::kernels::{Kernels, Painters};
use super::params::{FrameParams, Samples, WORKGROUP};
use super::room::Room;
use super::store::Store;
use crate::device::{Bindings, DeviceBuffer, Dispatch, Gpu, Kernel, Runner};

/// Most workgroups of a kernel that goes round until nothing is left.
const MOST_ROUNDS_GROUPS: u32 = 1 << 14;

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
pub(super) struct Buffers<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) kernels: &'a Kernels,
    pub(super) store: &'a Store,
    pub(super) room: &'a Room,
    pub(super) canvas: &'a Canvas,
}

/// What each stage binds.
pub(super) struct Bound {
    paint: Paint,
    samples: Samples,
    cull: Bindings,
    /// One a chunk of the scene.
    flatten: Vec<Bindings>,
    starts: Bindings,
    list: Bindings,
    /// None where order does not matter.
    sort: Option<Bindings>,
    cover: Bindings,
}

impl Bound {
    pub(super) fn new(b: &Buffers<'_>, paint: Paint, samples: Samples) -> Result<Self, String> {
        let (kernels, store, room, canvas) = (b.kernels, b.store, b.room, b.canvas);
        let bind = |kernel: &Kernel, buffers: &[&DeviceBuffer]| kernel.bind(b.gpu, buffers);
        let (frame, found) = (&canvas.frame, &store.found);
        let (lines_px, ranks) = (&room.lines_px, &room.line_ranks);
        let flatten = store.chunks.iter().map(|chunk| {
            let scene = [
                &chunk.params,
                &chunk.points_m,
                &store.strokes,
                &store.clusters,
            ];
            let [params, points_m, strokes, clusters] = scene;
            let all = [
                frame,
                params,
                points_m,
                strokes,
                clusters,
                &store.styles,
                found,
                lines_px,
                ranks,
                &canvas.counts,
            ];
            bind(&kernels.flatten, &all)
        });
        let sorted = [frame, &canvas.starts, &room.reference_list, ranks];
        let sort = (paint != Paint::One).then(|| bind(&kernels.sort, &sorted));
        Ok(Self {
            paint,
            samples,
            cull: bind(&kernels.cull, &[frame, &store.clusters, found])?,
            flatten: flatten.collect::<Result<_, _>>()?,
            starts: bind(
                &kernels.starts,
                &[frame, &canvas.counts, &canvas.starts, &canvas.filled, found],
            )?,
            list: bind(
                &kernels.scatter,
                &[
                    frame,
                    found,
                    lines_px,
                    ranks,
                    &store.styles,
                    &canvas.filled,
                    &room.reference_list,
                ],
            )?,
            sort: sort.transpose()?,
            cover: bind(
                paint.kernel(kernels.painters(samples)),
                &[
                    frame,
                    &canvas.starts,
                    &room.reference_list,
                    lines_px,
                    ranks,
                    &store.styles,
                    &canvas.pixels,
                ],
            )?,
        })
    }

    pub(super) fn is_for(&self, paint: Paint, samples: Samples) -> bool {
        (self.paint, self.samples) == (paint, samples)
    }

    /// Runs all stages one after the other.
    pub(super) fn run(
        &self,
        b: &Buffers<'_>,
        params: &FrameParams,
        runner: &Runner,
    ) -> Result<Vec<Stage>, String> {
        let kernels = b.kernels;
        let rounds = |items: u32| items.clamp(1, MOST_ROUNDS_GROUPS.min(b.gpu.most_workgroups()));
        let tiles = params.columns * params.rows;
        let dispatch = |kernel, bindings, workgroups| Dispatch {
            kernel,
            bindings,
            workgroups,
        };
        let clusters = params.clusters.div_ceil(WORKGROUP);
        let cull = [dispatch(&kernels.cull, &self.cull, clusters)];
        let flatten: Vec<_> = self
            .flatten
            .iter()
            .map(|bindings| dispatch(&kernels.flatten, bindings, rounds(params.clusters)))
            .collect();
        let starts = [dispatch(&kernels.starts, &self.starts, 1)];
        let listed = rounds(b.room.size.lines.div_ceil(WORKGROUP));
        let list = [dispatch(&kernels.scatter, &self.list, listed)];
        let sorted = self.sort.as_ref();
        let sort = sorted.map(|bindings| [dispatch(&kernels.sort, bindings, tiles)]);
        let painter = self.paint.kernel(kernels.painters(self.samples));
        let cover = [dispatch(painter, &self.cover, tiles)];
        let mut stages: Vec<(&'static str, &[Dispatch<'_>])> = vec![
            ("cull", &cull),
            ("flatten", &flatten),
            ("starts", &starts),
            ("list", &list),
        ];
        if let Some(sort) = &sort {
            stages.push(("sort", sort));
        }
        stages.push(("cover", &cover));
        runner.run_stages("the frame", &[&b.store.found, &b.canvas.counts], &stages)
    }
}
