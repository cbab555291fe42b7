//! Saves a site as a drawing and as a table; the calls say what either cannot hold.

use std::error::Error;
use std::path::Path;

pub(super) fn run(site: &Path, folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = guideway::open(site)?;
    let mut said = Vec::new();
    for name in ["site.dxf", "site.arrow"] {
        let losses = guideway::save(&layout, folder.join(name))?;
        let back = guideway::open(folder.join(name))?;
        let lost = losses.iter().len();
        said.push(format!(
            "{name} has {} paths, {lost} kinds of losses",
            back.paths.len()
        ));
    }
    Ok(said.join("; "))
}
