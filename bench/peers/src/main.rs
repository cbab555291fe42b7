//! `peers METHOD d1|d2 PATHS [PNG]` strokes a generated layout with one renderer and prints a line of JSON.
//! `peers compare d1|d2 PATHS` runs all, each in a process of its own, and prints the ratios. `peers errors d1|d2 PATHS`
//! compares the picture of each with that of `oracle`. `peers growth SVG` plots the times of a frame against the number of
//! paths.
//!
//! All draw every path 3 pixels wide with round caps and joins, black on white, all in view at 1920 x
//! 1080. A frame's time starts from the layout in memory: what a renderer makes of it first counts too, but for those
//! that Python drives.

mod data;
mod draw;
mod growth;
mod memory;

use std::process::Command;
use std::{env, fs};

use anyhow::{Result, bail, ensure};
use guideway_bench::Summary;
use guideway_layout::Layout;
use guideway_scene::{Frame, FrameSize, View};
use serde_json::{Value, json};

fn main() -> Result<()> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let is_method = |name: &str| draw::METHODS.iter().any(|(method, _)| *method == name);
    match arguments[..] {
        ["compare", set, paths] => println!("{}", compare(set, paths)?),
        ["errors", set, paths] => errors(set, paths)?,
        ["growth", svg] => growth::run(svg)?,
        [method, set, paths] if is_method(method) => {
            println!("{}", measure(method, set, paths, None)?);
        }
        [method, set, paths, png] if is_method(method) => {
            println!("{}", measure(method, set, paths, Some(png))?);
        }
        _ => {
            let methods: Vec<_> = draw::METHODS.iter().map(|(method, _)| *method).collect();
            bail!(
                "usage: peers {} d1|d2 PATHS [PNG] | peers compare|errors d1|d2 PATHS | peers growth SVG",
                methods.join("|")
            )
        }
    }
    Ok(())
}

fn compare(set: &str, paths: &str) -> Result<Value> {
    let mut all = Vec::new();
    for (method, _) in draw::METHODS {
        all.push((method, in_own_process(method, set, paths)?));
    }
    let ours = all[0].1.clone();
    let ratios = all[1..].iter().map(|(method, theirs)| {
        let ratio = |of: &str| Some(theirs[of].as_f64()? / ours[of].as_f64()?);
        json!({
            "method": method,
            "first_frame": ratio("first_frame_ms"),
            "frame": ratio("frame_ms"),
            "memory": ratio("drawing_rss_bytes"),
        })
    });
    Ok(json!({ "times_cpu": ratios.collect::<Value>() }))
}

fn in_own_process(method: &str, set: &str, paths: &str) -> Result<Value> {
    let output = Command::new(env::current_exe()?)
        .args([method, set, paths])
        .output()?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{method}: {errors}");
    let line = String::from_utf8(output.stdout)?;
    print!("{line}");
    Ok(serde_json::from_str(&line)?)
}

fn measure(method: &str, set: &str, paths: &str, png: Option<&str>) -> Result<Value> {
    let layout = data::layout(set, paths.parse()?)?;
    memory::forget_peak()?;
    let layout_rss_bytes = memory::held_bytes()?;
    let (view, mut frame) = view(&layout)?;
    let times_ms = draw::draw(method, &layout, &view, &mut frame)?;
    let drawing_rss_bytes = memory::peak_bytes()?;
    if let Some(path) = png {
        write_png(&frame, path)?;
    }
    Ok(json!({
        "method": method,
        "paths": layout.paths.len(),
        "first_frame_ms": times_ms[0],
        "frame_ms": further_ms(&times_ms),
        "layout_rss_bytes": layout_rss_bytes,
        "drawing_rss_bytes": (!draw::is_elsewhere(method)).then_some(drawing_rss_bytes),
    }))
}

/// The median of all frames but the first, in milliseconds.
fn further_ms(times_ms: &[f64]) -> f64 {
    Summary::of(&times_ms[1..]).map_or(f64::NAN, |times| times.median)
}

fn errors(set: &str, paths: &str) -> Result<()> {
    let layout = data::layout(set, paths.parse()?)?;
    let (view, mut exact) = view(&layout)?;
    draw::oracle(&layout, &view, &mut exact)?;
    for (method, _) in draw::METHODS {
        let (_, mut frame) = self::view(&layout)?;
        draw::draw(method, &layout, &view, &mut frame)?;
        let pairs = frame.bytes().iter().zip(exact.bytes());
        let levels: Vec<u8> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
        let (pixels, _) = levels.as_chunks::<4>();
        let worst = |pixel: &[u8; 4]| pixel.iter().copied().max().unwrap_or(0);
        let beyond = |level: u8| pixels.iter().filter(|p| worst(p) > level).count();
        // Opacity is the same everywhere: three channels count.
        let sum: u64 = levels.iter().map(|&level| u64::from(level)).sum();
        println!(
            "{}",
            json!({
                "method": method,
                "paths": layout.paths.len(),
                "mean_levels": sum as f64 / (3 * pixels.len()) as f64,
                "share_beyond_8": beyond(8) as f64 / pixels.len() as f64,
                "share_beyond_32": beyond(32) as f64 / pixels.len() as f64,
                "most_levels": levels.iter().max(),
            })
        );
    }
    Ok(())
}

/// All of a layout, and a picture of it to be drawn.
fn view(layout: &Layout) -> Result<(View, Frame)> {
    let size = FrameSize::new(1920, 1080)?;
    let view = View::fit(size, layout.paths.hull_bounds())?;
    Ok((view, Frame::new(size)))
}

fn write_png(frame: &Frame, path: &str) -> Result<()> {
    let (width, height) = (frame.size().width(), frame.size().height());
    let mut encoder = png::Encoder::new(fs::File::create(path)?, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(frame.bytes())?;
    Ok(())
}
