//! Opens a site and asks for one of its edges: a speed, the length, a place on it.

use std::error::Error;
use std::path::Path;

use guideway::layout::Value;

pub(super) fn run(site: &Path, _folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = guideway::open(site)?;
    let edge = layout
        .edge("dock-1-002--dock-1-003")
        .ok_or("no such edge")?;
    let Some(Value::Float(speed)) = edge.attribute("maxSpeed") else {
        return Err("the edge has no speed".into());
    };
    let middle = edge.point_at(edge.length_m() / 2.0).ok_or("no curve")?;
    Ok(format!(
        "{} is {} m long, at {speed} m/s; its middle is at {}, {}",
        edge.id(),
        edge.length_m(),
        middle.x,
        middle.y
    ))
}
