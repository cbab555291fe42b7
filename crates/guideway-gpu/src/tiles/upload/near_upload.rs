//! Uploads exact points of near clusters into the cache of exact points.

use std::collections::HashMap;

use guideway_scene::RenderError;

use super::cluster::ClusterOrigin;
use super::exact_points::EXACT_POINTS;
use super::path_parts::PathPart;
use super::path_strokes::PathStrokes;
use super::scene_buffers::SceneBuffers;
use super::uploaded_scene::UploadedScene;
use crate::tiles::device_context::{DeviceContext, device_error};

/// Uploads the exact points of clusters. The cache must have room for them.
pub(crate) fn upload_exact(
    scene: &mut UploadedScene,
    device: &DeviceContext,
    clusters: &[u32],
) -> Result<(), RenderError> {
    let Some(buffers) = &mut scene.buffers else {
        return Ok(());
    };
    // After an error the cache stays dropped.
    let Some(mut exact) = buffers.exact_points.take() else {
        return Ok(());
    };
    if !scene.multi_stroke_paths.is_empty() {
        let rows = scene.scene.row_count();
        scene
            .path_strokes
            .get_or_insert_with(|| PathStrokes::of(buffers, rows));
    }
    let first = exact.buffer.used_points;
    let mut points_m = Vec::new();
    let mut parts_of_paths = HashMap::new();
    for &cluster in clusters {
        exact.first_points[cluster as usize] = first + points_m.len() as u32;
        append_cluster(scene, cluster, &mut parts_of_paths, &mut points_m);
    }
    exact.buffer.used_points += points_m.len() as u32;
    let buffer = &exact.buffer.points;
    let runner = &device.runner;
    let written = runner
        .write_at(EXACT_POINTS, buffer, first, &points_m)
        .and_then(|()| runner.write_at(EXACT_POINTS, buffer, 0, &exact.first_points));
    written.map_err(device_error)?;
    if let Some(buffers) = &mut scene.buffers {
        buffers.exact_points = Some(exact);
    }
    Ok(())
}

/// Appends the points of a cluster. Hidden strokes get arbitrary points.
fn append_cluster(
    scene: &UploadedScene,
    cluster: u32,
    parts_of_paths: &mut HashMap<u32, Vec<PathPart>>,
    points_m: &mut Vec<[f32; 2]>,
) {
    let Some(buffers) = &scene.buffers else {
        return;
    };
    let index = cluster as usize;
    let mapped = scene.gesture.as_ref();
    let at_rest = mapped.and_then(|gesture| gesture.at_rest(index));
    let cluster = at_rest.unwrap_or(&buffers.cluster_list[index]);
    let origin = ClusterOrigin::of(cluster);
    let first = points_m.len();
    points_m.resize(first + cluster.points as usize, [0.0; 2]);
    for index in cluster.first_stroke..cluster.first_stroke + cluster.strokes {
        let stroke = buffers.stroke_list[index as usize];
        if stroke.is_drawn()
            && let Some(part) = part_of(scene, buffers, index, parts_of_paths)
        {
            let slots = points_m[first + stroke.first_point() as usize..].iter_mut();
            for (slot, p) in slots.zip(part.points(scene.scene.layout())) {
                *slot = origin.local_m(p);
            }
        }
    }
}

/// The part of its path that a stroke holds.
fn part_of(
    scene: &UploadedScene,
    buffers: &SceneBuffers,
    index: u32,
    parts_of_paths: &mut HashMap<u32, Vec<PathPart>>,
) -> Option<PathPart> {
    let layout = scene.scene.layout();
    let stroke = buffers.stroke_list[index as usize];
    let row = buffers.ranks.row(stroke.rank);
    let parts = || {
        let mut parts = Vec::new();
        PathPart::of_path(layout, row, stroke.rank, &mut parts);
        scene.packing.sort(layout, &mut parts);
        parts
    };
    if stroke.is_whole_path() {
        return parts().pop();
    }
    let strokes = scene.path_strokes.as_ref()?.strokes(row);
    let number = strokes.iter().position(|stroke| *stroke == index)?;
    let parts = parts_of_paths.entry(row).or_insert_with(parts);
    parts.get(number).copied()
}
