//! `peers METHOD FILE [PNG]` strokes a layout with one renderer and prints a line of JSON: `cpu`, ours, or
//! `tiny-skia`. `peers compare FILE` runs both, each in a process of its own, and prints the ratio.
//!
//! Both draw every path 3 pixels wide with round caps and joins, black on white, all in view at 1920 x
//! 1080. A frame's time starts from the layout in memory: what a renderer makes of it first counts too.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;
use std::{env, fs};

use anyhow::{Context, Result, bail, ensure};
use guideway_cpu::Cpu;
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::Layout;
use guideway_render::{Budget, Cancel, Frame, FrameSize, Method, Style, View};
use guideway_scene::{LineRule, Scene, SceneOptions};
use guideway_spline::uniform;
use serde_json::{Value, json};

const WIDTH_PX: f64 = 3.0;
/// Of so many frames, the fastest counts.
const FRAMES: usize = 3;

fn main() -> Result<()> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let line = match arguments[..] {
        ["compare", file] => compare(file)?,
        [method @ ("cpu" | "tiny-skia"), file] => measure(method, file, None)?,
        [method @ ("cpu" | "tiny-skia"), file, png] => measure(method, file, Some(png))?,
        _ => bail!("usage: peers cpu|tiny-skia FILE [PNG] | peers compare FILE"),
    };
    println!("{line}");
    Ok(())
}

fn compare(file: &str) -> Result<Value> {
    let ours = in_own_process("cpu", file)?;
    let theirs = in_own_process("tiny-skia", file)?;
    let ratio = |of: &str| Some(theirs[of].as_f64()? / ours[of].as_f64()?);
    Ok(json!({
        "faster_first_frame": ratio("first_frame_ms"),
        "faster": ratio("frame_ms"),
        "smaller": ratio("peak_rss_bytes"),
    }))
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
    let loaded_rss_bytes = peak_rss_bytes()?;
    let size = FrameSize::new(1920, 1080)?;
    let view = View::fit(size, layout.paths.hull_bounds())?;
    let mut frame = Frame::new(size);
    let times_ms = match method {
        "cpu" => draw_ours(&layout, &view, &mut frame)?,
        _ => draw_tiny_skia(&layout, &view, &mut frame)?,
    };
    if let Some(path) = png {
        write_png(&frame, path)?;
    }
    Ok(json!({
        "method": method,
        "paths": layout.paths.len(),
        "first_frame_ms": times_ms[0],
        "frame_ms": times_ms.iter().copied().fold(f64::INFINITY, f64::min),
        "loaded_rss_bytes": loaded_rss_bytes,
        "peak_rss_bytes": peak_rss_bytes()?,
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

/// A path at a time, in draw order, as a picture of many colours needs. It has no use for threads.
fn draw_tiny_skia(layout: &Layout, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    use tiny_skia::{Color, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};

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
    let mut times_ms = Vec::new();
    for _ in 0..FRAMES {
        let start = Instant::now();
        pixmap.fill(Color::WHITE);
        for path in layout.paths.iter() {
            let mut builder = PathBuilder::new();
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
            if let Some(path) = builder.finish() {
                pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
            }
        }
        times_ms.push(elapsed_ms(start));
    }
    let (pixels, _) = pixmap.data().as_chunks();
    frame.pixels_mut().copy_from_slice(pixels);
    Ok(times_ms)
}

fn elapsed_ms(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

/// Most memory that this process ever held, as the system counts it.
fn peak_rss_bytes() -> Result<u64> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status
        .lines()
        .find_map(|l| l.strip_prefix("VmHWM:"))
        .context("no VmHWM")?;
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
