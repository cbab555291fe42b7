//! Reads attributes of OpenDRIVE elements, and counts geometries and lanes for the provenance.

use std::collections::HashMap;

use guideway_layout::{Code, Place};
use guideway_spline::Point;
use roxmltree::{Node, NodeId};

use crate::ReadError;
use crate::source::Source;
use crate::xml::Xml;
use crate::xml_builder::XmlBuilder;

/// The layout under construction, and counts of what was read.
pub(super) struct DocumentReader<'a, 'd, 't> {
    pub(super) base: XmlBuilder<'a, 'd, 't>,
    /// Number of plan view geometries per shape.
    pub(super) shape_counts: [(&'static str, u64); 5],
    pub(super) lane_count: u64,
    /// Index of each lane section of the current road, in the order of their start.
    section_indices: HashMap<NodeId, usize>,
}

impl<'a, 'd, 't> DocumentReader<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        let shapes = ["line", "arc", "spiral", "poly3", "paramPoly3"];
        Self {
            base: XmlBuilder::new(source, xml, file_bytes),
            shape_counts: shapes.map(|name| (name, 0)),
            lane_count: 0,
            section_indices: HashMap::new(),
        }
    }

    /// A finite number in an attribute. Reports a finding if there is none.
    pub(super) fn number(&mut self, node: Node<'d, 't>, key: &'static str) -> Option<f64> {
        let text = node.attribute(key);
        let number = text.and_then(|text| text.trim().parse::<f64>().ok());
        if let Some(number) = number.filter(|n| n.is_finite()) {
            return Some(number);
        }
        let (code, message) = match text {
            None => (
                Code::MissingField,
                format!("the attribute `{key}` is missing"),
            ),
            Some(text) => (Code::WrongType, {
                let start: String = text.chars().take(40).collect();
                format!("`{key}` is \"{start}\", expected a finite number")
            }),
        };
        let remedy = "The curve that depends on it is left out; correct the number";
        self.report(code, node, || message, remedy);
        None
    }

    /// Sets the lane sections of the current road, sorted by their start.
    pub(super) fn set_sections(&mut self, sections: &[Node<'d, 't>]) {
        let ids = sections.iter().map(|section| section.id());
        self.section_indices = ids.zip(0..).collect();
    }

    /// Records a finding at an element of a road.
    pub(super) fn report(
        &mut self,
        code: Code,
        node: Node<'d, 't>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let (xml, indices) = (self.base.xml, &self.section_indices);
        let at = || place(xml, indices, node);
        self.base.builder.report(code, &at, message, remedy);
    }

    /// Returns whether a point can be drawn. Records a finding at an element of a road if not.
    pub(super) fn check_point(&mut self, point: Point<f64>, node: Node<'d, 't>) -> bool {
        let (xml, indices) = (self.base.xml, &self.section_indices);
        let at = || place(xml, indices, node);
        self.base.builder.check_point(point, &at)
    }

    /// Records a lane without a valid `id` as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn refuse_lane(&mut self, lane: Node<'d, 't>) -> Result<(), ReadError> {
        self.lane_count += 1;
        let detail = "its `id` is not an integer";
        let remedy = "It is left out; correct the file";
        let id = place(self.base.xml, &self.section_indices, lane).element;
        self.refuse(&id, Code::MissingField, lane, detail, remedy)
    }

    /// Records an element of a road that cannot be drawn, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn refuse(
        &mut self,
        id: &str,
        code: Code,
        node: Node<'d, 't>,
        detail: &str,
        remedy: &str,
    ) -> Result<(), ReadError> {
        let (xml, indices) = (self.base.xml, &self.section_indices);
        let at = || place(xml, indices, node);
        self.base.builder.refuse_at(id, code, detail, &at, remedy)
    }
}

/// The place of an element: its road, its lane as `road.section.lane`, and its line.
fn place(xml: &Xml<'_>, indices: &HashMap<NodeId, usize>, node: Node<'_, '_>) -> Place {
    let around = |tag| node.ancestors().find(|around| around.has_tag_name(tag));
    let id = |node: Node<'_, '_>| node.attribute("id").unwrap_or("?").to_owned();
    let Some(road) = around("road") else {
        return xml.place(node);
    };
    let owner = match (around("lane"), around("laneSection")) {
        (Some(lane), Some(section)) => {
            let section = indices.get(&section.id()).copied().unwrap_or_default();
            (
                lane,
                format!("lane \"{}.{section}.{}\"", id(road), id(lane)),
            )
        }
        _ => (road, format!("road \"{}\"", id(road))),
    };
    let element = match owner {
        (owner, name) if owner == node => name,
        (_, name) => format!("{} of {name}", node.tag_name().name()),
    };
    Place::element(element).at(xml.position(node))
}

/// The start of a section along its road; 0 if it states no number.
pub(super) fn start_m(section: Node<'_, '_>) -> f64 {
    let text = section.attribute("s").unwrap_or_default();
    let number = text.trim().parse::<f64>().ok();
    number.filter(|number| number.is_finite()).unwrap_or(0.0)
}
