//! Rows of levels, vehicle types, blocks, zones, refused paths and the layout as a whole.

use arrow_array::Array;
use arrow_array::cast::AsArray;
use guideway_layout::{Attributes, Block, Code, Level, Member, Refused, VehicleType, Zone};
use guideway_spline::Point;

use super::element_rows::ElementRows;
use super::faults::Faults;
use crate::Problem;
use crate::arrow::batch::Batch;
use crate::arrow::budget::Budget;
use crate::arrow::column_names::{MEMBER_ELEMENT, MEMBER_INDEX, MEMBERS};
use crate::arrow::element::Element;
use crate::arrow::level_column::{LevelColumn, Levels, level_at};
use crate::arrow::list_array::{ListArray, indices};
use crate::arrow::numbering::Numbering;
use crate::arrow::point_items::PointLists;
use crate::arrow::problems::damaged;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;
use crate::arrow::text_array::TextArray;

/// Returns the levels in rows of that kind.
pub(super) fn levels(
    rows: ElementRows<'_>,
    faults: &mut Faults<'_>,
) -> Result<Vec<Level>, Problem> {
    let rows = rows.finish(faults.diagnostics)?;
    let level = |row| {
        Ok(Level {
            id: rows.ids.get(row).to_owned(),
            name: rows.text(Role::LevelName, row).map(str::to_owned),
            elevation_m: rows.number(Role::Elevation, row),
            attributes: rows.attributes_of(row, faults.diagnostics)?,
            source: None,
        })
    };
    (0..rows.len()).map(level).collect()
}

/// Returns the vehicle types in rows of that kind.
pub(super) fn vehicle_types(
    rows: ElementRows<'_>,
    faults: &mut Faults<'_>,
) -> Result<Vec<VehicleType>, Problem> {
    let rows = rows.finish(faults.diagnostics)?;
    let vehicle_type = |row| {
        Ok(VehicleType {
            id: rows.ids.get(row).to_owned(),
            attributes: rows.attributes_of(row, faults.diagnostics)?,
        })
    };
    (0..rows.len()).map(vehicle_type).collect()
}

/// Returns the properties of the layout as a whole: those of the first row of that kind.
pub(super) fn layout_attributes(
    rows: ElementRows<'_>,
    faults: &mut Faults<'_>,
) -> Result<Attributes, Problem> {
    let rows = rows.finish(faults.diagnostics)?;
    if rows.len() > 1 {
        faults.report(
            Code::UnknownValue,
            Element::Layout,
            rows.ids.get(1),
            || format!("{} rows are of the kind layout", rows.len()),
            "Only the first one is read; write one row",
        );
    }
    Ok(match rows.len() {
        0 => Attributes::default(),
        _ => rows.attributes_of(0, faults.diagnostics)?,
    })
}

/// Appends the refused paths in rows of that kind.
pub(super) fn refused(
    rows: ElementRows<'_>,
    refused: &mut Refused,
    faults: &mut Faults<'_>,
) -> Result<(), Problem> {
    let rows = rows.finish(faults.diagnostics)?;
    for row in 0..rows.len() {
        let (id, name) = (rows.ids.get(row), rows.text(Role::RefusalCode, row));
        let mut codes = Code::ALL.iter().copied();
        let code = codes.find(|code| Some(code.name()) == name);
        if code.is_none() {
            faults.report(
                Code::UnknownValue,
                Element::RefusedPath,
                id,
                || "column refusal_code has no known code".into(),
                "It is read as not-drawn; write a code of the documentation",
            );
        }
        let detail = rows.text(Role::RefusalDetail, row).unwrap_or_default();
        refused.push(id, code.unwrap_or(Code::NotDrawn), detail);
    }
    Ok(())
}

/// Blocks under construction.
pub(super) struct BlockRows<'a> {
    rows: ElementRows<'a>,
    index: Option<usize>,
    /// Kinds and numbers of the members of each block.
    members: Vec<Vec<(Option<Element>, u32)>>,
}

impl<'a> BlockRows<'a> {
    pub(super) fn new(reading: Reading<'a>) -> Self {
        Self {
            rows: ElementRows::new(Element::Block, reading, &[]),
            index: reading.columns.get(Role::Members),
            members: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.rows.add(batch)?;
        let Some(index) = self.index else {
            self.members
                .resize(self.members.len() + batch.drawn_rows(), Vec::new());
            return Ok(());
        };
        let lists = ListArray::new(&batch.columns[index])?;
        let items = lists.items().as_struct();
        let field = |name: &str| {
            let field = items.column_by_name(name);
            field.ok_or_else(|| damaged(format!("column {MEMBERS}"), format!("{name} is missing")))
        };
        let kinds = TextArray::new(field(MEMBER_ELEMENT)?)?;
        let numbers = indices(field(MEMBER_INDEX)?)?;
        for row in batch.drawn.iter().cloned().flatten() {
            let range = lists.range(row).unwrap_or_default();
            let member = |at: usize| {
                let is_valid = items.is_valid(at) && numbers.is_valid(at);
                let kind = kinds.get(at).filter(|_| is_valid).and_then(Element::named);
                (kind, numbers.value(at))
            };
            self.members.push(range.map(member).collect());
        }
        Ok(())
    }

    /// Returns the blocks. The numberings have the rows of paths and nodes.
    pub(super) fn finish(
        self,
        (paths, nodes, stations): (&Numbering, &Numbering, usize),
        faults: &mut Faults<'_>,
    ) -> Result<Vec<Block>, Problem> {
        let rows = self.rows.finish(faults.diagnostics)?;
        let station = |number: u32| Some(number).filter(|&n| (n as usize) < stations);
        let known = |&(kind, number): &(Option<Element>, u32)| match kind? {
            Element::Path => paths.row(number).map(Member::Path),
            Element::Node => nodes.row(number).map(Member::Node),
            Element::Station => station(number).map(Member::Station),
            _ => None,
        };
        let mut blocks = Vec::with_capacity(rows.len());
        for (row, numbers) in self.members.into_iter().enumerate() {
            let members: Vec<Member> = numbers.iter().filter_map(known).collect();
            let id = rows.ids.get(row);
            let is_skipped = |&(kind, number): &(Option<Element>, u32)| match kind {
                Some(Element::Path) => paths.is_skipped(number),
                Some(Element::Node) => nodes.is_skipped(number),
                _ => false,
            };
            let skipped = numbers.iter().filter(|member| is_skipped(member)).count();
            let unknown = numbers.len() - skipped - members.len();
            if unknown > 0 {
                faults.report(
                    Code::UnknownValue,
                    Element::Block,
                    id,
                    || format!("{unknown} of its members are not in the table"),
                    "They are left out; write the kind (path, node or station) and the number of \
                     each member",
                );
            }
            blocks.push(Block {
                id: id.to_owned(),
                members,
                attributes: rows.attributes_of(row, faults.diagnostics)?,
            });
        }
        Ok(blocks)
    }
}

/// Zones under construction.
pub(super) struct ZoneRows<'a> {
    rows: ElementRows<'a>,
    levels: Option<LevelColumn<'a>>,
    index: Option<usize>,
    budget: &'a Budget,
    outlines: Vec<Vec<Point<f64>>>,
}

impl<'a> ZoneRows<'a> {
    pub(super) fn new(reading: Reading<'a>) -> Self {
        Self {
            rows: ElementRows::new(Element::Zone, reading, &[]),
            levels: LevelColumn::new(reading, 0),
            index: reading.columns.get(Role::Outline),
            budget: reading.budget,
            outlines: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.rows.add(batch)?;
        if let Some(levels) = &mut self.levels {
            levels.add(batch)?;
        }
        let Some(index) = self.index else {
            self.outlines
                .resize(self.outlines.len() + batch.drawn_rows(), Vec::new());
            return Ok(());
        };
        let lists = PointLists::new(&batch.columns[index], self.budget)?;
        let rows = batch.drawn.iter().cloned().flatten();
        self.outlines
            .extend(rows.map(|row| lists.get(row).collect()));
        Ok(())
    }

    /// Returns the zones.
    pub(super) fn finish(
        self,
        levels: &mut Levels,
        faults: &mut Faults<'_>,
    ) -> Result<Vec<Zone>, Problem> {
        let rows = self.rows.finish(faults.diagnostics)?;
        let of_zones = self.levels;
        let of_zones = of_zones.map(|column| column.finish(levels, "zones", faults.diagnostics));
        let mut zones = Vec::with_capacity(rows.len());
        for (row, mut outline_m) in self.outlines.into_iter().enumerate() {
            let id = rows.ids.get(row);
            let remedy = "The zone is read without an outline; correct its corners";
            let mut corners = outline_m.iter();
            if !corners.all(|&p| faults.point(Element::Zone, id, p, remedy).is_some()) {
                outline_m = Vec::new();
            }
            zones.push(Zone {
                id: id.to_owned(),
                outline_m,
                level: level_at(of_zones.as_ref(), row),
                attributes: rows.attributes_of(row, faults.diagnostics)?,
            });
        }
        Ok(zones)
    }
}
