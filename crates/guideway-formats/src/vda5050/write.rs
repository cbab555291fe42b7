//! VDA 5050 writer: writes the paths of a layout as one order, one line per node and edge.

use std::io::{self, Write};
use std::time::SystemTime;

use guideway_layout::Layout;

use super::objects::Objects;
use super::route::Route;
use super::version::Version;
use super::write_losses::losses;
use crate::finite::check_finite;
use crate::json::Tree;
use crate::{Losses, WriteProblem};

/// Options of the writer.
#[derive(Clone, Copy, Debug)]
pub struct WriteOptions {
    /// Version to write.
    pub version: Version,
    /// Time of the export, for the `timestamp` of a new order.
    pub exported: SystemTime,
}

/// Writes the paths of a layout as the route of an order. Returns the losses.
///
/// The paths must form one walk from node to node, in the order of their `sequenceId` or of the
/// table. An order that was read is written with all of its members.
///
/// # Errors
/// When the paths do not form one walk, or when `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> Result<Losses, WriteProblem> {
    check_finite(layout)?;
    let route = Route::of(layout, options.version)?;
    let mut objects = Objects::new(layout, &route, options.version);
    write_order(&mut objects, out, options.exported)?;
    Ok(losses(&objects))
}

fn write_order(
    objects: &mut Objects<'_, '_>,
    out: &mut impl Write,
    exported: SystemTime,
) -> io::Result<()> {
    writeln!(out, "{{")?;
    for (name, value) in objects.header(exported) {
        let name = Tree::Text(name).to_text();
        writeln!(out, "  {name}: {},", value.to_text())?;
    }
    let lists = [
        ("nodes", objects.nodes(), ","),
        ("edges", objects.edges(), ""),
    ];
    for (name, lines, end) in lists {
        let lines = lines.join(",\n    ");
        match lines.is_empty() {
            true => writeln!(out, "  \"{name}\": []{end}")?,
            false => writeln!(out, "  \"{name}\": [\n    {lines}\n  ]{end}")?,
        }
    }
    writeln!(out, "}}")
}
