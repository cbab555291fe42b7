//! Builds one hall: aisles between racks, roads across them, turns between both, docks along the
//! walls.
//!
//! ```text
//!   dock  dock          d d d   docks at the wall
//! ==+=====+=====+==     road 2 (two lanes)
//!   |     |     |       aisles of block 1
//! ==+=====+=====+==     road 1 (two lanes, same direction)
//!   |     |     |       aisles of block 0
//! ==+=====+=====+==     road 0 (two lanes)
//!   dock  dock          docks at the wall
//! ```
//!
//! Lanes have nodes half an aisle spacing beside each aisle. A turn has this distance as its
//! radius, so it starts and ends exactly at the ends of other paths.

use guideway_spline::Point;

use crate::random::Random;
use crate::shape::{self, Run};
use crate::{GeneratedPath, Kind};

/// Roads across the aisles: one at each end, and one in the middle.
const ROADS: usize = 3;
const BLOCKS: usize = ROADS - 1;
const RIGHT: Point<f64> = Point::new(1.0, 0.0);
const UP: Point<f64> = Point::new(0.0, 1.0);

/// Dimensions of a hall in meters; the center of the hall is the origin.
pub(crate) struct Hall {
    number: u32,
    aisles: Vec<Aisle>,
    lane_count: usize,
    spacing: f64,
    /// y of the lower lane of each road.
    roads: [f64; ROADS],
    lane_gap: f64,
    /// Paths per aisle between two roads.
    pieces: usize,
    ring_radius: f64,
    dock_length: f64,
    mirror: Point<f64>,
}

struct Aisle {
    index: usize,
    x: f64,
    /// 1.0 for vehicles that drive up, -1.0 for down.
    direction: f64,
}

/// Upper bound of the size of a hall, in meters.
pub(crate) fn most_size_m(paths: usize) -> Point<f64> {
    let aisles = aisle_guess(paths) + AISLE_VARIATION;
    Point::new(f64::from(aisles) * MOST_SPACING_M + 12.0, 118.0)
}

const AISLE_VARIATION: u32 = 3;
const MOST_SPACING_M: f64 = 4.0;

/// Estimated number of aisles. Derived: an aisle adds about 31 paths, the ring about 30 in total.
fn aisle_guess(paths: usize) -> u32 {
    let paths = u32::try_from(paths).unwrap_or(u32::MAX);
    (paths.saturating_sub(30) / 31).clamp(2, 48)
}

impl Hall {
    pub(crate) fn new(number: u32, paths: usize, random: &mut Random) -> Self {
        let guess = aisle_guess(paths) + random.below(2 * AISLE_VARIATION + 1);
        let lane_count = guess.saturating_sub(AISLE_VARIATION).max(2) as usize;
        let spacing = random.between(3.1, MOST_SPACING_M);
        let lane_gap = random.between(3.0, 3.8);
        let blocks: [f64; BLOCKS] = std::array::from_fn(|_| random.between(32.0, 40.0));
        let height = blocks.iter().sum::<f64>() + ROADS as f64 * lane_gap;
        let mut roads = [-height / 2.0; ROADS];
        for k in 0..BLOCKS {
            roads[k + 1] = roads[k] + lane_gap + blocks[k];
        }
        let middle = (lane_count - 1) as f64 / 2.0;
        let mut aisles = Vec::with_capacity(lane_count);
        for index in 0..lane_count {
            // Some racks stand back to back without an aisle.
            if index > 0 && random.percent(6) {
                continue;
            }
            aisles.push(Aisle {
                index,
                x: (index as f64 - middle) * spacing,
                direction: if index % 2 == 0 { 1.0 } else { -1.0 },
            });
        }
        let sign = |random: &mut Random| if random.percent(50) { 1.0 } else { -1.0 };
        let mut hall = Self {
            number,
            aisles,
            lane_count,
            spacing,
            roads,
            lane_gap,
            pieces: 1,
            ring_radius: random.between(2.2, 3.0),
            dock_length: random.between(3.0, 6.0),
            mirror: Point::new(sign(random), sign(random)),
        };
        // Aisles split into as many paths as needed; the caller drops surplus docks at the end.
        let missing = paths.saturating_sub(hall.count_without_aisles());
        hall.pieces = missing.div_ceil(BLOCKS * hall.aisles.len()).max(1);
        hall
    }

    /// All paths; docks last, because the caller truncates the list.
    pub(crate) fn paths(&self, center: Point<f64>) -> Vec<GeneratedPath> {
        let mut sink = Sink {
            hall: self,
            center,
            paths: Vec::new(),
        };
        self.cross(&mut sink);
        self.aisles(&mut sink);
        self.turns(&mut sink);
        self.ring(&mut sink);
        self.lane_changes(&mut sink);
        self.docks(&mut sink);
        sink.paths
    }

    fn count_without_aisles(&self) -> usize {
        let uncut = BLOCKS * self.aisles.len() * self.pieces;
        self.paths(Point::default()).len() - uncut
    }

    /// x of the node before aisle `index`; the last node is after the last aisle.
    fn node_x(&self, index: usize) -> f64 {
        (index as f64 - self.lane_count as f64 / 2.0) * self.spacing
    }

    fn lane_y(&self, road: usize, lane: usize) -> f64 {
        self.roads[road] + lane as f64 * self.lane_gap
    }

    /// 1.0 for lanes to the right: both lanes of the middle road, the lower lane of the others.
    fn lane_direction(road: usize, lane: usize) -> f64 {
        if road == 1 || lane == 0 { 1.0 } else { -1.0 }
    }

    fn cross(&self, sink: &mut Sink<'_>) {
        for (road, lane) in lanes() {
            let y = self.lane_y(road, lane);
            for index in 0..self.lane_count {
                let run = shape::line(
                    Point::new(self.node_x(index), y),
                    Point::new(self.node_x(index + 1), y),
                );
                let direction = Self::lane_direction(road, lane);
                let run = directed(run, direction);
                sink.push(Kind::Cross, 2 * road + lane, index, run);
            }
        }
    }

    /// Lower and upper y of the aisles of a block.
    fn block(&self, block: usize) -> (f64, f64) {
        let radius = self.spacing / 2.0;
        let (low, high) = (self.lane_y(block, 1), self.lane_y(block + 1, 0));
        (low + radius, high - radius)
    }

    fn aisles(&self, sink: &mut Sink<'_>) {
        for aisle in &self.aisles {
            for block in 0..BLOCKS {
                let (low, high) = self.block(block);
                let y = |piece: usize| low + (high - low) * piece as f64 / self.pieces as f64;
                for piece in 0..self.pieces {
                    let run = upright(aisle.x, y(piece), y(piece + 1));
                    let number = block * self.pieces + piece;
                    sink.push(
                        Kind::Aisle,
                        aisle.index,
                        number,
                        directed(run, aisle.direction),
                    );
                }
            }
            let run = upright(aisle.x, self.block(0).1, self.block(1).0);
            sink.push(
                Kind::Through,
                aisle.index,
                0,
                directed(run, aisle.direction),
            );
        }
    }

    /// Turns between each end of an aisle and both lanes of the road there.
    fn turns(&self, sink: &mut Sink<'_>) {
        for aisle in &self.aisles {
            for end in 0..2 * BLOCKS {
                let (block, upper) = (end / 2, end % 2 == 1);
                // Direction from the road into the block.
                let inward = if upper { -UP } else { UP };
                for lane in 0..2 {
                    let road = block + usize::from(upper);
                    // At the lower end of a block, the upper lane is nearer.
                    let far = if upper { lane } else { 1 - lane };
                    let enters = aisle.direction * inward.y > 0.0;
                    let corner = Corner {
                        road,
                        lane,
                        x: aisle.x,
                        outward: inward,
                        straight: far as f64 * self.lane_gap,
                    };
                    let number = 2 * end + lane;
                    sink.push(
                        Kind::Turn,
                        aisle.index,
                        number,
                        self.corner(&corner, enters),
                    );
                }
            }
        }
    }

    /// Stations at both walls, each with a path in and a path out.
    fn docks(&self, sink: &mut Sink<'_>) {
        for aisle in &self.aisles {
            for (wall, outward) in [(0, -UP), (1, UP)] {
                let corner = Corner {
                    road: wall * (ROADS - 1),
                    lane: wall,
                    x: aisle.x,
                    outward,
                    straight: self.dock_length,
                };
                for enters in [true, false] {
                    let number = 2 * wall + usize::from(!enters);
                    sink.push(
                        Kind::Dock,
                        aisle.index,
                        number,
                        self.corner(&corner, enters),
                    );
                }
            }
        }
    }

    /// A turn from a lane into a line across it, or back, in the direction of the lane.
    fn corner(&self, corner: &Corner, enters: bool) -> Run {
        let radius = self.spacing / 2.0;
        let direction = Self::lane_direction(corner.road, corner.lane);
        let toward = if enters { direction } else { -direction };
        let start = Point::new(
            corner.x - toward * radius,
            self.lane_y(corner.road, corner.lane),
        );
        let run = shape::turn(
            start,
            RIGHT * toward,
            corner.outward,
            radius,
            corner.straight,
        );
        if enters { run } else { shape::reversed(run) }
    }

    /// Lanes outside the outer aisles that connect the roads, and U-turns at the outer roads.
    fn ring(&self, sink: &mut Sink<'_>) {
        const PIECES: usize = 4;
        let radius = self.ring_radius;
        for (side, out) in [(0, -RIGHT), (1, RIGHT)] {
            let x = self.node_x(side * self.lane_count);
            for block in 0..BLOCKS {
                let (low, high) = (self.lane_y(block, 1), self.lane_y(block + 1, 0));
                let line = BLOCKS * side + block;
                let up = shape::turn(Point::new(x, low), out, UP, radius, 0.0);
                let down = shape::turn(Point::new(x, high), out, -UP, radius, 0.0);
                sink.push(Kind::Turn, RING + line, 0, up);
                sink.push(Kind::Turn, RING + line, 1, shape::reversed(down));
                let ring_x = x + out.x * radius;
                let (low, high) = (low + radius, high - radius);
                let y = |piece: usize| low + (high - low) * piece as f64 / PIECES as f64;
                for piece in 0..PIECES {
                    let run = upright(ring_x, y(piece), y(piece + 1));
                    sink.push(Kind::Cross, RING + line, piece, run);
                }
            }
            for road in [0, ROADS - 1] {
                let start = Point::new(x, self.lane_y(road, 0));
                let run = shape::u_turn(start, out, UP, self.lane_gap / 2.0);
                sink.push(Kind::UTurn, road, side, directed(run, out.x));
            }
        }
    }

    /// Changes between the lanes of the middle road, which have the same direction.
    fn lane_changes(&self, sink: &mut Sink<'_>) {
        let length = 2.0 * self.spacing;
        for (number, index) in (0..self.lane_count.saturating_sub(1))
            .step_by(3)
            .enumerate()
        {
            for lane in 0..2 {
                let start = Point::new(self.node_x(index), self.lane_y(1, lane));
                let shift = if lane == 0 { UP } else { -UP } * self.lane_gap;
                let run = shape::lane_change(start, RIGHT, shift, length);
                sink.push(Kind::LaneChange, lane, number, run);
            }
        }
    }
}

/// First line number of the ring, above the numbers of all aisles.
const RING: usize = 90;

/// A turn between a lane and a line across it.
struct Corner {
    road: usize,
    lane: usize,
    /// x of the line across.
    x: f64,
    /// Direction of the line, pointing away from the lane.
    outward: Point<f64>,
    /// Length of the straight part after the arc.
    straight: f64,
}

fn lanes() -> impl Iterator<Item = (usize, usize)> {
    (0..2 * ROADS).map(|i| (i / 2, i % 2))
}

fn upright(x: f64, low: f64, high: f64) -> Run {
    shape::line(Point::new(x, low), Point::new(x, high))
}

/// The run, reversed for a negative direction.
fn directed(run: Run, direction: f64) -> Run {
    if direction > 0.0 {
        run
    } else {
        shape::reversed(run)
    }
}

/// Collects the paths of one hall.
struct Sink<'a> {
    hall: &'a Hall,
    center: Point<f64>,
    paths: Vec<GeneratedPath>,
}

impl Sink<'_> {
    fn push(&mut self, kind: Kind, line: usize, piece: usize, run: Run) {
        let (mirror, hall) = (self.hall.mirror, self.hall.number);
        let place = |p: Point<f64>| Point::new(p.x * mirror.x, p.y * mirror.y) + self.center;
        self.paths.push(GeneratedPath {
            id: format!("H{hall:04}-{}{line:02}-{piece:02}", kind.letter()),
            kind,
            max_speed_m_s: kind.max_speed_m_s(),
            hall,
            run: run.map(|p| place(p).to_f32()),
        });
    }
}
