use guideway_layout::{Layout, PathRef};
use guideway_spline::{Bounds, Point};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

type Corner = [f64; 2];
type PathBox = GeomWithData<Rectangle<Corner>, u32>;
type NodePoint = GeomWithData<Corner, u32>;

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
        let paths = layout.paths.iter().filter_map(path_box).collect();
        let nodes = &layout.nodes;
        let points = (0..nodes.len() as u32)
            .map(|node| NodePoint::new(corner(nodes.position_m(node)), node))
            .collect();
        Self {
            paths: RTree::bulk_load(paths),
            nodes: RTree::bulk_load(points),
        }
    }

    /// Paths whose box meets `bounds`, in no order.
    pub fn paths_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        let found = self.paths.locate_in_envelope_intersecting(envelope(bounds));
        found.map(|path| path.data)
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
