//! One hall: aisles between racks, roads across them, turns from each into each, docks along the walls.
//!
//! Lanes meet in nodes half an aisle's spacing beside each aisle, so every turn has half that spacing as
//! its radius and begins and ends exactly where other paths do.

use guideway_spline::Point;

use crate::random::Random;
use crate::shape::{self, Run};
use crate::{GeneratedPath, Kind};

/// Roads across the aisles: at both ends of them and in the middle.
const ROADS: usize = 3;
const BLOCKS: usize = ROADS - 1;
const RIGHT: Point<f64> = Point::new(1.0, 0.0);
const UP: Point<f64> = Point::new(0.0, 1.0);

/// What a hall is built to, in meters; the middle of the hall is the origin.
pub(crate) struct Hall {
    number: u32,
    aisles: Vec<Aisle>,
    lane_count: usize,
    spacing: f64,
    /// Height of the lower lane of each road.
    roads: [f64; ROADS],
    lane_gap: f64,
    /// Pieces that each aisle is cut into between two roads.
    pieces: usize,
    ring_radius: f64,
    dock_length: f64,
    mirror: Point<f64>,
}

struct Aisle {
    index: usize,
    x: f64,
    /// 1.0 if vehicles go up it, -1.0 if down.
    way: f64,
}

/// How large a hall may become, in meters.
pub(crate) fn most_size_m(paths: usize) -> Point<f64> {
    let aisles = aisle_guess(paths) + AISLE_VARIATION;
    Point::new(f64::from(aisles) * MOST_SPACING_M + 12.0, 118.0)
}

const AISLE_VARIATION: u32 = 3;
const MOST_SPACING_M: f64 = 4.0;

/// Each aisle brings about 31 paths with it, and the ring around them about 30 in all.
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
            // Some racks stand back to back with no aisle between them.
            if index > 0 && random.percent(6) {
                continue;
            }
            aisles.push(Aisle {
                index,
                x: (index as f64 - middle) * spacing,
                way: if index % 2 == 0 { 1.0 } else { -1.0 },
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
        // Aisles are cut so finely that there are paths enough; a few docks too many are left out.
        let missing = paths.saturating_sub(hall.count_without_aisles());
        hall.pieces = missing.div_ceil(BLOCKS * hall.aisles.len()).max(1);
        hall
    }

    /// Every path, the ones that a hall can do without last.
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

    /// The node before aisle `index`; there is one after the last, too.
    fn node_x(&self, index: usize) -> f64 {
        (index as f64 - self.lane_count as f64 / 2.0) * self.spacing
    }

    fn lane_y(&self, road: usize, lane: usize) -> f64 {
        self.roads[road] + lane as f64 * self.lane_gap
    }

    /// 1.0 if vehicles on the lane go right: both lanes of the middle road, one of the others.
    fn lane_way(road: usize, lane: usize) -> f64 {
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
                let way = Self::lane_way(road, lane);
                sink.push(Kind::Cross, 2 * road + lane, index, directed(run, way));
            }
        }
    }

    /// Where the aisles of a block begin and end.
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
                    sink.push(Kind::Aisle, aisle.index, number, directed(run, aisle.way));
                }
            }
            let run = upright(aisle.x, self.block(0).1, self.block(1).0);
            sink.push(Kind::Through, aisle.index, 0, directed(run, aisle.way));
        }
    }

    /// From and to both lanes of the road at both ends of each aisle.
    fn turns(&self, sink: &mut Sink<'_>) {
        for aisle in &self.aisles {
            for end in 0..2 * BLOCKS {
                let (block, upper) = (end / 2, end % 2 == 1);
                // Away from the road, into the block.
                let inward = if upper { -UP } else { UP };
                for lane in 0..2 {
                    let road = block + usize::from(upper);
                    // The lane nearer to the block is the upper one at its lower end.
                    let far = if upper { lane } else { 1 - lane };
                    let enters = aisle.way * inward.y > 0.0;
                    let corner = Corner {
                        road,
                        lane,
                        x: aisle.x,
                        away: inward,
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

    /// Stations at both walls, each with a way in and a way out.
    fn docks(&self, sink: &mut Sink<'_>) {
        for aisle in &self.aisles {
            for (wall, away) in [(0, -UP), (1, UP)] {
                let corner = Corner {
                    road: wall * (ROADS - 1),
                    lane: wall,
                    x: aisle.x,
                    away,
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

    /// From a lane to a line across it, or back; vehicles keep to the way of the lane.
    fn corner(&self, corner: &Corner, enters: bool) -> Run {
        let radius = self.spacing / 2.0;
        let way = Self::lane_way(corner.road, corner.lane);
        let toward = if enters { way } else { -way };
        let start = Point::new(
            corner.x - toward * radius,
            self.lane_y(corner.road, corner.lane),
        );
        let run = shape::turn(start, RIGHT * toward, corner.away, radius, corner.straight);
        if enters { run } else { shape::reversed(run) }
    }

    /// Lanes along the two outer aisles that join the roads, and turns back where lanes are opposite.
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

    /// Between the lanes of the middle road, which lead the same way.
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

/// First number of the lines of the ring, beyond those of all aisles.
const RING: usize = 90;

/// A turn between a lane and a line across it.
struct Corner {
    road: usize,
    lane: usize,
    /// Position of the line across.
    x: f64,
    /// Direction of the line, away from the lane.
    away: Point<f64>,
    /// How far the path goes straight on after the arc.
    straight: f64,
}

fn lanes() -> impl Iterator<Item = (usize, usize)> {
    (0..2 * ROADS).map(|i| (i / 2, i % 2))
}

fn upright(x: f64, low: f64, high: f64) -> Run {
    shape::line(Point::new(x, low), Point::new(x, high))
}

fn directed(run: Run, way: f64) -> Run {
    if way > 0.0 { run } else { shape::reversed(run) }
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
