//! Reads attributes of OpenDRIVE elements, and counts geometries and lanes for the provenance.

use guideway_layout::Code;
use roxmltree::Node;

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
}

impl<'a, 'd, 't> DocumentReader<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        let shapes = ["line", "arc", "spiral", "poly3", "paramPoly3"];
        Self {
            base: XmlBuilder::new(source, xml, file_bytes),
            shape_counts: shapes.map(|name| (name, 0)),
            lane_count: 0,
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
        self.base.report(code, node, || message, remedy);
        None
    }

    /// Records a lane without a valid `id` as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn refuse_lane(&mut self, lane: Node<'d, 't>) -> Result<(), ReadError> {
        self.lane_count += 1;
        let detail = "its `id` is not an integer";
        let remedy = "It is left out; correct the file";
        let id = self.base.xml.place(lane).to_string();
        self.base
            .refuse(&id, Code::MissingField, lane, detail, remedy)
    }
}
