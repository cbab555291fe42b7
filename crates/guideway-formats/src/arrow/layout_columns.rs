//! Layout columns: the columns that a layout needs in a table.

use std::collections::HashSet;

use arrow_array::types::{Int8Type, Int32Type};
use arrow_schema::{DataType, Field};
use guideway_layout::{Direction, Layout, PathRef};

use super::attribute_plan::{self, AttributeSource};
use super::column_names::{
    COLOR, CONTROL_POINTS, CURVE, DIRECTION, ELEMENT, ELEVATION, END_NODE, ID, LEVEL, LEVEL_NAME,
    MEMBERS, NODES, OF, OUTLINE, PART, PATHS_VERSION, RANK, REFUSAL_CODE, REFUSAL_DETAIL,
    START_NODE, VEHICLE_TYPES, WIDTH, X, Y,
};
use super::element::Element;
use super::layout_lists::{self as lists, Dictionary};
use super::layout_rows::rows;
use super::write_column::{PolygonCells, Precision};

/// A column of a table, by the source of its values.
pub(super) enum Source<'a> {
    Id,
    ControlPoints(Precision),
    Element(Dictionary<Int8Type>),
    Part,
    LevelIds,
    /// For levels that share an identifier.
    LevelNumbers,
    Width,
    Color(&'a [u32]),
    Rank(&'a [i32]),
    StartNode,
    EndNode,
    Direction(Dictionary<Int8Type>),
    VehicleTypes(Dictionary<Int32Type>),
    Curve,
    X,
    Y,
    Nodes,
    Of,
    LevelName,
    Elevation,
    Members,
    Outline,
    RefusalCode,
    RefusalDetail,
    Attribute(AttributeSource<'a>),
}

/// Returns the columns that a layout needs. The control points come second: readers find their
/// buffer without a look at the other columns.
pub(super) fn sources(layout: &Layout, version: u32, precision: Precision) -> Vec<Source<'_>> {
    let mut sources = vec![Source::Id, Source::ControlPoints(precision)];
    let mut add = |is_needed: bool, source| {
        if is_needed {
            sources.push(source);
        }
    };
    let paths = &layout.paths;
    let any = |test: &dyn Fn(PathRef<'_>) -> bool| paths.iter().any(test);
    let is_network = version > PATHS_VERSION;
    let kinds = || Dictionary::new(Element::ALL.map(Element::name));
    if is_network {
        add(true, Source::Element(kinds()));
    }
    add(any(&|p| p.runs().len() > 1), Source::Part);
    let nodes = 0..layout.nodes.len() as u32;
    let stations = 0..layout.stations.len() as u32;
    let has_levels = any(&|p| p.level().is_some())
        || nodes.clone().any(|n| layout.nodes.level(n).is_some())
        || stations.clone().any(|s| layout.stations.level(s).is_some())
        || layout.zones.iter().any(|zone| zone.level.is_some());
    let by_id = has_unique_level_ids(layout);
    add(
        has_levels,
        if by_id {
            Source::LevelIds
        } else {
            Source::LevelNumbers
        },
    );
    add(paths.width_m().is_some(), Source::Width);
    if let Some(colors) = paths.color_rgba() {
        add(true, Source::Color(colors));
    }
    if let Some(ranks) = paths.rank() {
        add(true, Source::Rank(ranks));
    }
    if is_network {
        let is_both = |p: PathRef<'_>| p.direction() == Direction::Both;
        let directions = Dictionary::new(lists::DIRECTIONS);
        let types = Dictionary::of_types(layout);
        let has_position = |s: u32| layout.stations.position_m(s).is_some();
        let has_positions = !layout.nodes.is_empty() || stations.clone().any(has_position);
        let entries = [Element::PathType, Element::NodeType];
        let has_entries = |&kind: &Element| rows(layout, kind).next().is_some();
        add(any(&|p| p.start_node().is_some()), Source::StartNode);
        add(any(&|p| p.end_node().is_some()), Source::EndNode);
        add(any(&is_both), Source::Direction(directions));
        add(!types.is_empty(), Source::VehicleTypes(types));
        add(!paths.written_curves().is_empty(), Source::Curve);
        add(has_positions, Source::X);
        add(has_positions, Source::Y);
        let has_nodes = |s: u32| !layout.stations.nodes(s).is_empty();
        add(stations.clone().any(has_nodes), Source::Nodes);
        add(entries.iter().any(has_entries), Source::Of);
        let levels = || layout.levels.iter();
        add(levels().any(|l| l.name.is_some()), Source::LevelName);
        add(levels().any(|l| l.elevation_m.is_some()), Source::Elevation);
        let has_members = layout.blocks.iter().any(|b| !b.members.is_empty());
        add(has_members, Source::Members);
        let has_outlines = layout.zones.iter().any(|z| !z.outline_m.is_empty());
        add(has_outlines, Source::Outline);
        add(!layout.refused.is_empty(), Source::RefusalCode);
        add(!layout.refused.is_empty(), Source::RefusalDetail);
    }
    let attributes = attribute_plan::plan(layout, version);
    sources.extend(attributes.into_iter().map(Source::Attribute));
    sources
}

impl Source<'_> {
    /// Returns the field of the schema.
    pub(super) fn field(&self, version: u32) -> Field {
        let (name, data_type) = match self {
            Self::Id => return Field::new(ID, DataType::Utf8, false),
            Self::ControlPoints(precision) => {
                let is_nullable = version > PATHS_VERSION;
                return PolygonCells::new(*precision).field(CONTROL_POINTS, is_nullable);
            }
            Self::Attribute(attribute) => return attribute.field(),
            Self::Element(_) => (ELEMENT, lists::dictionary_type(DataType::Int8)),
            Self::Part => (PART, DataType::UInt32),
            Self::LevelIds => (LEVEL, DataType::Utf8),
            Self::LevelNumbers => (LEVEL, DataType::UInt32),
            Self::Width => (WIDTH, DataType::Float32),
            Self::Color(_) => (COLOR, DataType::UInt32),
            // All have one: by it, a part of the paths keeps its draw order.
            Self::Rank(_) if version == PATHS_VERSION => {
                return Field::new(RANK, DataType::Int32, false);
            }
            Self::Rank(_) => (RANK, DataType::Int32),
            Self::StartNode => (START_NODE, DataType::UInt32),
            Self::EndNode => (END_NODE, DataType::UInt32),
            Self::Direction(_) => (DIRECTION, lists::dictionary_type(DataType::Int8)),
            Self::VehicleTypes(_) => (VEHICLE_TYPES, lists::types_type()),
            Self::Curve => (CURVE, lists::curve_type()),
            Self::X => (X, DataType::Float64),
            Self::Y => (Y, DataType::Float64),
            Self::Nodes => (NODES, lists::list_type(DataType::UInt32)),
            Self::Of => (OF, DataType::UInt32),
            Self::LevelName => (LEVEL_NAME, DataType::Utf8),
            Self::Elevation => (ELEVATION, DataType::Float64),
            Self::Members => (MEMBERS, lists::members_type()),
            Self::Outline => (OUTLINE, lists::list_type(lists::point_type())),
            Self::RefusalCode => (REFUSAL_CODE, DataType::Utf8),
            Self::RefusalDetail => (REFUSAL_DETAIL, DataType::Utf8),
        };
        Field::new(name, data_type, true)
    }

    /// Returns whether elements of a kind have values in the column.
    pub(super) fn has(&self, kind: Element) -> bool {
        match self {
            Self::Id | Self::Element(_) | Self::Attribute(_) => true,
            Self::ControlPoints(_)
            | Self::Part
            | Self::Width
            | Self::Color(_)
            | Self::Rank(_)
            | Self::StartNode
            | Self::EndNode
            | Self::Direction(_)
            | Self::Curve => kind == Element::Path,
            Self::LevelIds | Self::LevelNumbers => matches!(
                kind,
                Element::Path | Element::Node | Element::Station | Element::Zone
            ),
            Self::VehicleTypes(_) => matches!(kind, Element::Path | Element::Node),
            Self::X | Self::Y => matches!(kind, Element::Node | Element::Station),
            Self::Nodes => kind == Element::Station,
            Self::Of => matches!(kind, Element::PathType | Element::NodeType),
            Self::LevelName | Self::Elevation => kind == Element::Level,
            Self::Members => kind == Element::Block,
            Self::Outline => kind == Element::Zone,
            Self::RefusalCode | Self::RefusalDetail => kind == Element::RefusedPath,
        }
    }
}

/// Returns whether an identifier names one level.
pub(super) fn has_unique_level_ids(layout: &Layout) -> bool {
    let mut ids = HashSet::new();
    layout.levels.iter().all(|level| ids.insert(&level.id))
}
