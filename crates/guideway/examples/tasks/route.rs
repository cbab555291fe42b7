//! Finds the fastest way between two stations for a vehicle type.

use std::error::Error;
use std::path::Path;

use guideway::network::{RouteOptions, Router};

pub(super) fn run(site: &Path, _folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = guideway::open(site)?;
    let router = Router::new(&layout, Some("tugger-3000"), &RouteOptions::default())?;
    let (from, to) = (router.place("dock-1")?, router.place("dock-3")?);
    let route = router.route(&from, &to)?;
    Ok(format!(
        "{} paths, {:.1} m, {:.1} s",
        route.rows.len(),
        route.length_m,
        route.time_s
    ))
}
