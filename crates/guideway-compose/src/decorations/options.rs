//! Selection of decorations.

use guideway_document::decorations::DecorationStyle;

use super::route::MarkedRoute;

/// The decorations of a picture. The default is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Decorations {
    /// Lines at round coordinates, below the paths.
    pub has_grid: bool,
    /// Zones: a tint with an outline, below the paths.
    pub has_zones: bool,
    /// Arrows along the paths, in the direction of travel; none in a drawing, whose lines have no
    /// direction.
    pub has_arrows: bool,
    /// A diamond per node.
    pub has_nodes: bool,
    /// A square per station.
    pub has_stations: bool,
    /// Names of stations, nodes and paths, where they have room.
    pub has_labels: bool,
    /// A bar of a round length.
    pub has_scale_bar: bool,
    /// The meaning of the colors, if the scene colors paths by a column or shows their density.
    pub has_legend: bool,
    /// A route over the paths.
    pub route: Option<MarkedRoute>,
    /// One line at the top.
    pub title: Option<String>,
    /// Pixels of the picture per point, the scale of texts; `None` derives it from the size.
    pub px_per_point: Option<f64>,
}

impl Decorations {
    /// All decorations, with a title.
    pub fn site(title: impl Into<String>) -> Self {
        Self {
            has_grid: true,
            has_zones: true,
            has_arrows: true,
            has_nodes: true,
            has_stations: true,
            has_labels: true,
            has_scale_bar: true,
            has_legend: true,
            route: None,
            title: Some(title.into()),
            px_per_point: None,
        }
    }

    /// Height of the band that the title occupies, in pixels; zero without a title.
    pub(crate) fn title_band_px(&self, style: &DecorationStyle) -> f64 {
        match self.title {
            Some(_) => 2.5 * style.line_px(),
            None => 0.0,
        }
    }

    /// Returns `true` if there is any arrow, node, station or label.
    pub(super) fn has_marks(&self) -> bool {
        self.has_arrows || self.has_nodes || self.has_stations || self.has_labels
    }
}
