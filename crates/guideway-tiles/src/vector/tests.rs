use std::collections::BTreeMap;
use std::sync::Arc;

use guideway_layout::{Layout, NewPath, Value};
use guideway_scene::SceneOptions;
use guideway_spline::{Point, Runs, uniform};

use super::*;

/// A feature as another program reads it: vertices of its lines, and attributes.
#[derive(Debug, Default)]
struct Feature {
    id: u64,
    lines: Vec<Vec<[i64; 2]>>,
    attributes: BTreeMap<String, String>,
}

fn varint(bytes: &mut &[u8]) -> u64 {
    let (mut value, mut shift) = (0, 0);
    loop {
        let byte = bytes[0];
        *bytes = &bytes[1..];
        value |= u64::from(byte & 0x7f) << shift;
        shift += 7;
        if byte < 0x80 {
            return value;
        }
    }
}

/// Fields of a message: numbers as they are, doubles as bits, and bytes.
fn fields(mut bytes: &[u8]) -> Vec<(u64, u64, &[u8])> {
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let key = varint(&mut bytes);
        let (number, content) = match key & 7 {
            0 => (varint(&mut bytes), &[][..]),
            1 => {
                let (number, rest) = bytes.split_first_chunk::<8>().unwrap();
                bytes = rest;
                (u64::from_le_bytes(*number), &[][..])
            }
            _ => {
                let length = varint(&mut bytes) as usize;
                let content;
                (content, bytes) = bytes.split_at(length);
                (0, content)
            }
        };
        all.push((key >> 3, number, content));
    }
    all
}

fn list(mut bytes: &[u8]) -> Vec<u64> {
    let mut all = Vec::new();
    while !bytes.is_empty() {
        all.push(varint(&mut bytes));
    }
    all
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn value(bytes: &[u8]) -> String {
    let (field, number, content) = fields(bytes)[0];
    match field {
        1 => text(content),
        3 => f64::from_bits(number).to_string(),
        6 => ((number >> 1).cast_signed() ^ -(number & 1).cast_signed()).to_string(),
        7 => (number == 1).to_string(),
        _ => panic!("type {field}"),
    }
}

fn decode(mvt: &[u8]) -> Vec<Feature> {
    let layers = fields(mvt);
    assert_eq!((layers.len(), layers[0].0), (1, 3));
    let layer = fields(layers[0].2);
    let of = |field: u64| layer.iter().filter(move |(of, ..)| *of == field);
    assert_eq!(text(of(1).next().unwrap().2), "paths");
    assert_eq!(
        (of(15).next().unwrap().1, of(5).next().unwrap().1),
        (2, 4096)
    );
    let keys: Vec<String> = of(3).map(|(.., bytes)| text(bytes)).collect();
    let values: Vec<String> = of(4).map(|(.., bytes)| value(bytes)).collect();
    let feature = |bytes: &[u8]| {
        let mut feature = Feature::default();
        for (field, number, content) in fields(bytes) {
            match field {
                1 => feature.id = number,
                2 => {
                    let tags = list(content);
                    let tags = tags.as_chunks::<2>().0.iter();
                    feature.attributes = tags
                        .map(|[key, value]| {
                            (keys[*key as usize].clone(), values[*value as usize].clone())
                        })
                        .collect();
                }
                3 => assert_eq!(number, 2),
                _ => feature.lines = lines(&list(content)),
            }
        }
        feature
    };
    of(2).map(|(.., bytes)| feature(bytes)).collect()
}

fn lines(commands: &[u64]) -> Vec<Vec<[i64; 2]>> {
    let (mut all, mut at, mut i) = (Vec::<Vec<[i64; 2]>>::new(), [0_i64; 2], 0);
    while i < commands.len() {
        let (command, count) = (commands[i] & 7, commands[i] >> 3);
        i += 1;
        for _ in 0..count {
            for axis in &mut at {
                let step = commands[i];
                *axis += (step >> 1).cast_signed() ^ -(step & 1).cast_signed();
                i += 1;
            }
            match command {
                1 => all.push(vec![at]),
                _ => all.last_mut().unwrap().push(at),
            }
        }
    }
    all
}

fn vector_tile(
    scene: &Scene,
    grid: &TileGrid,
    tile: Tile,
    rows: &[u32],
    options: &VectorOptions,
) -> VectorTile {
    let fields = options.features(scene);
    let mut encoder = TileEncoder::new(scene, grid, &fields, options);
    // One of before leaves no trace.
    encoder.encode(Tile::WORLD, rows);
    let (mvt, omitted) = encoder.encode(tile, rows);
    VectorTile {
        mvt: mvt.map(<[u8]>::to_vec),
        omitted,
    }
}

/// A curve through the tiles of a square of 64 m, a short line, and one of 1 mm.
fn scene() -> (Scene, TileGrid) {
    let mut layout = Layout::default();
    let curve = [
        (2, 2),
        (4, 30),
        (40, 10),
        (60, 60),
        (10, 50),
        (3, 3),
        (2, 1),
    ];
    let curve = curve.map(|(x, y)| Point::new(f64::from(x), f64::from(y)));
    let mut push = |id: &str, runs: &Runs| {
        layout.paths.push(&NewPath {
            id,
            runs,
            ..NewPath::default()
        })
    };
    let mut runs = Runs::default();
    runs.push(&curve);
    push("curve", &runs);
    for (id, length) in [("17", 2.0), ("tiny", 1e-3)] {
        runs.clear();
        runs.push_line(Point::new(20.0, 20.0), Point::new(20.0 + length, 20.0));
        push(id, &runs);
    }
    let paths = &mut layout.paths.attributes;
    paths.set(0, "lanes", Value::Int(-3));
    paths.set(0, "speed", Value::Float(1.5));
    paths.set(1, "speed", Value::Float(1.5));
    paths.set(1, "is_wide", Value::Bool(true));
    paths.set(0, "other", Value::Json("{}"));
    let grid = TileGrid::around(layout.paths.hull_bounds());
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap();
    (scene, grid)
}

#[test]
fn lines_are_within_two_units_of_their_curve_and_have_all_of_it() {
    let (scene, grid) = scene();
    let path = scene.layout().paths.get(0);
    for tile in Tile::WORLD.descendants(2) {
        let square = grid.bounds(tile);
        let units_per_m = f64::from(EXTENT) / square.size().x;
        let unit = |p: Point<f64>| {
            Point::new(
                (p.x - square.min.x) * units_per_m,
                (square.max.y - p.y) * units_per_m,
            )
        };
        let run: Vec<Point<f64>> = path.runs().next().unwrap().iter().map(unit).collect();
        let segments = run.array_windows::<4>();
        let curve: Vec<Point<f64>> = segments
            .flat_map(|s| (0..=4000).map(|i| uniform::point(s, f64::from(i) / 4000.0)))
            .collect();
        let made = vector_tile(&scene, &grid, tile, &[0], &VectorOptions::default());
        let features = made.mvt.as_deref().map(decode).unwrap_or_default();
        let lines: Vec<Vec<Point<f64>>> = features
            .iter()
            .flat_map(|feature| &feature.lines)
            .map(|line| {
                line.iter()
                    .map(|[x, y]| Point::new(*x as f64, *y as f64))
                    .collect()
            })
            .collect();
        let near = |p: Point<f64>| {
            let ends = lines.iter().flat_map(|line| line.array_windows());
            let all = ends.map(|[a, b]: &[Point<f64>; 2]| {
                let along = *b - *a;
                let t = ((p - *a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
                p.distance(*a + along * t)
            });
            all.fold(f64::INFINITY, f64::min)
        };
        let within = |p: &&Point<f64>| p.x.min(p.y) > 0.0 && p.x.max(p.y) < f64::from(EXTENT);
        for p in curve.iter().filter(within).step_by(37) {
            assert!(near(*p) < 2.0, "{tile:?}: {p:?} is {} off", near(*p));
        }
        for vertex in lines.iter().flatten() {
            let off = curve.iter().map(|p| p.distance(*vertex));
            assert!(
                off.fold(f64::INFINITY, f64::min) < 2.5,
                "{tile:?} {vertex:?}"
            );
        }
    }
}

#[test]
fn features_have_their_attributes_and_the_rest_is_counted() {
    let (scene, grid) = scene();
    let all = [0, 1, 2];
    let made = vector_tile(&scene, &grid, Tile::WORLD, &all, &VectorOptions::default());
    assert_eq!(made.omitted, 1, "the tiny one");
    let features = decode(&made.mvt.unwrap());
    let about = |i: usize| {
        let attributes = &features[i].attributes;
        let pairs = attributes
            .iter()
            .map(|(key, value)| format!("{key}={value}"));
        (features[i].id, pairs.collect::<Vec<_>>().join(" "))
    };
    assert_eq!(about(0), (0, "id=curve lanes=-3 speed=1.5".to_owned()));
    assert_eq!(about(1), (17, "id=17 is_wide=true speed=1.5".to_owned()));

    let options = VectorOptions {
        columns: Some(vec!["lanes".to_owned()]),
        max_paths: 1,
    };
    let made = vector_tile(&scene, &grid, Tile::WORLD, &all, &options);
    assert_eq!(made.omitted, 2);
    let features = decode(&made.mvt.unwrap());
    assert_eq!(features.len(), 1);
    assert_eq!(features[0].attributes.len(), 2, "{features:?}");

    let elsewhere = Tile::new(3, 7, 7).unwrap();
    let made = vector_tile(&scene, &grid, elsewhere, &[1], &VectorOptions::default());
    assert_eq!((made.mvt, made.omitted), (None, 0));
}
