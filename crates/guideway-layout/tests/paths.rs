//! Properties of single paths: columns appear with the first value that needs them.

use guideway_layout::{Direction, NewPath, PathRef, Paths};

#[test]
fn properties_of_later_paths_leave_earlier_ones_unset() {
    let mut paths = Paths::default();
    paths.push(&NewPath::default());
    paths.push(&NewPath {
        end_node: Some(3),
        direction: Direction::Both,
        level: Some(1),
        ..NewPath::default()
    });
    paths.push(&NewPath::default());
    let indices = |path: PathRef| (path.start_node(), path.end_node(), path.level());
    let (none, some) = ((None, None, None), (None, Some(3), Some(1)));
    assert!(paths.iter().map(indices).eq([none, some, none]));
    let directions = [Direction::Forward, Direction::Both, Direction::Forward];
    assert!(paths.iter().map(PathRef::direction).eq(directions));
}
