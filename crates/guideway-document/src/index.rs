use guideway_layout::{Layout, PathRef};
use guideway_spline::{Bounds, Point};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

type Corner = [f64; 2];
pub(crate) type PathBox = GeomWithData<Rectangle<Corner>, u32>;
pub(crate) type NodePoint = GeomWithData<Corner, u32>;

/// Where the paths and nodes of a layout are, to find those near a place without looking at all.
///
/// Rows are those of the layout it was made of. Paths are held by the box of their curve.
#[derive(Clone, Debug, Default)]
pub struct Index {
    paths: RTree<PathBox>,
    nodes: RTree<NodePoint>,
}

impl Index {
    /// The index of a whole layout.
    pub fn new(layout: &Layout) -> Self {
        let nodes = &layout.nodes;
        let node = |node| node_entry(node, nodes.position_m(node));
        Self {
            paths: RTree::bulk_load(layout.paths.iter().filter_map(path_box).collect()),
            nodes: RTree::bulk_load((0..nodes.len() as u32).map(node).collect()),
        }
    }

    /// Puts paths to their new places, among them rows that are new. `old` is what [`path_boxes`] said before.
    pub(crate) fn update(&mut self, old: Vec<PathBox>, changed: &[u32], layout: &Layout) {
        // Beyond this many it takes longer to move entries one by one than to begin anew.
        if changed.len() > self.paths.size() / 8 + 1 {
            let paths = layout.paths.iter().filter_map(path_box).collect();
            self.paths = RTree::bulk_load(paths);
            return;
        }
        for entry in old {
            self.paths.remove(&entry);
        }
        for entry in path_boxes(layout, changed.iter().copied()) {
            self.paths.insert(entry);
        }
    }

    pub(crate) fn move_node(&mut self, old: &NodePoint, new: NodePoint) {
        self.nodes.remove(old);
        self.nodes.insert(new);
    }

    /// Paths whose box meets `bounds`, in no order.
    pub fn paths_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        let found = self.paths.locate_in_envelope_intersecting(envelope(bounds));
        found.map(|path| path.data)
    }

    /// The same, with their boxes.
    pub fn boxes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = (u32, Bounds<f64>)> {
        let found = self.paths.locate_in_envelope_intersecting(envelope(bounds));
        let point = |[x, y]: Corner| Point::new(x, y);
        found.map(move |path| {
            let bounds = Bounds {
                min: point(path.geom().lower()),
                max: point(path.geom().upper()),
            };
            (path.data, bounds)
        })
    }

    /// Nodes inside `bounds`, in no order.
    pub fn nodes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        let found = self.nodes.locate_in_envelope(envelope(bounds));
        found.map(|node| node.data)
    }
}

/// The box of a path's curve; none if it has no curve.
pub(crate) fn curve_bounds(path: PathRef<'_>) -> Option<Bounds<f64>> {
    path.runs()
        .flat_map(|run| run.segments())
        .map(|segment| Bounds::of_segment(&segment))
        .reduce(Bounds::union)
}

/// The entries of some paths.
pub(crate) fn path_boxes(layout: &Layout, paths: impl Iterator<Item = u32>) -> Vec<PathBox> {
    paths
        .filter_map(|path| path_box(layout.paths.get(path as usize)))
        .collect()
}

/// The entry of a node.
pub(crate) fn node_entry(node: u32, at_m: Point<f64>) -> NodePoint {
    NodePoint::new(corner(at_m), node)
}

fn path_box(path: PathRef<'_>) -> Option<PathBox> {
    let Bounds { min, max } = curve_bounds(path)?;
    let rectangle = Rectangle::from_corners(corner(min), corner(max));
    Some(PathBox::new(rectangle, path.row() as u32))
}

fn corner(point: Point<f64>) -> Corner {
    [point.x, point.y]
}

fn envelope(bounds: Bounds<f64>) -> AABB<Corner> {
    AABB::from_corners(corner(bounds.min), corner(bounds.max))
}
