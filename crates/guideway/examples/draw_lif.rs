//! Opens a LIF file, checks it and draws it, with the feature `lif` alone:
//! `cargo run --example draw_lif --no-default-features --features lif -- site.lif.json site.png`

use std::error::Error;
use std::sync::Arc;

use guideway::scene::{Budget, Cancel, Frame, FrameSize, Scene, SceneOptions, Style, View};

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args_os().skip(1);
    let (Some(file), Some(picture)) = (args.next(), args.next()) else {
        return Err("name a layout and the picture to write".into());
    };
    let layout = guideway::open(file)?;
    for finding in guideway::check(&layout).iter() {
        println!("{}: {}. {}", finding.place, finding.message, finding.remedy);
    }
    let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default())?);
    let view = View::fit(FrameSize::new(1280, 720)?, scene.bounds())?;
    let mut prepared = guideway::method("cpu")?.prepare(scene, &Budget::default())?;
    let mut frame = Frame::new(view.size());
    let report = prepared.render(&view, &Style::default(), &Cancel::default(), &mut frame)?;
    guideway::save_png(&frame, picture)?;
    println!("{} paths drawn", report.drawn);
    Ok(())
}
