use guideway_layout::{Attribute, Attributes, Layout, NewPath, Nodes, Paths, Value, Values};

use crate::Document;

impl Document {
    /// The layout as it is now: removed paths left out, moved nodes at their places, rows numbered anew.
    pub fn to_layout(&self) -> Layout {
        let old = self.layout();
        Layout {
            provenance: old.provenance.clone(),
            paths: self.paths_now(),
            refused: old.refused.clone(),
            nodes: self.nodes_now(),
            stations: old.stations.clone(),
            levels: old.levels.clone(),
            diagnostics: old.diagnostics.clone(),
        }
    }

    fn paths_now(&self) -> Paths {
        let old = &self.layout().paths;
        let rows: Vec<usize> = self.existing_paths().map(|path| path.row()).collect();
        if rows.len() == old.len() && self.origins.is_empty() {
            return old.clone();
        }
        let mut paths = Paths::default();
        let mut runs = guideway_spline::Runs::default();
        for path in self.existing_paths() {
            runs.clear();
            for run in path.runs() {
                runs.push(&run.iter().collect::<Vec<_>>());
            }
            let types: Vec<&str> = old.vehicle_types().of(path.row()).collect();
            paths.push(&NewPath {
                id: path.id(),
                runs: &runs,
                start_node: path.start_node(),
                end_node: path.end_node(),
                direction: path.direction(),
                level: path.level(),
                vehicle_types: &types,
            });
        }
        if let Some(width_m) = old.width_m() {
            paths.set_width_m(rows.iter().map(|&row| width_m[row]).collect());
        }
        if let Some(color) = old.color_rgba() {
            paths.set_color_rgba(rows.iter().map(|&row| color[row]).collect());
        }
        if let Some(rank) = old.rank() {
            paths.set_rank(rows.iter().map(|&row| rank[row]).collect());
        }
        paths.attributes = self.attributes_now(&rows);
        paths
    }

    fn attributes_now(&self, rows: &[usize]) -> Attributes {
        let sources: Vec<usize> = rows
            .iter()
            .map(|&row| self.attribute_row(row as u32) as usize)
            .collect();
        let mut attributes = Attributes::default();
        for column in self.layout().paths.attributes.iter() {
            attributes.insert(Attribute {
                values: chosen(&column.values, &sources),
                ..column.clone()
            });
        }
        attributes
    }

    fn nodes_now(&self) -> Nodes {
        let old = &self.layout().nodes;
        if self.moved_nodes.is_empty() {
            return old.clone();
        }
        let mut nodes = Nodes::default();
        for node in 0..old.len() as u32 {
            nodes.push(old.id(node), self.node_position_m(node), old.level(node));
        }
        nodes.attributes = old.attributes.clone();
        nodes
    }
}

/// The values of some rows, in this order.
fn chosen(values: &Values, rows: &[usize]) -> Values {
    fn pick<T: Copy>(column: &[Option<T>], rows: &[usize]) -> Vec<Option<T>> {
        rows.iter()
            .map(|&row| column.get(row).copied().flatten())
            .collect()
    }
    match values {
        Values::Bool(column) => Values::Bool(pick(column, rows)),
        Values::Int(column) => Values::Int(pick(column, rows)),
        Values::Float(column) => Values::Float(pick(column, rows)),
        Values::Text { .. } => {
            let text = |&row: &usize| match values.get(row) {
                Some(Value::Text(text)) => Some(text),
                _ => None,
            };
            Values::Text {
                text: rows.iter().map(|row| text(row).unwrap_or("")).collect(),
                present: rows.iter().map(|row| text(row).is_some()).collect(),
            }
        }
    }
}
