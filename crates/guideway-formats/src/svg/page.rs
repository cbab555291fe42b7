//! Reads the size of the page, and notes where the size of a pixel is assumed.

use guideway_layout::Code;
use roxmltree::Node;

use super::length::is_physical;
use super::viewport::Viewport;
use crate::xml_builder::XmlBuilder;

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const SODIPODI: &str = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd";

/// Page size without `width`, `height` and `viewBox`, in pixels: the default of browsers.
pub(super) const DEFAULT_PAGE_PX: [f64; 2] = [300.0, 150.0];

/// The first version of Inkscape with 96 pixels per inch, major and minor; older ones have 90.
const FIRST_WITH_96_PX: [u32; 2] = [0, 92];

/// The page size in pixels. Reports a finding if the size has no physical unit, or if the program
/// that wrote the drawing had larger pixels.
pub(super) fn page_size<'d, 't>(
    base: &mut XmlBuilder<'_, 'd, 't>,
    root: Node<'d, 't>,
) -> [Option<f64>; 2] {
    let attributes = ["width", "height"].map(|name| root.attribute(name));
    // Percentages refer to the window of a browser, so they give no size.
    let page = Viewport::new(f64::NAN, f64::NAN);
    let size = attributes.map(|text| {
        let pixels = page.length(text?, Viewport::width)?;
        (pixels > 0.0).then_some(pixels)
    });
    let is_sized = attributes.iter().flatten().any(|text| is_physical(text));
    let old = old_inkscape(root);
    // A physical size and a view box fix the scale, however large a pixel is.
    let remedy = "If that is wrong, give the page its size, such as width=\"210mm\", and a viewBox";
    if let Some(version) = old.filter(|_| !is_sized || !root.has_attribute("viewBox")) {
        let message = || {
            format!(
                "Inkscape {version} took a pixel as 1/90 inch; it is read as 1/96 inch (CSS), so \
                 the drawing may have to be 6.7 % larger"
            )
        };
        base.report(Code::AssumedUnit, root, message, remedy);
    } else if !is_sized {
        let message = || {
            "the page has no width or height in mm, cm or in; a pixel is read as 1/96 inch (CSS)"
                .to_owned()
        };
        let remedy = "If that is wrong, give the page its size, such as width=\"210mm\"";
        base.report(Code::AssumedUnit, root, message, remedy);
    }
    size
}

/// The version of an Inkscape or Sodipodi that had 90 pixels per inch, if one wrote the drawing.
fn old_inkscape<'d>(root: Node<'d, '_>) -> Option<&'d str> {
    let version = root.attribute((INKSCAPE, "version"));
    let version = version.or(root.attribute((SODIPODI, "version")))?;
    let number = version.split_ascii_whitespace().next()?;
    let mut parts = number
        .split(['.', '+', '-'])
        .map(|part| part.parse::<u32>().ok());
    let found = [parts.next()??, parts.next()??];
    (found < FIRST_WITH_96_PX).then_some(number)
}
