//! Draws a site twice: in one call, and as a plan with names, colored by speed.

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use guideway::compose::{Decorations, NoProgress, Picture};
use guideway::scene::{ColorBy, FrameSize, Scene, SceneOptions};

pub(super) fn run(site: &Path, folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = guideway::open(site)?;
    let drawn = guideway::render(layout.clone(), folder.join("site.svg"))?;

    let options = SceneOptions {
        color_by: Some(ColorBy {
            column: "maxSpeed".into(),
        }),
        ..SceneOptions::default()
    };
    let scene = Arc::new(Scene::new(Arc::new(layout), &options)?);
    let mut picture = Picture::new(scene, FrameSize::new(960, 540)?);
    picture.decorations = Decorations::site("Example site");
    let method = guideway::method("cpu")?;
    picture.save_png(&*method, folder.join("plan.png"), &NoProgress)?;
    Ok(format!(
        "{} paths in site.svg and plan.png",
        drawn.report.drawn
    ))
}
