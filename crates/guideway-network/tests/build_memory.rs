//! Memory that `build` takes at its peak, per edge of the network, counted by the allocator.

use guideway_layout::{Layout, NewPath};
use guideway_network::{BuildOptions, build};
use guideway_spline::{Point, Runs};

/// Most bytes per edge at the peak, without the drawing: pieces are places on lines, and the index
/// of boxes is gone before they are cut. Measured: 299 bytes.
const MOST_BYTES: u64 = 360;

/// Streets and avenues that cross in a grid, `n` of each.
fn grid(n: u32) -> Layout {
    let mut layout = Layout::default();
    let far = f64::from(n) + 1.0;
    for i in 1..=n {
        let at = f64::from(i);
        for (id, start, end) in [
            (format!("s{i}"), Point::new(0.0, at), Point::new(far, at)),
            (format!("a{i}"), Point::new(at, 0.0), Point::new(at, far)),
        ] {
            let mut runs = Runs::default();
            runs.push_line(start, end);
            layout.paths.push(&NewPath {
                id: &id,
                runs: &runs,
                ..NewPath::default()
            });
        }
    }
    layout
}

#[test]
fn a_build_takes_few_bytes_per_edge() {
    let drawing = grid(70);
    let options = BuildOptions {
        split_junctions: true,
        split_crossings: true,
        ..BuildOptions::default()
    };
    // The counter counts one thread.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("a thread");
    let (counted, edges) = pool.install(|| {
        let mut edges = 0;
        let counted = allocation_counter::measure(|| {
            let made = build(&drawing, &options).expect("a network");
            edges = made.layout.paths.len() as u64;
        });
        (counted, edges)
    });
    assert_eq!(edges, 2 * 70 * 71);
    let bytes = counted.bytes_max / edges;
    println!("{bytes} bytes per edge");
    assert!(bytes < MOST_BYTES, "{bytes} bytes per edge");
}
