//! Makes a network of the lines of a drawing: ends that meet become nodes, crossings are cut.

use std::error::Error;
use std::path::Path;

use guideway::network::{BuildOptions, build};

pub(super) fn run(site: &Path, folder: &Path) -> Result<String, Box<dyn Error>> {
    let drawing = folder.join("lines.dxf");
    guideway::save(&guideway::open(site)?, &drawing)?;

    let options = BuildOptions {
        split_crossings: true,
        split_junctions: true,
        ..BuildOptions::default()
    };
    let network = build(&guideway::open(&drawing)?, &options)?.layout;
    guideway::save(&network, folder.join("network.lif.json"))?;
    Ok(format!(
        "{} edges between {} nodes",
        network.paths.len(),
        network.nodes.len()
    ))
}
