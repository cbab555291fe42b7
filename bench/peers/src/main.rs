//! `peers METHOD FILE [PNG]` strokes a layout with one renderer and prints a line of JSON. `peers compare
//! FILE` runs all, each in a process of its own, and prints the ratios.
//!
//! All draw every path 3 pixels wide with round caps and joins, black on white, all in view at 1920 x
//! 1080. A frame's time starts from the layout in memory: what a renderer makes of it first counts too.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;
use std::{env, fs};

use anyhow::{Context, Result, bail, ensure};
use guideway_cpu::Cpu;
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Layout, PathRef};
use guideway_render::{Budget, Cancel, Frame, FrameSize, Method, Style, View, elapsed_ms};
use guideway_scene::{LineRule, Scene, SceneOptions};
use guideway_spline::uniform;
use serde_json::{Value, json};

/// Ours, and tiny-skia with paths made for each frame or kept from the first.
const METHODS: [&str; 3] = ["cpu", "tiny-skia", "tiny-skia-kept"];
const WIDTH_PX: f64 = 3.0;
/// Of so many frames, the fastest counts.
const FRAMES: usize = 3;

fn main() -> Result<()> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let line = match arguments[..] {
        ["compare", file] => compare(file)?,
        [method, file] if METHODS.contains(&method) => measure(method, file, None)?,
        [method, file, png] if METHODS.contains(&method) => measure(method, file, Some(png))?,
        _ => bail!(
            "usage: peers {} FILE [PNG] | peers compare FILE",
            METHODS.join("|")
        ),
    };
    println!("{line}");
    Ok(())
}

fn compare(file: &str) -> Result<Value> {
    let mut all = Vec::new();
    for method in METHODS {
        all.push((method, in_own_process(method, file)?));
    }
    let ours = all[0].1.clone();
    let ratios = all[1..].iter().map(|(method, theirs)| {
        let ratio = |of: &str| Some(theirs[of].as_f64()? / ours[of].as_f64()?);
        json!({
            "method": method,
            "first_frame": ratio("first_frame_ms"),
            "frame": ratio("frame_ms"),
            "memory_from_file_to_picture": ratio("whole_rss_bytes"),
            "memory_of_drawing": ratio("drawing_rss_bytes"),
        })
    });
    Ok(json!({ "times_cpu": ratios.collect::<Value>() }))
}

fn in_own_process(method: &str, file: &str) -> Result<Value> {
    let output = Command::new(env::current_exe()?)
        .args([method, file])
        .output()?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{method}: {errors}");
    let line = String::from_utf8(output.stdout)?;
    print!("{line}");
    Ok(serde_json::from_str(&line)?)
}

fn measure(method: &str, file: &str, png: Option<&str>) -> Result<Value> {
    let layout = Arc::new(read_file(Path::new(file), &ReadOptions::default())?);
    let loading_rss_bytes = status_bytes("VmHWM")?;
    forget_peak_rss()?;
    let loaded_rss_bytes = status_bytes("VmRSS")?;
    let size = FrameSize::new(1920, 1080)?;
    let view = View::fit(size, layout.paths.hull_bounds())?;
    let mut frame = Frame::new(size);
    let times_ms = match method {
        "cpu" => draw_ours(&layout, &view, &mut frame)?,
        _ => draw_tiny_skia(&layout, &view, method == "tiny-skia-kept", &mut frame)?,
    };
    let drawing_rss_bytes = status_bytes("VmHWM")?;
    if let Some(path) = png {
        write_png(&frame, path)?;
    }
    Ok(json!({
        "method": method,
        "paths": layout.paths.len(),
        "first_frame_ms": times_ms[0],
        "frame_ms": times_ms.iter().copied().fold(f64::INFINITY, f64::min),
        "whole_rss_bytes": loading_rss_bytes.max(drawing_rss_bytes),
        "loaded_rss_bytes": loaded_rss_bytes,
        "drawing_rss_bytes": drawing_rss_bytes,
    }))
}

fn draw_ours(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    let style = Style {
        line_rule: LineRule::World {
            width_m: 0.0,
            min_px: WIDTH_PX,
            max_px: WIDTH_PX,
        },
        ..Style::default()
    };
    let start = Instant::now();
    let scene = Arc::new(Scene::new(Arc::clone(layout), &SceneOptions::default())?);
    let mut prepared = Cpu.prepare(scene, &Budget::default())?;
    let mut prepared_ms = elapsed_ms(start);
    let mut times_ms = Vec::new();
    for _ in 0..FRAMES {
        let start = Instant::now();
        let report = prepared.render(view, &style, &Cancel::default(), frame)?;
        times_ms.push(elapsed_ms(start) + prepared_ms);
        prepared_ms = 0.0;
        eprintln!(
            "{report}: {:.1?}, {} lines, {} bytes",
            report.stages, report.lines, report.peak_bytes
        );
    }
    Ok(times_ms)
}

/// A path at a time, in draw order, as a picture of many colours needs. It has no use for threads. Paths
/// are made for each frame and forgotten, or made once and kept, as a program would that draws again.
fn draw_tiny_skia(
    layout: &Layout,
    view: &View,
    is_kept: bool,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    use tiny_skia::{Color, LineCap, LineJoin, Paint, Pixmap, Stroke, Transform};

    let stroke = Stroke {
        width: WIDTH_PX as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    let paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    let mut pixmap = Pixmap::new(view.size().width(), view.size().height()).context("size")?;
    let outlines = || {
        let paths = layout.paths.iter();
        paths.filter_map(|path| tiny_skia_path(&path, view))
    };
    let mut kept = Vec::new();
    let mut times_ms = Vec::new();
    for frame in 0..FRAMES {
        let start = Instant::now();
        if is_kept && frame == 0 {
            kept.extend(outlines());
        }
        pixmap.fill(Color::WHITE);
        let mut draw = |path: &tiny_skia::Path| {
            pixmap.stroke_path(path, &paint, &stroke, Transform::identity(), None);
        };
        if is_kept {
            kept.iter().for_each(&mut draw);
        } else {
            outlines().for_each(|path| draw(&path));
        }
        times_ms.push(elapsed_ms(start));
    }
    let (pixels, _) = pixmap.data().as_chunks();
    frame.pixels_mut().copy_from_slice(pixels);
    Ok(times_ms)
}

fn tiny_skia_path(path: &PathRef<'_>, view: &View) -> Option<tiny_skia::Path> {
    let mut builder = tiny_skia::PathBuilder::new();
    for run in path.runs() {
        for (i, segment) in run.segments().enumerate() {
            let [a, b, c, d] =
                uniform::to_bezier(&segment).map(|p| view.pixel_from_world(p).to_f32());
            if i == 0 {
                builder.move_to(a.x, a.y);
            }
            builder.cubic_to(b.x, b.y, c.x, c.y, d.x, d.y);
        }
    }
    builder.finish()
}

/// Lets the system count the most memory held from now on.
fn forget_peak_rss() -> Result<()> {
    Ok(fs::write("/proc/self/clear_refs", "5")?)
}

/// A figure of this process: `VmHWM`, the most memory ever held, or `VmRSS`, what is held now.
fn status_bytes(figure: &str) -> Result<u64> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status
        .lines()
        .find_map(|l| l.strip_prefix(figure)?.strip_prefix(':'))
        .context("no such figure")?;
    let kib: u64 = line.trim().trim_end_matches("kB").trim().parse()?;
    Ok(kib * 1024)
}

fn write_png(frame: &Frame, path: &str) -> Result<()> {
    let (width, height) = (frame.size().width(), frame.size().height());
    let mut encoder = png::Encoder::new(fs::File::create(path)?, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(frame.bytes())?;
    Ok(())
}
