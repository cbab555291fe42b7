//! LIF mapping: adds the levels of a file, with their nodes, edges and stations, to the layout.

use guideway_layout::{Attributes, Code, Layout, Level, Place, TextPosition, Value};

use super::mapper::Mapper;
use super::members::{ORIGIN_OTHER, OTHER};
use super::model::{self, Origin, Root};
use super::type_entries::{ColumnCell, other_cell};
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::json::{
    ArrayFault, Field, LazyArray, LazyItem, OtherMembers, RecordKind, field_place,
    find_lines_within, items,
};

/// A layout record with its place in the file. Each maps to a level.
struct LayoutEntry<'r, 'a> {
    place: String,
    record: &'r model::Layout<'a>,
    origin: Option<&'r Origin<'a>>,
}

impl LayoutEntry<'_, '_> {
    /// The place of an array of the record.
    fn list(&self, key: &str) -> String {
        format!("{}.{key}", self.place)
    }
}

/// An array of a layout: the kind of its records, and how they are mapped.
trait MappedKind: RecordKind {
    fn map<'t>(
        mapper: &mut Mapper<'_>,
        item: &LazyItem<'t, Self::Record<'t>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError>;
}

/// Defines the kind of an array by the record of its items and the function that maps them.
macro_rules! kind {
    ($name:ident, $record:ident, $map:ident) => {
        enum $name {}

        impl RecordKind for $name {
            type Record<'t> = model::$record<'t>;
        }

        impl MappedKind for $name {
            fn map<'t>(
                mapper: &mut Mapper<'_>,
                item: &LazyItem<'t, model::$record<'t>>,
                level: u32,
                at: PlaceFn<'_>,
            ) -> Result<(), ReadError> {
                mapper.$map(item, level, at)
            }
        }
    };
}

kind!(NodeKind, Node, map_node);
kind!(EdgeKind, Edge, map_edge);
kind!(StationKind, Station, map_station);

impl Mapper<'_> {
    /// Maps the root object, which the skeleton holds, to a layout.
    pub(super) fn map(mut self, root: &Root<'_>) -> Result<Layout, ArrayFault> {
        let at_root: PlaceFn<'_> = &|| Place::element("the root");
        self.builder.check_repeated(root.repeated, at_root);
        self.map_version(root)?;
        self.map_root(root)?;
        let layouts = self.layouts(root)?;
        // All nodes come first: an edge may lead to a node of a later layout.
        for (level, entry) in layouts.iter().enumerate() {
            self.map_level(entry)?;
            let list = entry.list("nodes");
            self.map_items::<NodeKind>(&entry.record.nodes, &list, level)?;
        }
        for (level, entry) in layouts.iter().enumerate() {
            let (edges, stations) = (entry.list("edges"), entry.list("stations"));
            self.map_items::<EdgeKind>(&entry.record.edges, &edges, level)?;
            self.map_items::<StationKind>(&entry.record.stations, &stations, level)?;
        }
        self.set_node_types();
        Ok(self.finish(layouts.len()))
    }

    /// Maps the items of an array, whose place in the file is `list`.
    fn map_items<K: MappedKind>(
        &mut self,
        field: &Field<LazyArray<'_>>,
        list: &str,
        level: usize,
    ) -> Result<(), ArrayFault> {
        let Some(LazyArray { text }) = field.get() else {
            return Ok(());
        };
        let array = self.skeleton.array(text).ok_or(ArrayFault::Separator)?;
        let (mut index, mut start) = (0, array.first);
        array.for_each_batch::<K>(self.input, |parts| {
            self.builder
                .advance(parts.iter().map(|part| part.bytes).sum())?;
            for part in parts {
                for item in &part.items {
                    let at = || Place::element(format!("{list}[{index}]"));
                    self.map_item::<K>(item, start.then(item.position), level as u32, &at)?;
                    index += 1;
                }
                start = start.then(part.end);
            }
            Ok(())
        })?;
        self.builder.element_byte = None;
        self.builder.element_position = None;
        Ok(())
    }

    /// Maps an item at a position of the file, and finds the lines of the findings about it.
    fn map_item<'t, K: MappedKind>(
        &mut self,
        item: &LazyItem<'t, K::Record<'t>>,
        position: TextPosition,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.builder.element_byte = Some(item.start);
        self.builder.element_position = (!self.keeps_text).then_some(position);
        let before = self.builder.layout.diagnostics.iter().len();
        K::map(self, item, level, at)?;
        let findings = self.builder.layout.diagnostics.iter_mut().skip(before);
        if findings.len() > 0 {
            find_lines_within(findings, &at().element, item.text, position);
        }
        Ok(())
    }

    fn map_version(&mut self, root: &Root<'_>) -> Result<(), ReadError> {
        let version = if root.origins.is_absent() {
            "1.0"
        } else {
            "2.0"
        };
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::Lif.name().clone_into(&mut provenance.format);
        version.clone_into(&mut provenance.format_version);
        let at: PlaceFn<'_> = &|| Place::element("metaInformation");
        self.builder.check_type(&root.meta, at, "an object");
        let Some(meta) = root.meta.get() else {
            return Ok(());
        };
        let stated = meta.attributes.text("lifVersion");
        if let Some(stated) = stated.filter(|s| s.split('.').next() != version.split('.').next()) {
            let at: PlaceFn<'_> = &|| field_place(at, "lifVersion");
            let message =
                || format!("the file states version {stated}, but its structure is {version}");
            let remedy = "None needed: the structure decides the version";
            self.builder.report(Code::Version, at, message, remedy);
        }
        Ok(())
    }

    /// Keeps the meta information and further members of the file on the layout.
    fn map_root(&mut self, root: &Root<'_>) -> Result<(), ReadError> {
        let mut other = OtherMembers::default();
        let mut cells = Vec::new();
        if let Some(meta) = root.meta.get() {
            let at: PlaceFn<'_> = &|| Place::element("metaInformation");
            let mut of_meta = OtherMembers::default();
            cells = self.cells(&meta.attributes, &self.columns.meta, &mut of_meta, at)?;
            if let Some(text) = of_meta.into_text() {
                other.add(None, "metaInformation", &text);
            }
        }
        root.attributes.add_other(&mut other);
        cells.extend(other_cell(other, OTHER));
        let mut attributes = Attributes::default();
        self.set_cells(&mut attributes, &cells)?;
        self.builder.layout.attributes = attributes;
        Ok(())
    }

    /// Sets the values of a table of one row.
    fn set_cells(
        &mut self,
        attributes: &mut Attributes,
        cells: &[ColumnCell<'_>],
    ) -> Result<(), ReadError> {
        for cell in cells {
            let value = cell.cell.value();
            if let Value::Text(text) | Value::Json(text) = value {
                self.builder.check_text(text)?;
            }
            attributes.set(0, cell.column, value);
        }
        Ok(())
    }

    fn layouts<'r, 't>(
        &mut self,
        root: &'r Root<'t>,
    ) -> Result<Vec<LayoutEntry<'r, 't>>, ReadError> {
        let mut layouts = Vec::new();
        self.collect(&root.layouts, "layouts", None, &mut layouts);
        for (i, origin) in items(&root.origins) {
            let place = format!("origins[{i}]");
            let at: PlaceFn<'_> = &|| Place::element(place.as_str());
            if let Some(origin) = self.builder.record(origin, at) {
                self.builder.check_repeated(origin.repeated, at);
                self.builder.check_array(&origin.layouts, at, "layouts");
                let name = format!("{place}.layouts");
                self.collect(&origin.layouts, &name, Some(origin), &mut layouts);
            }
        }
        for entry in &layouts {
            let at: PlaceFn<'_> = &|| Place::element(entry.place.as_str());
            self.builder.check_repeated(entry.record.repeated, at);
            self.builder.check_array(&entry.record.nodes, at, "nodes");
            self.builder.check_array(&entry.record.edges, at, "edges");
            self.builder
                .check_array(&entry.record.stations, at, "stations");
        }
        Ok(layouts)
    }

    fn collect<'r, 't>(
        &mut self,
        list: &'r Field<Vec<Field<model::Layout<'t>>>>,
        name: &str,
        origin: Option<&'r Origin<'t>>,
        layouts: &mut Vec<LayoutEntry<'r, 't>>,
    ) {
        for (i, layout) in items(list) {
            let place = format!("{name}[{i}]");
            if let Some(record) = self
                .builder
                .record(layout, &|| Place::element(place.as_str()))
            {
                layouts.push(LayoutEntry {
                    place,
                    record,
                    origin,
                });
            }
        }
    }

    fn map_level(&mut self, entry: &LayoutEntry<'_, '_>) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place::element(entry.place.as_str());
        let id = self.builder.id(&entry.record.id, at, "layoutId")?;
        let name = self
            .builder
            .text(&entry.record.name, &|| field_place(at, "layoutName"))?;
        let new = self.levels.insert(id.clone().into_owned());
        if !new {
            let message = || format!("the layoutId `{id}` occurs more than once");
            let remedy = "Both levels are read and `--level` shows the first; rename one";
            self.builder.report(Code::DuplicateId, at, message, remedy);
        }
        let mut other = OtherMembers::default();
        let mut cells = self.cells(
            &entry.record.attributes,
            &self.columns.layout,
            &mut other,
            at,
        )?;
        cells.extend(other_cell(other, OTHER));
        if let Some(origin) = entry.origin {
            let mut other = OtherMembers::default();
            cells.extend(self.cells(&origin.attributes, &self.columns.origin, &mut other, at)?);
            cells.extend(other_cell(other, ORIGIN_OTHER));
        }
        let mut attributes = Attributes::default();
        self.set_cells(&mut attributes, &cells)?;
        self.builder.layout.levels.push(Level {
            id: id.into_owned(),
            name: name.map(str::to_owned),
            attributes,
            source: Some(self.builder.layout.levels.len() as u32),
            ..Level::default()
        });
        Ok(())
    }
}
