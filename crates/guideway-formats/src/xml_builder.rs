//! Fills a layout from an XML document: a [`Builder`] that reports findings at elements.

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;

use crate::ReadError;
use crate::builder::Builder;
use crate::source::Source;
use crate::xml::Xml;

/// A layout builder and the document that it reads.
pub(crate) struct XmlBuilder<'a, 'd, 't> {
    pub(crate) builder: Builder<'a>,
    pub(crate) xml: &'d Xml<'t>,
}

impl<'a, 'd, 't> XmlBuilder<'a, 'd, 't> {
    pub(crate) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            xml,
        }
    }

    /// Records a finding at an element.
    pub(crate) fn report(
        &mut self,
        code: Code,
        node: Node<'d, 't>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let xml = self.xml;
        self.builder
            .report(code, &|| xml.place(node), message, remedy);
    }

    /// Records an element that cannot be drawn, with a finding.
    pub(crate) fn refuse(
        &mut self,
        id: &str,
        code: Code,
        node: Node<'d, 't>,
        detail: &str,
        remedy: &str,
    ) -> Result<(), ReadError> {
        let xml = self.xml;
        let at = || xml.place(node);
        self.builder.refuse_at(id, code, detail, &at, remedy)
    }

    /// Tells if a point can be drawn. Records a finding at an element if not.
    pub(crate) fn check_point(&mut self, point: Point<f64>, node: Node<'d, 't>) -> bool {
        let xml = self.xml;
        self.builder.check_point(point, &|| xml.place(node))
    }
}
