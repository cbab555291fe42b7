//! Whole LIF files: writes the root, the levels and their arrays, one line per object.

use std::io::{self, Write};
use std::iter;

use guideway_layout::Layout;
use rayon::prelude::*;

use super::{Edges, Elements, Network, WriteOptions, add_lost, add_required};
use crate::Losses;
use crate::json::{Members, Tree};
use crate::lif::members::{META, OTHER};
use crate::lif::version::Version;
use crate::source::WrittenPaths;

/// Lines per task of a thread.
const TASK_LINES: usize = 1 << 8;

/// Tasks per batch, which bounds the text in memory.
const BATCH_TASKS: usize = 1 << 5;

/// Writes a layout as a whole file. Returns the losses.
///
/// # Errors
/// When `out` fails.
pub(super) fn write_file(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
    written_paths: &WrittenPaths<'_>,
) -> io::Result<Losses> {
    let mut losses = Losses::of_paths(layout, layout.refused.len());
    let network = Network::complete(layout, &mut losses);
    let edges = Edges::collect(layout, &mut losses);
    let elements = Elements::new(layout, &network, options.version);
    add_lost(&elements, &mut losses);
    add_required(&elements, &mut losses);
    let file = File {
        network: &network,
        edges: &edges,
        elements: &elements,
        written_paths,
    };
    file.write(out, options)?;
    Ok(losses)
}

/// Parts of a file.
struct File<'a> {
    network: &'a Network<'a>,
    edges: &'a Edges<'a>,
    elements: &'a Elements<'a>,
    written_paths: &'a WrittenPaths<'a>,
}

impl<'a> File<'a> {
    fn write<W: Write>(&self, out: &mut W, options: &WriteOptions) -> io::Result<()> {
        let version = options.version;
        open_object(out, &self.root(options))?;
        let levels = self.network.levels().count();
        match version {
            Version::V1 => write_array(out, "layouts", 0..levels, |level, out| {
                self.write_level(level, out)
            })?,
            Version::V2 => {
                let origins = self.origins(levels).into_iter();
                write_array(out, "origins", origins, |(origin, levels), out| {
                    open_object(out, &origin)?;
                    write_array(out, "layouts", levels.into_iter(), |level, out| {
                        self.write_level(level, out)
                    })?;
                    write!(out, "}}")
                })?;
            }
        }
        writeln!(out, "}}")
    }

    /// The root object without its levels.
    fn root(&self, options: &WriteOptions) -> Tree<'a> {
        let layout = self.elements.layout;
        let mut meta: Members<'a> = Vec::new();
        let columns = self.elements.row_columns(&layout.attributes, META);
        columns.add_to(&mut meta, 0, None);
        meta.retain(|(name, _)| name != "exportTimestamp" && name != "lifVersion");
        let project = options.version.pick("projectIdentification", "lifId");
        let creator = concat!("Guideway ", env!("CARGO_PKG_VERSION"));
        for (name, value) in [(project, source_name(layout)), ("creator", creator)] {
            if meta.iter().all(|(known, _)| known != name) {
                meta.push((name.into(), Tree::Text(value.into())));
            }
        }
        let exported = humantime::format_rfc3339_millis(options.exported).to_string();
        let version = options.version.stated();
        meta.push(("exportTimestamp".into(), Tree::Text(exported.into())));
        meta.push(("lifVersion".into(), Tree::Text(version.into())));
        let mut root = Tree::Object(vec![("metaInformation".into(), Tree::Object(meta))]);
        self.elements
            .merge_other(&mut root, &layout.attributes, 0, OTHER);
        root
    }

    /// The origins of a file, each with the indices of its levels.
    fn origins(&self, levels: usize) -> Vec<(Tree<'a>, Vec<usize>)> {
        let mut origins: Vec<(Tree<'a>, Vec<usize>)> = Vec::new();
        for level in 0..levels {
            let origin = self.elements.origin(level);
            match origins.iter_mut().find(|(known, _)| *known == origin) {
                Some((_, levels)) => levels.push(level),
                None => origins.push((origin, vec![level])),
            }
        }
        origins
    }

    fn write_level<W: Write>(&self, level: usize, out: &mut W) -> io::Result<()> {
        open_object(out, &self.elements.level(level))?;
        let nodes = self.network.nodes_on(level);
        write_lines(out, "nodes", nodes, |&node| self.elements.whole_node(node))?;
        let paths = self.network.paths_on(level);
        let paths = paths.inspect(|_| self.written_paths.count());
        let edges = paths.flat_map(|path| self.edges.of_path(path));
        write_lines(out, "edges", edges, |edge| self.elements.whole_edge(edge))?;
        let stations = self.network.stations_on(level);
        write_lines(out, "stations", stations, |&station| {
            self.elements.station(station)
        })?;
        write!(out, "}}")
    }
}

/// Writes the members of an object without its closing brace.
fn open_object(out: &mut impl Write, object: &Tree<'_>) -> io::Result<()> {
    let text = object.to_text();
    write!(out, "{}", text.strip_suffix('}').unwrap_or(&text))
}

/// Writes a member `name` with an array, after other members.
fn write_array<T, W: Write>(
    out: &mut W,
    name: &str,
    items: impl Iterator<Item = T>,
    mut write_item: impl FnMut(T, &mut W) -> io::Result<()>,
) -> io::Result<()> {
    write!(out, ",\n\"{name}\": [")?;
    for (i, item) in items.enumerate() {
        writeln!(out, "{}", if i == 0 { "" } else { "," })?;
        write_item(item, out)?;
    }
    write!(out, "]")
}

/// Writes a member `name` with an array of one line per item, formatted on several threads.
fn write_lines<'t, T: Send + Sync, W: Write>(
    out: &mut W,
    name: &str,
    mut items: impl Iterator<Item = T>,
    object: impl Fn(&T) -> Tree<'t> + Sync,
) -> io::Result<()> {
    let lines = |items: &[T]| {
        let mut text = Vec::new();
        for (i, item) in items.iter().enumerate() {
            text.extend_from_slice(if i == 0 { b"" } else { b",\n" });
            object(item).write(&mut text);
        }
        text
    };
    let batches = iter::from_fn(|| {
        let batch: Vec<T> = items.by_ref().take(BATCH_TASKS * TASK_LINES).collect();
        (!batch.is_empty()).then_some(batch)
    });
    let texts =
        batches.flat_map(|batch| batch.par_chunks(TASK_LINES).map(lines).collect::<Vec<_>>());
    write_array(out, name, texts, |text, out| out.write_all(&text))
}

/// Returns the name of the source file, for the project identifier.
fn source_name(layout: &Layout) -> &str {
    let source = &layout.provenance.source;
    source.rsplit(['/', '\\']).next().unwrap_or(source)
}
