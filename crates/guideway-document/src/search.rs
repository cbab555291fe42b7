use guideway_layout::Layout;

/// What has a name that was looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// A path, by its row.
    Path(u32),
    /// A node, by its row.
    Node(u32),
    /// A station, by its row.
    Station(u32),
}

/// Paths, nodes and stations whose identifier contains `text`, whatever the case: those that are called
/// exactly so first, at most `most` of each.
pub fn search(layout: &Layout, text: &str, most: usize) -> Vec<Found> {
    if text.is_empty() {
        return Vec::new();
    }
    let wanted = text.to_lowercase();
    let mut found = Vec::new();
    let mut look = |count: usize, id: &dyn Fn(u32) -> String, of: fn(u32) -> Found| {
        let rows = (0..count as u32).filter(|&row| id(row).to_lowercase().contains(&wanted));
        found.extend(rows.take(most).map(of));
    };
    let Layout {
        paths,
        nodes,
        stations,
        ..
    } = layout;
    look(nodes.len(), &|row| nodes.id(row).to_owned(), Found::Node);
    look(
        stations.len(),
        &|row| stations.id(row).to_owned(),
        Found::Station,
    );
    look(
        paths.len(),
        &|row| paths.id(row as usize).to_owned(),
        Found::Path,
    );
    found.sort_by_key(|what| what.id(layout) != text);
    found
}

impl Found {
    /// Its identifier.
    pub fn id(self, layout: &Layout) -> &str {
        match self {
            Self::Path(row) => layout.paths.id(row as usize),
            Self::Node(row) => layout.nodes.id(row),
            Self::Station(row) => layout.stations.id(row),
        }
    }
}
