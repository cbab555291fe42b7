//! Fills a layout from an XML document: a [`Builder`] that reports findings at elements.

use guideway_layout::{Code, NewPath};
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
    /// Elements are only measured, so [`Self::report`] records nothing.
    pub(crate) is_silent: bool,
}

impl<'a, 'd, 't> XmlBuilder<'a, 'd, 't> {
    pub(crate) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            xml,
            is_silent: false,
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
        if !self.is_silent {
            self.builder
                .report(code, &|| xml.place(node), message, remedy);
        }
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

    /// Records the parts of the document that are in other files, which are not read: `include` of
    /// XInclude, and that of OpenDRIVE.
    ///
    /// # Errors
    /// When the layout would exceed a limit, or the caller cancels the read.
    pub(crate) fn refuse_includes(&mut self) -> Result<(), ReadError> {
        const XINCLUDE: &str = "http://www.w3.org/2001/XInclude";
        let xml = self.xml;
        let nodes = xml.root().descendants();
        for node in nodes.filter(|node| node.tag_name().name() == "include") {
            let key = match node.tag_name().namespace() {
                Some(XINCLUDE) => "href",
                _ => "file",
            };
            let Some(file) = node.attribute(key) else {
                continue;
            };
            let id = format!("include {file}");
            self.builder.check_text(&id)?;
            let detail = format!("the included file `{file}` is not in this one");
            let remedy = "It is left out; put its content in the place of the element";
            self.refuse(&id, Code::UnknownValue, node, &detail, remedy)?;
        }
        Ok(())
    }

    /// Appends the path of an element, with its line, and returns its row.
    ///
    /// # Errors
    /// When the layout would exceed a limit, or the caller cancels the read; as the others here.
    pub(crate) fn push_path(
        &mut self,
        node: Node<'d, 't>,
        path: &NewPath<'_>,
    ) -> Result<usize, ReadError> {
        let row = self.builder.push_path(path)?;
        let source = &mut self.builder.layout.paths.source;
        source.set_position(row, self.xml.position(node));
        Ok(row)
    }

    /// Appends the node of an element, with its line, and returns its row.
    pub(crate) fn push_node(
        &mut self,
        node: Node<'d, 't>,
        id: &str,
        position_m: Point<f64>,
    ) -> Result<u32, ReadError> {
        let row = self.builder.push_node(id, position_m, None)?;
        let source = &mut self.builder.layout.nodes.source;
        source.set_position(row as usize, self.xml.position(node));
        Ok(row)
    }

    /// Appends the station of an element, with its line, and returns its row.
    pub(crate) fn push_station(
        &mut self,
        node: Node<'d, 't>,
        id: &str,
        position_m: Option<Point<f64>>,
        nodes: Vec<u32>,
    ) -> Result<u32, ReadError> {
        let row = self.builder.push_station(id, position_m, nodes, None)?;
        let source = &mut self.builder.layout.stations.source;
        source.set_position(row as usize, self.xml.position(node));
        Ok(row)
    }

    /// Tells if a point can be drawn. Records a finding at an element if not.
    pub(crate) fn check_point(&mut self, point: Point<f64>, node: Node<'d, 't>) -> bool {
        let xml = self.xml;
        self.builder.check_point(point, &|| xml.place(node))
    }
}
