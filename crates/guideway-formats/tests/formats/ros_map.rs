//! Tests of ROS maps: placement, orientation, errors, damaged files.

use std::fs;
use std::path::Path;

use guideway_formats::ros_map::{self, OCCUPIED, OccupancyGrid, UNKNOWN};
use guideway_formats::{ReadError, ReadOptions, read_file};
use guideway_layout::Limits;
use guideway_spline::Point;

/// A correct map of 3 x 2 cells: wall, unknown, free above free, free, wall.
const MAP: &str = "image: hall.pgm\nmode: trinary\nresolution: 0.5\norigin: [10.0, 20.0, 0]\n\
                   negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
const IMAGE: &[u8] = b"P5\n3 2\n255\n\x00\xCD\xFE\xFE\xFE\x00";

fn read(map: &[u8], image: &[u8]) -> Result<OccupancyGrid, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("hall.pgm"), image).unwrap();
    let path = folder.path().join("hall.yaml");
    fs::write(&path, map).unwrap();
    ros_map::read_file(&path, &ReadOptions::default())
}

/// The map with the line of a field replaced.
fn with(field: &str, line: &str) -> String {
    let begins = |l: &&str| l.starts_with(field);
    assert_eq!(MAP.lines().filter(begins).count(), 1, "{field}");
    let lines = MAP.lines().map(|l| if begins(&l) { line } else { l });
    lines.collect::<Vec<_>>().join("\n")
}

fn error(map: &str) -> String {
    let error = read(map.as_bytes(), IMAGE)
        .err()
        .unwrap_or_else(|| panic!("accepted: {map}"));
    assert!(!error.remedy().is_empty());
    format!("{error}")
}

#[test]
fn rows_go_top_down_and_the_lower_left_corner_is_the_origin() {
    let grid = read(MAP.as_bytes(), IMAGE).unwrap();
    assert_eq!((grid.width, grid.height), (3, 2));
    assert_eq!(grid.cells, [OCCUPIED, UNKNOWN, 0, 0, 0, OCCUPIED]);
    let world = grid.placement.world_from_image(grid.height);
    let near = |x, y, to: (f64, f64)| {
        let at = world.apply(Point::new(x, y));
        assert!(at.distance(Point::new(to.0, to.1)) < 1e-9, "{at:?}");
    };
    near(0.0, 2.0, (10.0, 20.0));
    near(0.0, 0.0, (10.0, 21.0));
    near(3.0, 2.0, (11.5, 20.0));
}

#[test]
fn bitmaps_and_colors_are_maps_too() {
    let cells = |image: &[u8]| read(MAP.as_bytes(), image).unwrap().cells;
    let expected = [OCCUPIED, 0, 0, 0, 0, OCCUPIED];
    assert_eq!(cells(b"P1\n3 2\n1 0 0\n0 0 1\n"), expected);
    assert_eq!(cells(b"P4\n3 2\n\x80\x20"), expected);
    let rows = "0 0 0 9 9 9 9 9 9 9 9 9 9 9 9 0 0 0";
    assert_eq!(cells(format!("P3 3 2 9 {rows}").as_bytes()), expected);
    let bytes = rows.split(' ').map(|digit| digit.parse::<u8>().unwrap());
    let ppm = b"P6\n3 2\n9\n".iter().copied().chain(bytes);
    assert_eq!(cells(&ppm.collect::<Vec<_>>()), expected);
}

#[test]
fn merged_objects_complete_a_map() {
    let grid = read(MAP.as_bytes(), IMAGE).unwrap();
    let base = "usual: &usual {negate: 1, occupied_thresh: 0.65, free_thresh: 0.196}\n";
    let own = "image: hall.pgm\nresolution: 0.5\norigin: [10.0, 20.0, 0]\nnegate: 0\n";
    let merged = read(format!("{base}{own}<<: *usual\n").as_bytes(), IMAGE).unwrap();
    assert_eq!(merged.cells, grid.cells);
    assert!(error(&format!("{base}{MAP}")).contains("this is no field"));
    assert!(error(&format!("{MAP}<<: 3\n")).contains("`<<` merges objects"));
}

#[test]
fn yaw_turns_counter_clockwise_about_the_origin() {
    let turned = with("origin", "origin: [10.0, 20.0, 1.5707963267948966]");
    let grid = read(turned.as_bytes(), IMAGE).unwrap();
    let world = grid.placement.world_from_image(grid.height);
    let right = world.apply(Point::new(3.0, 2.0));
    assert!(right.distance(Point::new(10.0, 21.5)) < 1e-9, "{right:?}");
    // Of both walls: the upper left one, then the lower right one.
    let walls = grid.walls().unwrap();
    let lowest = |row: usize| {
        let runs = walls.paths.get(row);
        let ends = runs.ends().unwrap();
        ends.0.y.min(ends.1.y)
    };
    assert_eq!(walls.paths.len(), 2);
    assert!((lowest(0) - 20.0).abs() < 1e-9 && (lowest(1) - 21.0).abs() < 1e-9);
}

#[test]
fn images_may_be_text_wide_or_png() {
    let expected = read(MAP.as_bytes(), IMAGE).unwrap().cells;
    let text = b"P2\n# map\n3 2\n255\n0 205 254\n254 254 0\n";
    assert_eq!(read(MAP.as_bytes(), text).unwrap().cells, expected);
    let mut wide = b"P5 3 2 65535\n".to_vec();
    wide.extend(IMAGE[11..].iter().flat_map(|&value| [value, value]));
    assert_eq!(read(MAP.as_bytes(), &wide).unwrap().cells, expected);
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 3, 2);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&IMAGE[11..]).unwrap();
    writer.finish().unwrap();
    assert_eq!(read(MAP.as_bytes(), &file).unwrap().cells, expected);
    let cut = read(MAP.as_bytes(), &file[..file.len() - 20])
        .err()
        .unwrap();
    assert!(cut.to_string().contains("hall.pgm"), "{cut}");
}

#[test]
fn fields_are_read_as_map_servers_read_them() {
    for (field, line) in [
        ("mode", ""),
        ("mode", "mode: \"trinary\"  # as usual"),
        ("negate", "negate: false"),
        ("resolution", "resolution: \"0.5\""),
        ("resolution", "resolution: 5e-1"),
        ("origin", "origin:\n- 10\n- 20.0\n- 0.0"),
    ] {
        let (grid, usual) = (with(field, line), read(MAP.as_bytes(), IMAGE).unwrap());
        let grid = read(grid.as_bytes(), IMAGE).unwrap_or_else(|e| panic!("{line}: {e}"));
        assert_eq!((grid.cells, grid.placement), (usual.cells, usual.placement));
    }
    let negated = read(with("negate", "negate: 1").as_bytes(), IMAGE).unwrap();
    assert_eq!(
        negated.cells,
        [0, OCCUPIED, OCCUPIED, OCCUPIED, OCCUPIED, 0]
    );
}

#[test]
fn wrong_fields_say_where_what_and_what_to_do() {
    for (field, line, said) in [
        (
            "image",
            "",
            &["image: the field is missing", "image: hall.pgm"][..],
        ),
        (
            "image",
            "image: [1]",
            &["image (line 1): this is no file name"],
        ),
        (
            "image",
            "image: gone.pgm",
            &["there is no file", "gone.pgm", "beside"],
        ),
        ("image", "image: .", &["this is a folder"]),
        (
            "resolution",
            "",
            &["resolution: the field is missing", "0.05"],
        ),
        (
            "resolution",
            "resolution: 0",
            &["resolution (line 3): `0`", "0.000001 to 1000"],
        ),
        ("resolution", "resolution: -0.05", &["`-0.05` is no size"]),
        ("resolution", "resolution: .nan", &["`.nan` is no size"]),
        ("resolution", "resolution: NaN", &["`NaN` is no size"]),
        ("resolution", "resolution: 1e300", &["`1e300` is no size"]),
        ("resolution", "resolution: 5 cm", &["`5 cm` is no size"]),
        (
            "origin",
            "origin: [0, 0]",
            &["origin (line 4): 2 values", "in radians"],
        ),
        (
            "origin",
            "origin: [0, x, 0]",
            &["is no list of three numbers"],
        ),
        (
            "origin",
            "origin: [0, .inf, 0]",
            &["is no list of three numbers"],
        ),
        ("origin", "origin: 5", &["`5` is no list"]),
        (
            "origin",
            "origin: [0, 0, 90]",
            &["the yaw 90 exceeds a full turn", "radians"],
        ),
        (
            "origin",
            "origin: [1e12, 0, 0]",
            &["beyond the limit of 1000000000 m"],
        ),
        ("negate", "", &["negate: the field is missing"]),
        ("negate", "negate: 2", &["`2` is neither 0 nor 1"]),
        ("occupied", "", &["occupied_thresh: the field is missing"]),
        (
            "occupied",
            "occupied_thresh: 65",
            &["`65` is no number from 0 to 1"],
        ),
        (
            "occupied",
            "occupied_thresh: 0.1",
            &["0.196 exceeds occupied_thresh, 0.1"],
        ),
        (
            "free",
            "free_thresh:",
            &["free_thresh (line 7): nothing is no number"],
        ),
        (
            "mode",
            "mode: binary",
            &["mode (line 2): `binary` is no mode", "trinary, scale"],
        ),
        (
            "mode",
            "Mode: raw",
            &["Mode (line 2): this is no field", "occupied_thresh"],
        ),
        (
            "mode",
            "negate: 1",
            &["negate (line 5): the field is given twice"],
        ),
        ("mode", "mode: raw\n---", &["a second document"]),
        ("mode", "mode: [", &["line"]),
    ] {
        let text = error(&with(field, line));
        assert!(
            text.contains("hall.yaml") || line == "image: .",
            "{line}: {text}"
        );
        for part in said {
            assert!(text.contains(part), "{line}: {text}");
        }
    }
    for text in ["", "# nothing", "just text", "- a\n- b"] {
        assert!(error(text).contains("hall.yaml"));
    }
}

#[test]
fn images_that_are_damaged_or_too_large_are_named() {
    for (image, said) in [
        (
            &IMAGE[..IMAGE.len() - 1],
            "6 pixels take at least 6 bytes, and 5 follow",
        ),
        (b"P7\nWIDTH 3\n", "PBM, PGM or PPM"),
        (b"GIF89a", "\"GIF89a\""),
        (b"", "the file is empty"),
        (b"P5 100000 100000 255\n", "limits of 1 to 67108864 pixels"),
    ] {
        let error = read(MAP.as_bytes(), image).err().unwrap().to_string();
        assert!(
            error.contains("hall.pgm") && error.contains(said),
            "{error}"
        );
    }
    let long = format!("{MAP}# {}", "x".repeat(1 << 20));
    assert!(error(&long).contains("above the limit of 1048576"));
}

#[test]
fn limits_of_the_caller_hold() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("hall.pgm"), IMAGE).unwrap();
    let path = folder.path().join("hall.yaml");
    fs::write(&path, MAP).unwrap();
    let read = |limits: Limits| {
        let options = ReadOptions {
            limits,
            ..ReadOptions::default()
        };
        ros_map::read_file(&path, &options).err().unwrap()
    };
    let near = read(Limits {
        coordinate_m: 20.5,
        ..Limits::default()
    });
    assert!(near.to_string().contains("limit of 20 m"), "{near}");
    let short = read(Limits {
        file_bytes: 10,
        ..Limits::default()
    });
    assert_eq!(short.code(), "limit");
}

#[test]
fn damaged_bytes_never_panic() {
    for at in 0..MAP.len() {
        let _ = read(&MAP.as_bytes()[..at], IMAGE);
        for byte in *b"\x00\n:[-9\xFF" {
            let mut map = MAP.as_bytes().to_vec();
            map[at] = byte;
            let _ = read(&map, IMAGE);
        }
    }
    for at in 0..IMAGE.len() {
        assert!(read(MAP.as_bytes(), &IMAGE[..at]).is_err(), "{at} bytes");
        for byte in *b"\x00\n#-9\xFF" {
            let mut image = IMAGE.to_vec();
            image[at] = byte;
            let _ = read(MAP.as_bytes(), &image);
        }
    }
}

#[test]
fn a_map_in_place_of_a_layout_says_how_to_use_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("hall.yaml");
    fs::write(&path, MAP).unwrap();
    let error = read_file(&path, &ReadOptions::default()).err().unwrap();
    assert_eq!(error.code(), "floor-plan");
    let text = error.to_string();
    assert!(
        text.contains("ROS map") && text.contains("--floor-plan"),
        "{text}"
    );
}

#[test]
fn real_map_of_a_hall() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/cases/network");
    let path = shared.join("hall.yaml");
    if !path.is_file() {
        println!("SKIPPED: the map of a hall is not at {}", path.display());
        return;
    }
    let grid = ros_map::read_file(&path, &ReadOptions::default()).unwrap();
    assert_eq!((grid.width, grid.height), (200, 100));
    assert!(grid.cells.contains(&OCCUPIED) && grid.cells.contains(&0));
    let walls = grid.walls().unwrap();
    assert!(!walls.paths.is_empty());
}
