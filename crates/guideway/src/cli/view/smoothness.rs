//! `guideway view --measure`: how long the frames of the viewer take.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_bench::{Machine, Summary};
use guideway_viewer::Movement;
use serde_json::{Value, json};

use super::Desk;
use crate::cli::{Exit, Failure, Output, text};

pub(super) fn measure(
    files: &[PathBuf],
    method: Option<String>,
    out: &Output,
) -> Result<Exit, Failure> {
    let [file] = files else {
        return Err(Failure::arguments(
            "--measure takes one file",
            "Name one, such as `guideway view site.arrow --measure`",
        ));
    };
    let desk = Desk {
        is_measuring: true,
        ..Desk::default()
    };
    let activity = out.activity("moving the file about");
    let movements = guideway_viewer::measure(Arc::new(desk), file.clone(), method)?;
    drop(activity);
    let body = json!({
        "file": file.to_string_lossy(),
        "machine": Machine::here(),
        "movements": movements.iter().map(movement).collect::<Vec<Value>>(),
    });
    out.report("view", &body, || table(&movements))?;
    Ok(Exit::Clean)
}

fn movement(movement: &Movement) -> Value {
    json!({
        "name": movement.name,
        "frames_ms": movement.frames_ms,
        "pictures_ms": movement.pictures_ms,
        "shown_ms": movement.shown_ms,
        "settled_ms": movement.settled_ms,
    })
}

fn table(movements: &[Movement]) -> String {
    let mut table = format!(
        "{:<18} {:>30}   {:>22}   {:>10} {:>10}\n",
        "", "frame: median, 95 %, longest", "pictures: count, median", "shown in", "settled in"
    );
    for movement in movements {
        let frames = Summary::of(&movement.frames_ms).unwrap_or_default();
        let pictures = Summary::of(&movement.pictures_ms).unwrap_or_default();
        let frame = format!(
            "{}, {}, {}",
            text::time(frames.median),
            text::time(frames.p95),
            text::time(frames.max)
        );
        let drawn = format!("{}, {}", pictures.count, text::time(pictures.median));
        let [shown, settled] = [movement.shown_ms, movement.settled_ms].map(text::time);
        table += &format!(
            "{:<18} {frame:>30}   {drawn:>22}   {shown:>10} {settled:>10}\n",
            movement.name
        );
    }
    table
}
