//! `guideway view --measure`: frame times of the window under scripted movements.

use std::sync::Arc;

use guideway::cli::window::{Measured, Request, shown_time};
use guideway::layout::UserError;
use guideway_bench::{Machine, Summary};
use guideway_viewer::Movement;
use serde_json::{Value, json};

use crate::services::FileServices;

pub(crate) fn measure(request: Request) -> Result<Measured, UserError> {
    let services = Arc::new(FileServices::for_measurement());
    let file = request.files.into_iter().next().unwrap_or_default();
    let movements = guideway_viewer::measure(services, file.clone(), request.method)?;
    Ok(Measured {
        json: json!({
            "file": file.to_string_lossy(),
            "machine": Machine::here(),
            "movements": movements.iter().map(movement_json).collect::<Vec<Value>>(),
        }),
        table: table(&movements),
    })
}

fn movement_json(movement: &Movement) -> Value {
    json!({
        "name": movement.name,
        "frames_ms": movement.frames_ms,
        "frames_presented": movement.presented,
        "pictures_ms": movement.pictures_ms,
        "shown_ms": movement.shown_ms,
        "settled_ms": movement.settled_ms,
    })
}

fn table(movements: &[Movement]) -> String {
    let mut table = format!(
        "{:<18} {:>30} {:>10}   {:>22}   {:>10} {:>10}\n",
        "",
        "frame: median, 95 %, longest",
        "presented",
        "pictures: count, median",
        "shown in",
        "settled in"
    );
    for movement in movements {
        let frames = Summary::of(&movement.frames_ms).unwrap_or_default();
        let pictures = Summary::of(&movement.pictures_ms).unwrap_or_default();
        let frame = format!(
            "{}, {}, {}",
            shown_time(frames.median),
            shown_time(frames.p95),
            shown_time(frames.max)
        );
        let drawn = format!("{}, {}", pictures.count, shown_time(pictures.median));
        let [shown, settled] = [movement.shown_ms, movement.settled_ms].map(shown_time);
        table += &format!(
            "{:<18} {frame:>30} {:>10}   {drawn:>22}   {shown:>10} {settled:>10}\n",
            movement.name, movement.presented
        );
    }
    table
}
