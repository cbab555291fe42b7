//! Opens a site and asks for one of its paths: a speed, the length, a place on it.

use std::error::Error;
use std::path::Path;

use guideway::layout::Value;

pub(super) fn run(site: &Path, _folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = guideway::open(site)?;
    let path = layout
        .path("dock-1-002--dock-1-003")
        .ok_or("no such path")?;
    let Some(Value::Float(speed)) = path.value("maxSpeed") else {
        return Err("the path has no speed".into());
    };
    let middle = path.point_at_m(path.length_m() / 2.0).ok_or("no curve")?;
    Ok(format!(
        "{} is {} m long, at {speed} m/s; its middle is at {}, {}",
        path.id(),
        path.length_m(),
        middle.x,
        middle.y
    ))
}
