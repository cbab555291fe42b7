//! Benchmark of Guideway against other renderers on the same curves.
//!
//! - `peers METHOD d1|d2 PATHS [PNG]` strokes a generated layout with one renderer and prints one
//!   line of JSON.
//! - `peers compare d1|d2 PATHS` runs all renderers, each in a separate process, and prints ratios.
//! - `peers errors d1|d2 PATHS` compares the picture of each renderer with that of `oracle`.
//! - `peers growth SVG` plots frame times against the number of paths.
//!
//! All renderers stroke every path 3 pixels wide with round caps and joins, black on white, with
//! the whole layout in view at 1920 x 1080. Frame times start from the layout in memory and include
//! the conversion to the paths of the renderer, except for renderers that Python drives.

mod data;
mod draw;
mod growth;
mod memory;
mod times;

use std::process::Command;
use std::{env, fs};

use anyhow::{Result, bail, ensure};
use guideway_scene::Frame;
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
                "usage: peers {} d1|d2 PATHS [PNG] | peers compare|errors d1|d2 PATHS | \
                 peers growth SVG",
                methods.join("|")
            )
        }
    }
    Ok(())
}

/// Measures all renderers and returns the ratios of each to Guideway.
fn compare(set: &str, paths: &str) -> Result<Value> {
    let mut all = Vec::new();
    for (method, _) in draw::METHODS {
        all.push((method, measure_in_process(method, set, paths)?));
    }
    let guideway = all[0].1.clone();
    let ratios = all[1..].iter().map(|(method, peer)| {
        let ratio = |key: &str| Some(peer[key].as_f64()? / guideway[key].as_f64()?);
        json!({
            "method": method,
            "first_frame": ratio("first_frame_ms"),
            "frame": ratio("frame_ms"),
            "memory": ratio("drawing_rss_bytes"),
        })
    });
    Ok(json!({ "times_cpu": ratios.collect::<Value>() }))
}

/// Runs [`measure`] in a separate process, whose peak memory belongs to one renderer.
fn measure_in_process(method: &str, set: &str, paths: &str) -> Result<Value> {
    let output = Command::new(env::current_exe()?)
        .args([method, set, paths])
        .output()?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{method}: {errors}");
    let line = String::from_utf8(output.stdout)?;
    print!("{line}");
    Ok(serde_json::from_str(&line)?)
}

/// Times and memory of one renderer.
fn measure(method: &str, set: &str, paths: &str, png: Option<&str>) -> Result<Value> {
    let layout = data::layout(set, paths.parse()?)?;
    memory::reset_peak()?;
    let layout_rss_bytes = memory::resident_bytes()?;
    let (view, mut frame) = data::view(&layout)?;
    let times_ms = draw::draw(method, &layout, &view, &mut frame)?;
    let drawing_rss_bytes = memory::peak_bytes()?;
    if let Some(path) = png {
        write_png(&frame, path)?;
    }
    Ok(json!({
        "method": method,
        "paths": layout.paths.len(),
        "first_frame_ms": times_ms[0],
        "frame_ms": times::median_after_first_ms(&times_ms),
        "layout_rss_bytes": layout_rss_bytes,
        "drawing_rss_bytes": (!draw::is_external(method)).then_some(drawing_rss_bytes),
    }))
}

/// Prints the errors of the picture of each renderer against the one of `oracle`.
fn errors(set: &str, paths: &str) -> Result<()> {
    let layout = data::layout(set, paths.parse()?)?;
    let (view, mut exact) = data::view(&layout)?;
    draw::oracle(&layout, &view, &mut exact)?;
    for (method, _) in draw::METHODS {
        let (_, mut frame) = data::view(&layout)?;
        draw::draw(method, &layout, &view, &mut frame)?;
        let pairs = frame.bytes().iter().zip(exact.bytes());
        let levels: Vec<u8> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
        let (pixels, _) = levels.as_chunks::<4>();
        let worst = |pixel: &[u8; 4]| pixel.iter().copied().max().unwrap_or(0);
        let beyond = |level: u8| pixels.iter().filter(|p| worst(p) > level).count();
        // Alpha is the same everywhere, so the mean is over three channels.
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

fn write_png(frame: &Frame, path: &str) -> Result<()> {
    let (width, height) = (frame.size().width(), frame.size().height());
    let mut encoder = png::Encoder::new(fs::File::create(path)?, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(frame.bytes())?;
    Ok(())
}
