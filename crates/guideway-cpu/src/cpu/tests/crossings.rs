//! Pictures by lines that are listed where they lie, and by whole clusters.

use super::*;

#[test]
fn lists_of_lines_do_not_show() {
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..wide_px(1.5)
    };
    let solid = || scene(wandering(500, 30, 2.0, ORIGIN));
    for (scene, style) in [
        (solid(), wide_px(2.5)),
        (solid(), wide_px(0.4)),
        (solid(), density),
        (
            colored(wandering(300, 30, 2.0, ORIGIN), |i| [255, 120][i % 2]),
            wide_px(1.5),
        ),
    ] {
        // From 0.1 mm a pixel on, clusters are too large for their lines to be kept.
        for px_per_m in [2.0, 30.0, 10_000.0] {
            let pictures = [1, usize::MAX].map(|least_tiles| {
                let mut prepared = CpuPrepared::new(Arc::clone(&scene), &Budget::default());
                let prepared = prepared.as_mut().unwrap();
                prepared.list_lines_from(least_tiles);
                let first = draw_with(prepared, &view(ORIGIN, px_per_m), &style).0;
                let moved = view(ORIGIN + Point::new(9.0 / px_per_m, 0.0), px_per_m);
                [first, draw_with(prepared, &moved, &style).0]
            });
            assert!(pictures[0] == pictures[1], "{px_per_m} px a meter");
        }
    }
}
