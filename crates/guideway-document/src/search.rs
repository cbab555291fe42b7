use guideway_layout::Layout;

/// What has a name that was looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// A path, by its row.
    Path(u32),
    /// A node, by its row.
    Node(u32),
    /// A station, by its row.
    Station(u32),
}

/// Number of rows, and what a row is.
type Table = (usize, fn(u32) -> Element);

/// Paths, nodes and stations whose identifier contains `text`, whatever the case: those that are called
/// exactly so first; at most `most` of each table, and as many again that are called exactly so.
pub fn search(layout: &Layout, text: &str, most: usize) -> Vec<Element> {
    if text.is_empty() {
        return Vec::new();
    }
    let wanted = text.to_lowercase();
    let tables: [Table; 3] = [
        (layout.nodes.len(), Element::Node),
        (layout.stations.len(), Element::Station),
        (layout.paths.len(), Element::Path),
    ];
    let rows = tables.map(|(count, of)| (0..count as u32).map(of));
    let is_exact = |what: &Element| what.id(layout) == text;
    let is_like = |what: &Element| what.id(layout).to_lowercase().contains(&wanted);
    let exact = rows
        .clone()
        .into_iter()
        .flat_map(|all| all.filter(is_exact).take(most));
    let mut found: Vec<Element> = exact.collect();
    for all in rows {
        found.extend(
            all.filter(|what| is_like(what) && !is_exact(what))
                .take(most),
        );
    }
    found
}

impl Element {
    /// Its identifier.
    pub fn id(self, layout: &Layout) -> &str {
        match self {
            Self::Path(row) => layout.paths.id(row as usize),
            Self::Node(row) => layout.nodes.id(row),
            Self::Station(row) => layout.stations.id(row),
        }
    }
}
