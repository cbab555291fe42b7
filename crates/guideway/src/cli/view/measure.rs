//! `guideway view --measure`: frame times of the window under scripted movements.

use std::path::PathBuf;
use std::sync::Arc;

use guideway::layout::UserError;
use guideway_bench::{Machine, Summary};
use guideway_viewer::Movement;
use serde_json::{Value, json};

use super::services::CliServices;
use crate::cli::error::{Exit, usage_error};
use crate::cli::output::Output;
use crate::cli::text;

pub(super) fn measure(
    files: &[PathBuf],
    method: Option<String>,
    out: &Output,
) -> Result<Exit, UserError> {
    let [file] = files else {
        return Err(usage_error(
            "--measure takes exactly one file",
            "Name one, such as `guideway view site.arrow --measure`",
        ));
    };
    let services = Arc::new(CliServices::for_measurement());
    let progress = out.progress("measuring frame times");
    let movements = guideway_viewer::measure(services, file.clone(), method)?;
    drop(progress);
    let body = json!({
        "file": file.to_string_lossy(),
        "machine": Machine::here(),
        "movements": movements.iter().map(movement_json).collect::<Vec<Value>>(),
    });
    out.report("view", &body, || table(&movements))?;
    Ok(Exit::Clean)
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
            text::time(frames.median),
            text::time(frames.p95),
            text::time(frames.max)
        );
        let drawn = format!("{}, {}", pictures.count, text::time(pictures.median));
        let [shown, settled] = [movement.shown_ms, movement.settled_ms].map(text::time);
        table += &format!(
            "{:<18} {frame:>30} {:>10}   {drawn:>22}   {shown:>10} {settled:>10}\n",
            movement.name, movement.presented
        );
    }
    table
}
