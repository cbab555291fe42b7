//! Raster tiles against one large picture, tiles by their addresses, and runs that are stopped and
//! go on.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

use std::cell::Cell;
use std::fs::OpenOptions;
use std::io::Cursor;
use std::sync::Arc;

use guideway_cpu::Cpu;
use guideway_datasets::d1;
use guideway_layout::{Layout, NewPath};
use guideway_scene::density::{ToneMap, ToneScale};
use guideway_scene::{
    Budget, Cancel, ColorBy, Frame, FrameSize, Method, Scene, SceneOptions, Shading, Style, View,
};
use guideway_spline::{Point, Runs};
use guideway_tiles::{
    ArchiveInfo, Content, Journal, Made, Pyramid, TILE_PX, Tile, TileError, TileGrid, TileRenderer,
    Tiler, VectorOptions, draw_vector_tile, place,
};

/// Halls of a data set, and curves far larger than a tile.
fn layout() -> Layout {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    for path in d1(2000, 5) {
        runs.clear();
        let points: Vec<Point<f64>> = path.run.iter().map(|p| p.to_f64()).collect();
        runs.push(&points);
        push(&mut layout, &path.id, &runs);
    }
    let bounds = layout.paths.hull_bounds().unwrap();
    let at = |x: f64, y: f64| {
        let size = bounds.size();
        bounds.min + Point::new(x * size.x, y * size.y)
    };
    for (i, [a, b]) in [[(0.01, 0.03), (0.97, 0.91)], [(0.5, -1.0), (0.499, 2.0)]]
        .into_iter()
        .enumerate()
    {
        runs.clear();
        runs.push_line(at(a.0, a.1), at(b.0, b.1));
        runs.push(&[at(b.0, b.1), at(0.9, 0.1), at(0.2, 0.7), at(0.4, 0.35)]);
        push(&mut layout, &format!("long-{i}"), &runs);
    }
    layout
}

fn push(layout: &mut Layout, id: &str, runs: &Runs) {
    layout.paths.push(&NewPath {
        id,
        runs,
        ..NewPath::default()
    });
}

fn scene(options: &SceneOptions) -> (Arc<Scene>, TileGrid) {
    let (layout, grid) = place(Arc::new(layout()), false);
    (Arc::new(Scene::new(layout, options).unwrap()), grid)
}

fn pixels(png: &[u8]) -> Vec<[u8; 4]> {
    let mut decoder = png::Decoder::new(Cursor::new(png));
    decoder.set_transformations(png::Transformations::ALPHA);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    bytes.as_chunks::<4>().0.to_vec()
}

/// Compares the tiles in the middle of a zoom, drawn one by one and by blocks, with a picture of
/// 2048 x 1536 pixels that begins within the square.
fn check(options: &SceneOptions, shading: Shading, zoom: u8) {
    let (scene, grid) = scene(options);
    let style = Style {
        shading,
        ..Style::default()
    };
    let budget = Budget::default();
    let (width, height) = (8, 6);
    let first = (1 << zoom) / 2 - 4;
    let corner = grid.bounds(Tile::new(zoom, first, first).unwrap());
    let px_per_m = grid.px_per_m(zoom);
    let center = Point::new(
        corner.min.x + f64::from(width * TILE_PX / 2) / px_per_m,
        corner.max.y - f64::from(height * TILE_PX / 2) / px_per_m,
    );
    let size = FrameSize::new(width * TILE_PX, height * TILE_PX).unwrap();
    let view = View::new(size, center, px_per_m).unwrap();
    let mut picture = Frame::new(size);
    let mut prepared = Cpu.prepare(Arc::clone(&scene), &budget).unwrap();
    let (cancel, mut tones) = (Cancel::default(), None);
    prepared
        .render(&view, &style, &cancel, &mut picture)
        .unwrap();
    if let Shading::Density(tone) = shading {
        let mut counts = Vec::new();
        prepared
            .count_paths(&view, &style, &cancel, &mut counts)
            .unwrap();
        let mut scale = ToneScale::new(tone, style.background);
        scale.observe(&counts);
        tones = Some(scale);
    }
    let mut renderer = TileRenderer::new(&Cpu, Arc::clone(&scene), grid, style, &budget).unwrap();
    let mut compare = |tile: Tile, zooms: u8| {
        let mut shown = 0;
        for (tile, png) in renderer.draw(tile, zooms, tones.as_ref(), &cancel).unwrap() {
            if tile.x.min(tile.y) < first || tile.x >= first + width || tile.y >= first + height {
                continue;
            }
            let [left, top] = [tile.x - first, tile.y - first].map(|at| (at * TILE_PX) as usize);
            let side = TILE_PX as usize;
            let rows = (top..top + side)
                .map(|row| &picture.pixels()[row * size.width() as usize + left..][..side]);
            match png {
                Some(png) => {
                    assert!(rows.flatten().eq(&pixels(&png)), "{tile:?} {zooms}");
                    shown += 1;
                }
                None => assert!(rows.flatten().all(|pixel| *pixel == [255; 4]), "{tile:?}"),
            }
        }
        shown
    };
    let mut shown = Vec::new();
    for y in first..first + height {
        for x in first..first + width {
            let tile = Tile::new(zoom, x, y).unwrap();
            if compare(tile, 0) > 0 {
                shown.push(tile);
            }
        }
    }
    assert!(shown.len() > 5, "{} tiles", shown.len());
    let one = shown[shown.len() / 2];
    let above = Tile::new(zoom - 3, one.x >> 3, one.y >> 3).unwrap();
    assert!(compare(above, 3) > 0);
}

#[test]
fn tiles_are_windows_of_one_large_picture() {
    check(&SceneOptions::default(), Shading::Color, 4);
    check(&SceneOptions::default(), Shading::Color, 7);
    check(&SceneOptions::default(), Shading::Density(ToneMap::Log), 7);
    let colors = SceneOptions {
        color_by: Some(ColorBy {
            column: "direction".to_owned(),
        }),
        ..SceneOptions::default()
    };
    check(&colors, Shading::Color, 6);
}

fn raster(scene: &Arc<Scene>, grid: TileGrid, shading: Shading) -> Box<TileRenderer> {
    let style = Style {
        shading,
        ..Style::default()
    };
    let scene = Arc::clone(scene);
    Box::new(TileRenderer::new(&Cpu, scene, grid, style, &Budget::default()).unwrap())
}

/// Compares tiles that are drawn in one call, in disorder and some twice, with each by itself.
fn check_addresses(
    scene: &Arc<Scene>,
    grid: TileGrid,
    content: Content,
    mut alone: impl FnMut(Tile) -> Option<Vec<u8>>,
) {
    let (mut tiler, cancel) = (
        Tiler::new(Arc::clone(scene), grid, content).unwrap(),
        Cancel::default(),
    );
    let mut tiles = vec![Tile::WORLD];
    for zoom in [2, 5, 6] {
        let touched = tiler.touched(zoom, 1 << 12).unwrap();
        assert!(touched.is_sorted_by_key(|tile| tile.id()));
        // All tiles of some blocks, and few of others.
        let is_chosen = |i: &usize| i % 256 < 128 || i.is_multiple_of(37);
        tiles.extend((0..touched.len()).filter(is_chosen).map(|i| touched[i]));
    }
    let count = tiles.len();
    tiles.extend_from_within(count / 3..count / 2);
    tiles.reverse();
    let drawn = tiler.draw(&tiles, &cancel).unwrap();
    let shown = drawn.iter().filter(|tile| tile.is_some()).count();
    assert!(
        shown > count / 2 && drawn.len() == tiles.len(),
        "{shown} of {count}"
    );
    for (tile, drawn) in tiles.into_iter().zip(drawn) {
        assert!(drawn == alone(tile), "{tile:?}");
    }
    let all = tiler.touched(5, usize::MAX).unwrap();
    for y in 0..32 {
        for tile in (0..32).map(|x| Tile::new(5, x, y).unwrap()) {
            assert!(alone(tile).is_none() || all.contains(&tile), "{tile:?}");
        }
    }
    let too_many = tiler.touched(5, all.len() - 1);
    assert!(matches!(too_many, Err(TileError::TooMany { zoom: 5, .. })));
    cancel.set();
    assert!(tiler.draw(&all, &cancel).is_err());
}

#[test]
fn tiles_of_one_call_are_those_of_many() {
    let (scene, grid) = scene(&SceneOptions::default());
    let content = Content::Raster(raster(&scene, grid, Shading::Color));
    let mut renderer = raster(&scene, grid, Shading::Color);
    check_addresses(&scene, grid, content, |tile| {
        let drawn = renderer.draw(tile, 0, None, &Cancel::default());
        drawn.unwrap().remove(0).1
    });
    let options = VectorOptions {
        max_paths: 50,
        ..VectorOptions::default()
    };
    let content = Content::Vector(options.clone());
    check_addresses(&scene, grid, content, |tile| {
        draw_vector_tile(&scene, &grid, tile, &options).mvt
    });
    let density = raster(&scene, grid, Shading::Density(ToneMap::Log));
    let refused = Tiler::new(scene, grid, Content::Raster(density));
    assert!(matches!(refused, Err(TileError::SingleDensity)));
}

/// Makes an archive; stops after some blocks and goes on with a new journal object.
fn archive(content: &dyn Fn() -> Content, stop_after: usize) -> (Vec<u8>, usize) {
    let (scene, grid) = scene(&SceneOptions::default());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("journal");
    let mut runs = 0;
    let vector = match content() {
        Content::Vector(options) => Some(options),
        Content::Raster(_) => None,
    };
    loop {
        let mut options = OpenOptions::new();
        let file = options.read(true).write(true).create(true).truncate(false);
        let mut journal = Journal::open(file.open(&path).unwrap(), 7).unwrap();
        let (cancel, steps) = (Cancel::default(), Cell::new(0));
        let pyramid = Pyramid {
            scene: Arc::clone(&scene),
            grid,
            zooms: 0..=5,
            progress: &|share| {
                assert!((0.0..=1.0).contains(&share));
                steps.set(steps.get() + 1);
                if steps.get() == stop_after {
                    cancel.set();
                }
            },
            cancel: &cancel,
        };
        runs += 1;
        let made = pyramid.make(&mut content(), &mut journal).unwrap();
        if made == Made::Stopped {
            drop(journal);
            // As a run that was killed in the middle of a block.
            let file = OpenOptions::new().append(true).open(&path).unwrap();
            std::io::Write::write_all(&mut &file, &[9; 333]).unwrap();
            continue;
        }
        let info = ArchiveInfo {
            name: "test",
            scene: &scene,
            grid,
            zooms: [0, 5],
            vector: vector.as_ref(),
        };
        let mut bytes = Vec::new();
        let size = journal.write_archive(&info, &mut bytes).unwrap();
        assert_eq!(size.bytes, bytes.len() as u64);
        assert!(size.contents <= size.tiles && size.tiles > 50, "{size:?}");
        return (bytes, runs);
    }
}

#[test]
fn a_run_that_was_stopped_makes_the_same_archive() {
    let density = || {
        let (scene, grid) = scene(&SceneOptions::default());
        Content::Raster(raster(&scene, grid, Shading::Density(ToneMap::Log)))
    };
    let vector = || Content::Vector(VectorOptions::default());
    check_stops(&density, 12);
    check_stops(&vector, 6);
}

fn check_stops(content: &dyn Fn() -> Content, stop_after: usize) {
    let (whole, runs) = archive(content, usize::MAX);
    assert_eq!(runs, 1);
    let (in_parts, runs) = archive(content, stop_after);
    assert!(runs > 1 && in_parts == whole, "{runs} runs");
    assert_eq!(&whole[..8], b"PMTiles\x03");
}
