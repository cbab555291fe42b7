//! Wall lines of a map: the outlines of its occupied cells, as paths of a layout.

use guideway_layout::{Layout, NewPath, Place};
use guideway_spline::{Affine, Point, Runs};

use super::grid::{OCCUPIED, OccupancyGrid};
use crate::{Problem, ReadError};

/// Most wall lines of a map. Derived: a line takes about 150 bytes with its spatial index, 600 MB
/// in all. A map of a hall of 200 m x 200 m at 5 cm has some 100,000.
const MAX_LINES: usize = 1 << 22;

/// Identifier of the path that covers the inside of walls that are thick.
const INSIDE: &str = "inside of walls";

impl OccupancyGrid {
    /// The walls: a path along each outline of occupied cells, around them or around a hole in
    /// them. One more path, `inside of walls`, has a line through each row of cells that are
    /// occupied on all sides, so that a vehicle within a thick wall, larger than a cell, meets a
    /// line too.
    ///
    /// Cells that touch only at a corner have outlines of their own. Cells that are unknown or
    /// partly occupied are no walls.
    ///
    /// # Errors
    /// When the walls have more than four million lines.
    pub fn walls(&self) -> Result<Layout, ReadError> {
        self.walls_within(MAX_LINES)
    }

    fn walls_within(&self, max_lines: usize) -> Result<Layout, ReadError> {
        let mut outlines = Outlines {
            grid: self,
            world: self.placement.world_from_image(self.height),
            seen: vec![false; self.cells.len()],
            lines: 0,
            max_lines,
        };
        let layout = outlines.layout();
        layout.map_err(|problem| ReadError::new(&self.name, problem))
    }

    /// Whether the cell exists and is occupied.
    fn is_wall(&self, x: i64, y: i64) -> bool {
        let is_inside = (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y);
        is_inside && self.cells[y as usize * self.width + x as usize] == OCCUPIED
    }

    /// Whether the cell and its four neighbors are occupied.
    fn is_deep(&self, x: i64, y: i64) -> bool {
        let cells = [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)];
        cells.iter().all(|(i, j)| self.is_wall(x + i, y + j))
    }
}

/// Follows the outlines of a grid.
struct Outlines<'g> {
    grid: &'g OccupancyGrid,
    /// Maps corners of cells, y down, to meters.
    world: Affine,
    /// Per cell: whether its upper side is part of an outline that was followed.
    seen: Vec<bool>,
    /// Number of lines so far.
    lines: usize,
    max_lines: usize,
}

/// A corner of cells, and a step to a neighboring one; y down.
type Corner = (i64, i64);

impl Outlines<'_> {
    fn layout(&mut self) -> Result<Layout, Problem> {
        let mut layout = Layout::default();
        layout.provenance.format = "ROS map".into();
        for y in 0..self.grid.height as i64 {
            for x in 0..self.grid.width as i64 {
                let is_start = self.grid.is_wall(x, y) && !self.grid.is_wall(x, y - 1);
                if !is_start || self.seen[self.cell(x, y)] {
                    continue;
                }
                let runs = self.outline((x, y))?;
                let id = format!("wall {}", layout.paths.len() + 1);
                push(&mut layout, &id, &runs);
            }
        }
        let inside = self.inside()?;
        if !inside.is_empty() {
            push(&mut layout, INSIDE, &inside);
        }
        Ok(layout)
    }

    fn cell(&self, x: i64, y: i64) -> usize {
        y as usize * self.grid.width + x as usize
    }

    /// The outline through the upper side of a cell, with walls on its right hand.
    fn outline(&mut self, start: Corner) -> Result<Runs, Problem> {
        let mut runs = Runs::default();
        let ((mut x, mut y), mut step) = (start, (1, 0));
        let mut last = start;
        loop {
            if step == (1, 0) {
                let cell = self.cell(x, y);
                self.seen[cell] = true;
            }
            (x, y) = (x + step.0, y + step.1);
            let next = self.turn((x, y), step);
            let is_closed = (x, y) == start && next == (1, 0);
            if next != step || is_closed {
                self.push_line(&mut runs, last, (x, y))?;
                last = (x, y);
            }
            if is_closed {
                return Ok(runs);
            }
            step = next;
        }
    }

    /// The next step of an outline: to the right where no wall is ahead on the right hand, to the
    /// left where walls are ahead on both hands, else ahead.
    fn turn(&self, (x, y): Corner, step: Corner) -> Corner {
        // The cells ahead of a corner lie on both sides of the step.
        let (right, left) = match step {
            (1, 0) => ((x, y), (x, y - 1)),
            (0, 1) => ((x - 1, y), (x, y)),
            (-1, 0) => ((x - 1, y - 1), (x - 1, y)),
            _ => ((x, y - 1), (x - 1, y - 1)),
        };
        if !self.grid.is_wall(right.0, right.1) {
            (-step.1, step.0)
        } else if self.grid.is_wall(left.0, left.1) {
            (step.1, -step.0)
        } else {
            step
        }
    }

    /// Lines through the centers of rows of deep cells.
    fn inside(&mut self) -> Result<Runs, Problem> {
        let mut runs = Runs::default();
        for y in 0..self.grid.height as i64 {
            let mut x = 0;
            while x < self.grid.width as i64 {
                let first = x;
                while self.grid.is_deep(x, y) {
                    x += 1;
                }
                if x > first {
                    self.count_line()?;
                    let middle = y as f64 + 0.5;
                    let ends = [first as f64, x as f64].map(|x| Point::new(x, middle));
                    let [from, to] = ends.map(|end| self.world.apply(end));
                    runs.push_line(from, to);
                }
                x += 1;
            }
        }
        Ok(runs)
    }

    fn push_line(&mut self, runs: &mut Runs, from: Corner, to: Corner) -> Result<(), Problem> {
        self.count_line()?;
        let [from, to] = [from, to].map(|(x, y)| self.world.apply(Point::new(x as f64, y as f64)));
        runs.push_line(from, to);
        Ok(())
    }

    fn count_line(&mut self) -> Result<(), Problem> {
        self.lines += 1;
        if self.lines <= self.max_lines {
            return Ok(());
        }
        Err(Problem::InvalidValue {
            place: Place::element("walls"),
            detail: format!(
                "the outlines of the walls have more lines than the limit of {}",
                self.max_lines
            ),
            remedy: "Remove noise from the map, cut it to the part that matters, or reduce its \
                     resolution"
                .into(),
        })
    }
}

fn push(layout: &mut Layout, id: &str, runs: &Runs) {
    layout.paths.push(&NewPath {
        id,
        runs,
        ..NewPath::default()
    });
}

#[cfg(test)]
mod tests {
    use guideway_layout::RunPoints;
    use guideway_spline::Bounds;

    use super::*;
    use crate::raster::ImagePlacement;

    /// A grid of 1 m cells, `#` for walls, whose lower left corner is the origin.
    fn grid(rows: &[&str]) -> OccupancyGrid {
        let cell = |c: u8| if c == b'#' { OCCUPIED } else { 0 };
        OccupancyGrid {
            name: "hall.yaml".into(),
            image: "hall.pgm".into(),
            width: rows[0].len(),
            height: rows.len(),
            cells: rows.iter().flat_map(|row| row.bytes().map(cell)).collect(),
            placement: ImagePlacement {
                px_per_m: 1.0,
                rotate_deg: 0.0,
                offset_m: Point::default(),
            },
        }
    }

    /// Length of a straight run: that between its two middle control points.
    fn length_m(run: RunPoints<'_>) -> f64 {
        match run {
            RunPoints::F64(&[_, from, to, _]) => from.distance(to),
            _ => f64::NAN,
        }
    }

    /// Identifier, number of lines and length of each path.
    fn walls(rows: &[&str]) -> Vec<(String, usize, f64)> {
        let layout = grid(rows).walls().unwrap();
        let paths = layout.paths.iter().map(|path| {
            let lengths: Vec<f64> = path.runs().map(length_m).collect();
            (path.id().to_owned(), lengths.len(), lengths.iter().sum())
        });
        paths.collect()
    }

    fn wall(n: usize, lines: usize, length_m: f64) -> (String, usize, f64) {
        (format!("wall {n}"), lines, length_m)
    }

    #[test]
    fn outlines_have_a_line_per_side() {
        assert_eq!(walls(&["..", ".."]), []);
        assert_eq!(walls(&["#"]), [wall(1, 4, 4.0)]);
        assert_eq!(walls(&["##.", "###"]), [wall(1, 6, 10.0)]);
        assert_eq!(walls(&["#.#"]), [wall(1, 4, 4.0), wall(2, 4, 4.0)]);
    }

    #[test]
    fn holes_have_outlines_and_corners_do_not_join() {
        let ring = walls(&["####", "#..#", "####"]);
        assert_eq!(ring, [wall(1, 4, 14.0), wall(2, 4, 6.0)]);
        assert_eq!(walls(&["#.", ".#"]), [wall(1, 4, 4.0), wall(2, 4, 4.0)]);
        assert_eq!(walls(&[".#", "#."]), [wall(1, 4, 4.0), wall(2, 4, 4.0)]);
        // A hole of two cells that touch at a corner: one outline around both.
        let holes = walls(&["####", "#.##", "##.#", "####"]);
        assert_eq!(holes, [wall(1, 4, 16.0), wall(2, 8, 8.0)]);
    }

    #[test]
    fn thick_walls_have_lines_inside() {
        let thick = walls(&["#####", "#####", "#####", "#####"]);
        let inside = (INSIDE.to_owned(), 2, 6.0);
        assert_eq!(thick, [wall(1, 4, 18.0), inside]);
    }

    #[test]
    fn outline_lies_where_the_cells_do() {
        let mut grid = grid(&["..", "#."]);
        grid.placement.rotate_deg = 90.0;
        grid.placement.offset_m = Point::new(10.0, 20.0);
        let layout = grid.walls().unwrap();
        let runs = layout.paths.get(0);
        let lines = runs.runs().filter_map(|run| match run {
            RunPoints::F64(&[_, from, to, _]) => Some([from, to]),
            _ => None,
        });
        let ends = lines.flatten().map(|at| Bounds { min: at, max: at });
        let bounds = ends.reduce(Bounds::union).unwrap();
        assert!(bounds.min.distance(Point::new(9.0, 20.0)) < 1e-9);
        assert!(bounds.max.distance(Point::new(10.0, 21.0)) < 1e-9);
    }

    #[test]
    fn too_many_lines_are_an_error() {
        let noise = grid(&["#.#"]);
        assert!(noise.walls_within(8).is_ok());
        let error = noise.walls_within(7).err().unwrap().to_string();
        assert!(
            error.contains("hall.yaml") && error.contains("limit of 7"),
            "{error}"
        );
    }
}
