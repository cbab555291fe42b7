//! Targets: the formats that can be written, with their names and file extensions.

use std::io::Write;
use std::path::Path;

use guideway_layout::{Layout, clock};

#[cfg(feature = "arrow")]
use crate::arrow;
#[cfg(feature = "dxf")]
use crate::dxf;
#[cfg(feature = "geojson")]
use crate::geojson;
#[cfg(feature = "lif")]
use crate::lif::{self, Version};
#[cfg(feature = "opentcs")]
use crate::opentcs;
use crate::output::replace_file;
#[cfg(feature = "rmf")]
use crate::rmf;
use crate::source::WrittenPaths;
#[cfg(feature = "vda5050")]
use crate::vda5050;
use crate::{Format, Losses, Progress, WriteError, WriteProblem, svg};

/// A format that can be written, in one of its versions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// Apache Arrow, a table of all elements.
    Arrow,
    /// DXF, a drawing for CAD programs.
    Dxf,
    /// GeoJSON with the whole layout, for geographic information systems.
    GeoJson,
    /// VDMA LIF 1.0.
    Lif1,
    /// VDMA LIF 2.0.
    Lif2,
    /// GeoJSON as a route graph of Nav2.
    Nav2,
    /// openTCS plant model 6.0.0.
    OpenTcs6,
    /// openTCS plant model 7.0.0.
    OpenTcs7,
    /// A navigation graph of Open-RMF.
    Rmf,
    /// SVG, a drawing with exact curves.
    Svg,
    /// VDA 5050 2.1, the order of a route.
    Vda2,
    /// VDA 5050 3.0, the order of a route.
    Vda3,
}

impl Target {
    /// All targets of this build.
    pub const ALL: &[Self] = &[
        #[cfg(feature = "arrow")]
        Self::Arrow,
        #[cfg(feature = "dxf")]
        Self::Dxf,
        #[cfg(feature = "geojson")]
        Self::GeoJson,
        #[cfg(feature = "lif")]
        Self::Lif1,
        #[cfg(feature = "lif")]
        Self::Lif2,
        #[cfg(feature = "geojson")]
        Self::Nav2,
        #[cfg(feature = "opentcs")]
        Self::OpenTcs6,
        #[cfg(feature = "opentcs")]
        Self::OpenTcs7,
        #[cfg(feature = "rmf")]
        Self::Rmf,
        Self::Svg,
        #[cfg(feature = "vda5050")]
        Self::Vda2,
        #[cfg(feature = "vda5050")]
        Self::Vda3,
    ];

    /// Identifier on the command line.
    pub fn id(self) -> &'static str {
        match self {
            Self::Arrow => "arrow",
            Self::Dxf => "dxf",
            Self::GeoJson => "geojson",
            Self::Lif1 => "lif",
            Self::Lif2 => "lif2",
            Self::Nav2 => "nav2",
            Self::OpenTcs6 => "opentcs6",
            Self::OpenTcs7 => "opentcs",
            Self::Rmf => "rmf",
            Self::Svg => "svg",
            Self::Vda2 => "vda5050",
            Self::Vda3 => "vda5050-3",
        }
    }

    /// The target with this identifier.
    pub fn from_id(id: &str) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|target| target.id() == id)
    }

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrow => "Arrow",
            Self::Dxf => "DXF",
            Self::GeoJson => "GeoJSON",
            Self::Lif1 => "LIF 1.0",
            Self::Lif2 => "LIF 2.0",
            Self::Nav2 => "Nav2 route graph",
            Self::OpenTcs6 => "openTCS 6.0.0",
            Self::OpenTcs7 => "openTCS 7.0.0",
            Self::Rmf => "Open-RMF navigation graph",
            Self::Svg => "SVG",
            Self::Vda2 => "VDA 5050 2.1",
            Self::Vda3 => "VDA 5050 3.0",
        }
    }

    /// Description for the help of the command, without extensions.
    pub fn description(self) -> &'static str {
        match self {
            Self::Arrow => "Apache Arrow, a table of everything",
            Self::Dxf => "DXF, a drawing for CAD programs",
            Self::GeoJson => "GeoJSON with the whole layout, for QGIS and the like",
            Self::Lif1 => "VDMA LIF 1.0",
            Self::Lif2 => "VDMA LIF 2.0",
            Self::Nav2 => "GeoJSON as a route graph of Nav2",
            Self::OpenTcs6 => "openTCS plant model 6.0.0",
            Self::OpenTcs7 => "openTCS plant model 7.0.0",
            Self::Rmf => "Open-RMF navigation graph (YAML)",
            Self::Svg => "SVG, a drawing with exact curves",
            Self::Vda2 => "VDA 5050 2.1, the order of one route",
            Self::Vda3 => "VDA 5050 3.0, the order of one route",
        }
    }

    /// File extensions that select the target, in lower case.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Arrow => &[".arrow", ".feather"],
            Self::Dxf => &[".dxf"],
            Self::GeoJson => &[".geojson"],
            Self::Lif1 => &[".lif.json", ".lif"],
            Self::Lif2 => &[".lif2.json"],
            Self::OpenTcs6 | Self::Vda3 => &[],
            Self::Nav2 => &[".nav2.geojson"],
            Self::OpenTcs7 => &[".opentcs.xml", ".xml"],
            Self::Rmf => &[".nav_graph.yaml"],
            Self::Svg => &[".svg"],
            Self::Vda2 => &[".vda5050.json"],
        }
    }

    /// The target that the extension of a file selects; of several extensions the longest one.
    pub fn of_file_name(name: &str) -> Option<Self> {
        let name = name.to_lowercase();
        let fitting = |target: &Self| {
            let extensions = target.extensions().iter();
            let fitting = extensions.filter(|extension| name.ends_with(**extension));
            fitting.map(|extension| extension.len()).max()
        };
        let targets = Self::ALL.iter().copied();
        let fitting = targets.filter_map(|target| Some((fitting(&target)?, target)));
        let longest = fitting.max_by_key(|(length, _)| *length);
        longest.map(|(_, target)| target)
    }

    /// The target that holds everything that the file of a layout held: that of the same format and
    /// version. `None` if the format of the file has no writer.
    pub fn of_source(layout: &Layout) -> Option<Self> {
        #[cfg(feature = "opentcs")]
        match opentcs::Version::of_layout(layout) {
            Some(opentcs::Version::V6) => return Some(Self::OpenTcs6),
            Some(opentcs::Version::V7) => return Some(Self::OpenTcs7),
            None => {}
        }
        #[cfg(feature = "vda5050")]
        match vda5050::Version::of_layout(layout) {
            Some(vda5050::Version::V2) => return Some(Self::Vda2),
            Some(vda5050::Version::V3) => return Some(Self::Vda3),
            None => {}
        }
        #[cfg(feature = "lif")]
        match Version::of_layout(layout) {
            Some(Version::V1) => return Some(Self::Lif1),
            Some(Version::V2) => return Some(Self::Lif2),
            None => {}
        }
        let provenance = &layout.provenance;
        let is = |format: Format| provenance.format == format.name();
        match provenance.format_version.as_str() {
            #[cfg(feature = "geojson")]
            geojson::ROUTE_GRAPH if is(Format::GeoJson) => return Some(Self::Nav2),
            #[cfg(feature = "rmf")]
            rmf::NAVIGATION_GRAPH if is(Format::Rmf) => return Some(Self::Rmf),
            _ => {}
        }
        let targets = [
            (Format::GeoJson, Self::GeoJson),
            (Format::Arrow, Self::Arrow),
            (Format::Dxf, Self::Dxf),
            (Format::Svg, Self::Svg),
        ];
        let mut targets = targets
            .iter()
            .filter(|(_, target)| Self::ALL.contains(target));
        let found = targets.find(|(format, _)| is(*format));
        found.map(|&(_, target)| target)
    }

    /// The target in which a layout is saved under a name: by the extension, or by the source of
    /// the layout where an extension fits several formats or versions, as `.json` does. `None` if
    /// no format has the extension.
    pub fn for_file(layout: &Layout, path: &Path) -> Option<Self> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let read = Self::of_source(layout);
        match (Self::of_file_name(&name), read) {
            (Some(Self::Lif1), Some(Self::Lif2)) => read,
            (Some(Self::Vda2), Some(Self::Vda3)) => read,
            (Some(Self::OpenTcs7), Some(Self::OpenTcs6)) => read,
            (Some(Self::GeoJson), Some(Self::Nav2)) => read,
            (
                None,
                Some(
                    Self::Lif1 | Self::Lif2 | Self::GeoJson | Self::Nav2 | Self::Vda2 | Self::Vda3,
                ),
            ) if has_extension(path, "json") => read,
            (None, Some(Self::Rmf)) if has_extension(path, "yaml") => read,
            (named, _) => named,
        }
    }

    /// Returns `true` if only the source of a layout can tell the target of a file with this
    /// extension: see [`Self::for_file`].
    pub fn depends_on_source(path: &Path) -> bool {
        has_extension(path, "json") || has_extension(path, "yaml")
    }

    /// Returns `true` if the target is a drawing, which holds the paths only.
    pub fn is_drawing(self) -> bool {
        matches!(self, Self::Dxf | Self::Svg)
    }

    /// Writes a layout to a file: see [`NewFile`](crate::NewFile). Returns the losses.
    ///
    /// # Errors
    /// As [`Self::write`]; the file is not touched then.
    pub fn write_file(self, layout: &Layout, path: &Path) -> Result<Losses, WriteError> {
        replace_file(path, |out| {
            self.write(layout, out).map_err(|problem| WriteError {
                path: path.to_owned(),
                problem,
            })
        })
    }

    /// Writes a layout to a stream. Returns the losses.
    ///
    /// # Errors
    /// When the stream fails, or when the target is an order and the paths do not form one route.
    pub fn write(self, layout: &Layout, out: &mut impl Write) -> Result<Losses, WriteProblem> {
        struct Nobody;
        impl Progress for Nobody {}
        self.write_watched(layout, out, &Nobody)
    }

    /// Writes a layout to a stream, and reports the paths that are written.
    ///
    /// # Errors
    /// As [`Self::write`].
    pub fn write_watched(
        self,
        layout: &Layout,
        out: &mut impl Write,
        progress: &dyn Progress,
    ) -> Result<Losses, WriteProblem> {
        // One set of writers for all streams.
        self.write_dyn(layout, out, progress)
    }

    fn write_dyn(
        self,
        layout: &Layout,
        mut out: &mut dyn Write,
        progress: &dyn Progress,
    ) -> Result<Losses, WriteProblem> {
        let out = &mut out;
        let paths = &WrittenPaths::of(layout, progress);
        let exported = clock::now();
        #[cfg(feature = "lif")]
        let lif = |version| lif::WriteOptions { version, exported };
        #[cfg(feature = "vda5050")]
        let vda5050 = |version| vda5050::WriteOptions { version, exported };
        #[cfg(feature = "geojson")]
        let geojson = geojson::WriteOptions::default();
        let losses = match self {
            #[cfg(feature = "arrow")]
            Self::Arrow => {
                arrow::write_watched(layout, out, &arrow::WriteOptions::default(), paths)?
            }
            #[cfg(feature = "dxf")]
            Self::Dxf => dxf::write_watched(layout, out, paths)?,
            #[cfg(feature = "geojson")]
            Self::GeoJson => geojson::write_watched(layout, out, &geojson, paths)?,
            #[cfg(feature = "lif")]
            Self::Lif1 => lif::write_watched(layout, out, &lif(Version::V1), paths)?,
            #[cfg(feature = "lif")]
            Self::Lif2 => lif::write_watched(layout, out, &lif(Version::V2), paths)?,
            #[cfg(feature = "geojson")]
            Self::Nav2 => geojson::write_route_graph_watched(layout, out, &geojson, paths)?,
            #[cfg(feature = "opentcs")]
            Self::OpenTcs6 => opentcs::write_watched(layout, out, opentcs::Version::V6, paths)?,
            #[cfg(feature = "opentcs")]
            Self::OpenTcs7 => opentcs::write_watched(layout, out, opentcs::Version::V7, paths)?,
            #[cfg(feature = "rmf")]
            Self::Rmf => rmf::write_navigation_graph(layout, out)?,
            Self::Svg => svg::write_watched(layout, out, paths)?,
            #[cfg(feature = "vda5050")]
            Self::Vda2 => vda5050::write_layout(layout, out, &vda5050(vda5050::Version::V2))?,
            #[cfg(feature = "vda5050")]
            Self::Vda3 => vda5050::write_layout(layout, out, &vda5050(vda5050::Version::V3))?,
            #[cfg(not(feature = "all"))]
            other => return Err(WriteProblem::NotBuilt(other.name())),
        };
        Ok(losses)
    }
}

fn has_extension(path: &Path, extension: &str) -> bool {
    let own = path.extension();
    own.is_some_and(|own| own.eq_ignore_ascii_case(extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_writer_of_networks_reports_its_paths() {
        use std::sync::Mutex;
        struct Seen(Mutex<Vec<(u64, u64)>>);
        impl Progress for Seen {
            fn advance(&self, done: u64, total: u64) {
                self.0.lock().unwrap().push((done, total));
            }
        }
        let mut layout = Layout::default();
        let nodes = [0.0, 9.0].map(|x| {
            let at = guideway_spline::Point::new(x, 0.0);
            layout.nodes.push(&format!("n{x}"), at, None)
        });
        let mut runs = guideway_spline::Runs::default();
        let ends = nodes.map(|node| layout.nodes.position_m(node));
        runs.push_line(ends[0], ends[1]);
        for path in 0..600 {
            layout.paths.push(&guideway_layout::NewPath {
                id: &path.to_string(),
                runs: &runs,
                start_node: Some(nodes[0]),
                end_node: Some(nodes[1]),
                ..guideway_layout::NewPath::default()
            });
        }
        for &target in Target::ALL {
            let seen = Seen(Mutex::default());
            let written = target.write_watched(&layout, &mut Vec::new(), &seen);
            // An order is one route, and a navigation graph is small.
            if !matches!(target, Target::Rmf | Target::Vda2 | Target::Vda3) {
                assert!(written.is_ok(), "{target:?}");
                let seen = seen.0.into_inner().unwrap();
                assert_eq!(seen, [(256, 600), (512, 600), (600, 600)], "{target:?}");
            }
        }
    }

    #[test]
    fn identifiers_and_extensions_select_one_target() {
        for &target in Target::ALL {
            assert_eq!(Target::from_id(target.id()), Some(target));
            for extension in target.extensions() {
                let name = format!("Hall 2{}", extension.to_uppercase());
                assert_eq!(Target::of_file_name(&name), Some(target));
            }
        }
        assert_eq!(Target::of_file_name("plan.png"), None);
        assert_eq!(Target::of_file_name("a.b.geojson"), Some(Target::GeoJson));
    }
}
