//! Options of `render` that add nodes, stations, arrows, labels, grid, scale bar and title.

use guideway::compose::Decorations;

use crate::cli::input::Input;
use crate::cli::route::RouteEnds;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Decorations")]
pub(super) struct DecorationArgs {
    /// Draw the whole site: all options of this group, and the legend with --color-by. The title is
    /// the name of the first file unless --title is given
    #[arg(long)]
    site: bool,
    /// Draw paths alone, all in one style, whatever they are: lines of 0.1 m, from 1.5 to 12 pixels
    #[arg(
        long,
        conflicts_with_all = [
            "site", "nodes", "stations", "arrows", "labels", "grid", "scale_bar", "title", "legend",
            "route"
        ]
    )]
    pub(super) plain: bool,
    /// Draw a diamond per node
    #[arg(long)]
    nodes: bool,
    /// Draw a square per station
    #[arg(long)]
    stations: bool,
    /// Draw arrows in the direction of travel
    #[arg(long)]
    arrows: bool,
    /// Draw the names of stations, nodes and paths where they have room
    #[arg(long)]
    labels: bool,
    /// Draw grid lines at round coordinates
    #[arg(long)]
    grid: bool,
    /// Draw a scale bar in the lower left corner
    #[arg(long)]
    scale_bar: bool,
    /// Draw the fastest route between two stations or nodes over the paths
    #[arg(long, value_name = "FROM,TO[,TYPE]", value_parser = RouteEnds::parse)]
    pub(super) route: Option<RouteEnds>,
    /// Draw a title at the top
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
}

impl DecorationArgs {
    /// The options of which a page has none: it shows the whole site, and has switches.
    pub(super) fn absent_in_pages(&self) -> [(&'static str, bool); 8] {
        [
            ("--route", self.route.is_some()),
            ("--plain", self.plain),
            ("--nodes", self.nodes),
            ("--stations", self.stations),
            ("--arrows", self.arrows),
            ("--labels", self.labels),
            ("--grid", self.grid),
            ("--scale-bar", self.scale_bar),
        ]
    }

    /// Returns `true` if they depend on paths beyond the view: routes lead there, and names and
    /// arrows that have no room give way to those of other paths.
    pub(super) fn depends_on_all(&self) -> bool {
        self.site || self.arrows || self.labels || self.route.is_some()
    }

    /// The decorations that the options select.
    pub(super) fn decorations(&self, inputs: &[Input]) -> Decorations {
        if self.site {
            let title = self.title.clone();
            return Decorations::site(title.unwrap_or_else(|| default_title(inputs)));
        }
        Decorations {
            has_grid: self.grid,
            has_zones: !self.plain,
            has_arrows: self.arrows,
            has_nodes: self.nodes,
            has_stations: self.stations,
            has_labels: self.labels,
            has_scale_bar: self.scale_bar,
            has_legend: false,
            route: None,
            title: self.title.clone(),
            px_per_point: None,
        }
    }
}

/// Name of the first file without its extensions.
fn default_title(inputs: &[Input]) -> String {
    let name = inputs.first().and_then(|input| input.path.file_name());
    let name = name.unwrap_or_default().to_string_lossy();
    let stem = name.split('.').find(|part| !part.is_empty());
    stem.unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn title_is_name_of_first_file_without_extensions() {
        let input = |path: &str| Input {
            path: path.into(),
            ..Input::default()
        };
        assert_eq!(default_title(&[input("a/Halle 3.lif.json")]), "Halle 3");
        assert_eq!(default_title(&[input(".hidden.dxf")]), "hidden");
        assert_eq!(default_title(&[]), "");
    }
}
