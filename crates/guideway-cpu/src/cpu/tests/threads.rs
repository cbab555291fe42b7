//! Pictures that threads share, wide enough that each row of tiles is cut into several stretches.

use super::*;

#[test]
fn any_number_of_threads_draws_the_same_bits() {
    let view = View::new(FrameSize::new(701, 90).unwrap(), ORIGIN, 3.0).unwrap();
    let layout = || wandering(500, 11, 3.0, ORIGIN);
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..wide_px(1.5)
    };
    check(&colored(layout(), |_| 255), &view, &wide_px(1.5));
    for (scene, style) in [
        (scene(layout()), wide_px(2.5)),
        (colored(layout(), |i| [255, 120][i % 2]), wide_px(1.5)),
        (scene(layout()), density),
    ] {
        let [one, others @ ..] = [1, 2, 3, 8].map(|threads| {
            let budget = Budget {
                threads,
                ..Budget::default()
            };
            draw(&Cpu, &scene, &view, &style, &budget).0
        });
        assert!(others.iter().all(|other| *other == one));
    }
}
