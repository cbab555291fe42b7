//! The report of `bench` as a table.

use guideway_bench::{
    Comparison, Contestant, Measured, Motion, Outcome, StageTime, StylePreset, Way,
};

use crate::cli::text;

const HEAD: [&str; 9] = [
    "frame",
    "5 to 95 %",
    "ratio",
    "first",
    "prepare",
    "wall",
    "on device",
    "memory",
    "tests/px",
];

/// The comparison as a table.
pub(super) fn text(comparison: &Comparison) -> String {
    let rows: Vec<(&Contestant, Vec<String>)> =
        comparison.methods.iter().map(|c| (c, cells(c))).collect();
    let name_width = rows.iter().map(|(c, _)| c.row.method.len()).max();
    let name_width = name_width.unwrap_or(0).max("method".len());
    let mut widths = HEAD.map(str::len);
    for (_, cells) in &rows {
        for (width, cell) in widths.iter_mut().zip(cells) {
            *width = cell.chars().count().max(*width);
        }
    }
    let line = |name: &str, cells: &[String]| {
        let cells = cells.iter().zip(widths);
        let cells: String = cells.map(|(c, w)| format!("  {c:>w$}")).collect();
        format!("{name:<name_width$}{cells}\n")
    };
    let mut text = heading(comparison);
    text += &line("method", &HEAD.map(str::to_owned));
    for (contestant, cells) in &rows {
        text += &line(&contestant.row.method, cells);
        if let Outcome::NotMeasured(why_not) = &contestant.row.outcome {
            text += &format!("  not measured: {why_not}\n");
        }
    }
    for (contestant, _) in &rows {
        text += &details(contestant);
    }
    text
}

/// The dataset, the view and the motion, in two lines.
fn heading(comparison: &Comparison) -> String {
    let [width, height] = comparison.view.size_px;
    let motion = match comparison.motion {
        Motion::Still => "nothing moves".to_owned(),
        Motion::Pan => "the view pans".to_owned(),
        Motion::Zoom => "the view zooms".to_owned(),
        Motion::Edit => {
            let moved = comparison.edit_paths.unwrap_or(0) as u64;
            let ways = match comparison.edit_way {
                Some(Way::Apart) => "moved each frame, each its own way",
                Some(Way::Drop) => "moved each frame by one edit",
                Some(Way::Gesture) | None => "moved each frame",
                Some(Way::Remove) => "removed by each frame or restored",
                Some(Way::Restyle) => "restyled by each frame",
                Some(Way::Recolor) => "in other colors each frame",
            };
            format!("{} {ways}", text::counted(moved, "path"))
        }
    };
    let style = match comparison.style_preset {
        StylePreset::Own => "",
        StylePreset::Mixed => ", in many colors",
        StylePreset::Translucent => ", in many colors, half of them translucent",
    };
    let shade = if comparison.is_density {
        ", shaded by density"
    } else {
        ""
    };
    format!(
        "{}: {}, {}{style}{shade}; {width} x {height} pixels at {:.4} pixels per meter, {motion}\n\
         {} per method after {} of warm-up, interleaved; times are medians, ratios are relative to \
         the first method\n\n",
        text::single_line(&comparison.scene.name, 200),
        text::counted(comparison.scene.paths as u64, "path"),
        text::counted(comparison.scene.segments as u64, "segment"),
        comparison.view.px_per_m,
        text::counted(comparison.frames as u64, "frame"),
        comparison.warmup,
    )
}

/// The cells under [`HEAD`]; empty for a method that was not measured.
fn cells(contestant: &Contestant) -> Vec<String> {
    let Some(m) = contestant.row.measured() else {
        return Vec::new();
    };
    vec![
        text::time(m.frame_ms.median),
        format!(
            "{} - {}",
            text::time(m.frame_ms.p5),
            text::time(m.frame_ms.p95)
        ),
        contestant
            .ratio
            .map_or_else(String::new, |r| format!("{r:.2}")),
        text::time(m.first_frame.ms),
        text::time(m.prepare.ms),
        text::time(m.wall_ms.median),
        m.device_wall_ms
            .map_or_else(|| "-".to_owned(), |wall| text::time(wall.median)),
        text::bytes(m.peak_bytes),
        m.work
            .tests_a_pixel
            .map_or_else(|| "-".to_owned(), |t| format!("{t:.1}")),
    ]
}

fn details(contestant: &Contestant) -> String {
    let Some(m) = contestant.row.measured() else {
        return String::new();
    };
    let device = contestant.device.as_deref().unwrap_or("");
    let mut text = format!("\n{} on {device}\n", contestant.row.method);
    text += &stages("preparing", &m.prepare.stages);
    text += &update(m);
    text += &stages("drawing", &m.stages);
    text += &counts(m);
    for note in &m.notes {
        text += &format!("  note: {note}\n");
    }
    text
}

fn update(m: &Measured) -> String {
    let (Some(each), Some(first_ms)) = (m.update_ms, m.first_frame.update_ms) else {
        return String::new();
    };
    let is_gesture = m.update_is_gesture == Some(true);
    let how = match m.update_bytes {
        None => "prepared again".to_owned(),
        Some(0) if is_gesture => "a gesture".to_owned(),
        Some(bytes) if is_gesture => {
            format!("a gesture, {} uploaded to the device", text::bytes(bytes))
        }
        Some(0) => "in place".to_owned(),
        Some(bytes) => format!("in place, {} uploaded to the device", text::bytes(bytes)),
    };
    format!(
        "  changed scene: {} of each frame, {} of the first; {how}\n",
        text::time(each.median),
        text::time(first_ms)
    )
}

fn stages(label: &str, stages: &[StageTime]) -> String {
    if stages.is_empty() {
        return String::new();
    }
    let one = |stage: &StageTime| format!("{} {}", stage.name, text::time(stage.ms));
    let clock = match stages.iter().all(|stage| stage.clock == "device") {
        true => " by the clock of the device",
        false => "",
    };
    let all: Vec<String> = stages.iter().map(one).collect();
    format!("  {label}: {}{clock}\n", all.join(", "))
}

fn counts(m: &Measured) -> String {
    let drawn = text::count(m.paths.drawn);
    let mut text = format!(
        "  {drawn} of {} drawn as {}; {} held\n",
        text::counted(m.paths.total, "path"),
        text::counted(m.lines, "line"),
        text::bytes(m.held_bytes),
    );
    let work = [
        (m.work.tests.map(text::count), "tests"),
        (m.work.atomics.map(text::count), "atomics"),
        (m.work.bytes_read.map(text::bytes), "read"),
        (m.work.bytes_written.map(text::bytes), "written"),
    ];
    let known: Vec<String> = work
        .into_iter()
        .filter_map(|(count, unit)| Some(format!("{} {unit}", count?)))
        .collect();
    if !known.is_empty() {
        text += &format!("  work per frame: {}\n", known.join(", "));
    }
    text
}
