//! Moves a node: the ends of its paths follow, and the move can be undone. Then saves the site.

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use guideway::document::Document;
use guideway::scene::SceneOptions;
use guideway::spline::Point;

pub(super) fn run(site: &Path, folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = Arc::new(guideway::open(site)?);
    let edge = layout
        .edge("dock-1-002--dock-1-003")
        .ok_or("no such edge")?;
    let (length_m, node) = (edge.length_m(), edge.end_node().ok_or("no node")?);
    let to_m = layout.nodes.position_m(node) + Point::new(0.5, 0.0);

    let mut document = Document::new(Arc::clone(&layout), &SceneOptions::default())?;
    document.move_node(node, to_m)?;
    let moved = document.layout().edge(edge.id()).ok_or("no such edge")?;
    let text = format!("{length_m} m before, {:.3} m after", moved.length_m());
    guideway::save(document.layout(), folder.join("moved.lif.json"))?;
    document.undo();
    Ok(text)
}
