//! File formats: the formats that can be read, with their names and descriptions.

/// A file format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The Layout Interchange Format of the VDMA, 1.0 and 2.0.
    Lif,
    /// A plant model of openTCS, 0.0.2 to 7.0.0.
    OpenTcs,
    /// An order of VDA 5050, 1.1 to 3.1.
    Vda5050,
    /// GeoJSON, plain or a route graph of Nav2.
    GeoJson,
    /// A DXF drawing, ASCII or binary.
    Dxf,
    /// A drawing in SVG.
    Svg,
    /// A building or a navigation graph of Open-RMF.
    Rmf,
    /// Roads of ASAM OpenDRIVE.
    OpenDrive,
    /// A map of Lanelet2.
    Lanelet2,
    /// A table of paths in an Apache Arrow IPC file.
    Arrow,
}

impl Format {
    /// All formats.
    pub const ALL: &[Self] = &[
        Self::Lif,
        Self::OpenTcs,
        Self::Vda5050,
        Self::GeoJson,
        Self::Dxf,
        Self::Svg,
        Self::Rmf,
        Self::OpenDrive,
        Self::Lanelet2,
        Self::Arrow,
    ];

    /// Returns the name, as in [`guideway_layout::Provenance::format`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Lif => "LIF",
            Self::OpenTcs => "openTCS",
            Self::Vda5050 => "VDA 5050",
            Self::GeoJson => "GeoJSON",
            Self::Dxf => "DXF",
            Self::Svg => "SVG",
            Self::Rmf => "Open-RMF",
            Self::OpenDrive => "OpenDRIVE",
            Self::Lanelet2 => "Lanelet2",
            Self::Arrow => "Arrow",
        }
    }

    /// Returns the feature of this crate with which the format is built.
    pub fn feature(self) -> &'static str {
        match self {
            Self::Lif => "lif",
            Self::OpenTcs => "opentcs",
            Self::Vda5050 => "vda5050",
            Self::GeoJson => "geojson",
            Self::Dxf => "dxf",
            Self::Svg => "svg",
            Self::Rmf => "rmf",
            Self::OpenDrive => "opendrive",
            Self::Lanelet2 => "lanelet2",
            Self::Arrow => "arrow",
        }
    }

    /// Returns the name with the kind of file.
    pub fn description(self) -> &'static str {
        match self {
            Self::Lif => "VDMA LIF 1.0 and 2.0 (JSON)",
            Self::OpenTcs => "openTCS plant models (XML)",
            Self::Vda5050 => "VDA 5050 orders (JSON)",
            Self::GeoJson => "GeoJSON and Nav2 route graphs",
            Self::Dxf => "DXF drawings",
            Self::Svg => "SVG drawings",
            Self::Rmf => "Open-RMF buildings and navigation graphs (YAML), sites (JSON)",
            Self::OpenDrive => "OpenDRIVE roads (XML)",
            Self::Lanelet2 => "Lanelet2 maps (OSM XML)",
            Self::Arrow => "Arrow IPC files of paths",
        }
    }
}
