//! Bands, strips, threads and memory limits change no bit of a picture.

use std::sync::Arc;

use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, RenderError, Report, Shading, Style, View,
};

use crate::cpu::Cpu;
use crate::cpu::testing::*;

#[test]
fn threads_bands_and_earlier_frames_change_no_bit() {
    let scene = colored(wandering(3000, 11, 3.0, ORIGIN), |i| [255, 200][i % 2]);
    let style = wide_px(1.5);
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..style
    };
    for style in [style, density] {
        let view = view(ORIGIN, 0.8);
        let one = Budget {
            threads: 1,
            ..Budget::default()
        };
        let (expected, report) = draw(&Cpu, &scene, &view, &style, &one);
        assert_eq!(report.bands, 1);
        let four = Budget {
            threads: 4,
            ..Budget::default()
        };
        let mut prepared = Cpu.prepare(Arc::clone(&scene), &four).unwrap();
        let mut frame = expected.clone();
        for px_per_m in [0.8, 20.0, 0.8] {
            let view = View::new(view.size(), ORIGIN, px_per_m).unwrap();
            prepared
                .render(&view, &style, &Cancel::default(), &mut frame)
                .unwrap();
        }
        assert_eq!(frame, expected);
        // A little less than one band needs, with the picture.
        let whole = report.peak_bytes + 4 * view.size().pixels() as u64;
        let little = Budget {
            memory_bytes: whole - 50_000,
            threads: 1,
        };
        let (banded, in_bands) = draw(&Cpu, &scene, &view, &style, &little);
        assert!(in_bands.bands > 1, "{in_bands:?}");
        assert_eq!(
            (in_bands.drawn, in_bands.lines),
            (report.drawn, report.lines)
        );
        assert!(in_bands.peak_bytes <= little.memory_bytes);
        assert_eq!(banded, expected);
    }
}

#[test]
fn strips_are_rows_of_the_whole_picture() {
    let scene = colored(wandering(3000, 11, 3.0, ORIGIN), |i| [255, 200][i % 2]);
    let cancel = Cancel::default();
    let densities = [ToneMap::Log, ToneMap::Equalized].map(Shading::Density);
    for shading in [Shading::Color].into_iter().chain(densities) {
        // Cached lines at first, then lines that are clipped for each strip.
        for px_per_m in [0.8, 20.0, 60_000.0] {
            let style = Style {
                shading,
                ..wide_px(1.5)
            };
            let size = FrameSize::new(200, 300).unwrap();
            let view = View::new(size, ORIGIN, px_per_m).unwrap();
            let (whole, report) = draw(&Cpu, &scene, &view, &style, &Budget::default());
            let mut prepared = Cpu.prepare(Arc::clone(&scene), &Budget::default()).unwrap();
            let (mut rows, mut joined) = (whole.pixels().iter(), None::<Report>);
            for strip in view.strips(0) {
                let mut frame = Frame::new(strip.size());
                let of_strip = prepared
                    .render_strip(&strip, &style, &cancel, &mut frame)
                    .unwrap();
                assert!(
                    frame
                        .pixels()
                        .iter()
                        .eq(rows.by_ref().take(frame.pixels().len()))
                );
                match &mut joined {
                    Some(joined) => joined.join(of_strip),
                    none => *none = Some(of_strip),
                }
            }
            let joined = joined.unwrap();
            assert_eq!((rows.next(), joined.bands), (None, 5));
            assert!(joined.accounts_for_all());
            assert_eq!((joined.drawn, joined.lines), (report.drawn, report.lines));
        }
    }
}

#[test]
fn rejects_too_little_memory_and_stops_when_cancelled() {
    let scene = colored(wandering(3000, 11, 3.0, ORIGIN), |_| 255);
    let budget = |memory_bytes| Budget {
        memory_bytes,
        threads: 1,
    };
    assert!(matches!(
        Cpu.prepare(Arc::clone(&scene), &budget(1000)),
        Err(RenderError::Budget { .. })
    ));
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let mut prepared = Cpu.prepare(Arc::clone(&scene), &budget(300_000)).unwrap();
    let cancel = Cancel::default();
    let (view, style) = (view(ORIGIN, 0.8), wide_px(1.5));
    let refused = prepared.render(&view, &style, &cancel, &mut frame);
    assert!(
        matches!(refused, Err(RenderError::Budget { .. })),
        "{refused:?}"
    );
    cancel.set();
    let mut prepared = Cpu.prepare(scene, &Budget::default()).unwrap();
    let stopped = prepared.render(&view, &style, &cancel, &mut frame);
    assert_eq!(stopped, Err(RenderError::Cancelled));
}

#[test]
fn any_number_of_threads_draws_the_same_bits() {
    // Wide enough that each row of tiles is split.
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
