//! Files of other formats: names the formats that people take for layouts, and the way to one that
//! is read.

use guideway_layout::Place;

use crate::sniff::{format_of_key, root_keys, root_tag};
use crate::text::without_mark;
use crate::{Format, Problem};

const UNPACK: &str = "Unpack it first; of packed files, only those of gzip are read";
const CONVERT: &str = "Convert it with GDAL: `ogr2ogr -f GeoJSON FILE.geojson FILE`";
const IMAGE: &str = "Show it below a layout with `--floor-plan`, or trace it in a drawing program \
                     that writes SVG or DXF";
const COMMENTS: &str = "If it is JSON, remove them: JSON has no comments";
const TABLE: &str = "Convert it to Arrow, which is Feather of version 2: \
                     pyarrow.feather.write_feather";

const DRAWING: &str = "Export the drawing as DXF or SVG from the program that wrote it";
const PLAN: &str = "Export a plan of it as DXF or SVG from the program that wrote it";
const OSM: &str = "Convert it: `osmium cat FILE -o FILE.osm`; lanelets are read";
const RECORDING: &str = "Export the map or the route from it; a recording is no layout";

/// First bytes, name and remedy of formats.
const FIRST_BYTES: &[(&[u8], &str, &str)] = &[
    (b"PK\x03\x04", "a ZIP archive", UNPACK),
    (b"\x28\xB5\x2F\xFD", "a file packed with zstd", UNPACK),
    (b"\xFD7zXZ\0", "a file packed with xz", UNPACK),
    (b"BZh", "a file packed with bzip2", UNPACK),
    (b"7z\xBC\xAF\x27\x1C", "a 7z archive", UNPACK),
    (b"Rar!", "a RAR archive", UNPACK),
    (b"\x89PNG", "a PNG image", IMAGE),
    (b"\xFF\xD8\xFF", "a JPEG image", IMAGE),
    (b"GIF8", "a GIF image", IMAGE),
    (b"P1\n", "a PBM image", IMAGE),
    (b"P1 ", "a PBM image", IMAGE),
    (b"P2\n", "a PGM image", IMAGE),
    (b"P2 ", "a PGM image", IMAGE),
    (b"P3\n", "a PPM image", IMAGE),
    (b"P3 ", "a PPM image", IMAGE),
    (b"P4\n", "a PBM image", IMAGE),
    (b"P4 ", "a PBM image", IMAGE),
    (b"P5\n", "a PGM image", IMAGE),
    (b"P5 ", "a PGM image", IMAGE),
    (b"P6\n", "a PPM image", IMAGE),
    (b"P6 ", "a PPM image", IMAGE),
    (b"P7\n", "a PAM image", IMAGE),
    (b"II*\0", "a TIFF image", IMAGE),
    (b"MM\0*", "a TIFF image", IMAGE),
    (
        b"%PDF-",
        "a PDF document",
        "Export the drawing as DXF or SVG; Inkscape converts PDF to SVG",
    ),
    (
        b"SQLite format 3\0",
        "a GeoPackage or another database",
        CONVERT,
    ),
    (b"\0\0\x27\x0A", "a shapefile", CONVERT),
    (b"fgb\x03", "FlatGeobuf", CONVERT),
    (b"\x08\x09\xFE\x02", "a DGN drawing", DRAWING),
    (b"\xC8\x09\xFE\x02", "a DGN drawing", DRAWING),
    (
        b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1",
        "a document of DGN 8, Revit, Visio or an old office program",
        DRAWING,
    ),
    (b"%!PS", "a PostScript drawing", DRAWING),
    (b"ISO-10303-21;", "a STEP or IFC model", PLAN),
    (b"glTF", "a glTF model", PLAN),
    (b"RIFF", "a WebP image or another RIFF file", IMAGE),
    (b"#ROSBAG", "a recording of ROS", RECORDING),
    (b"\x89MCAP", "a recording of ROS", RECORDING),
    (b"# .PCD", "a point cloud", PLAN),
    (b"\x1F\x8B", "a file packed twice with gzip", UNPACK),
    (b"//", "a text with comments", COMMENTS),
    (b"/*", "a text with comments", COMMENTS),
    (
        b"version https://git-lfs",
        "a pointer of Git LFS, not the file itself,",
        "Fetch the file: `git lfs pull`",
    ),
];

/// First words of well-known text.
const WKT: &[&[u8]] = &[
    b"SRID=",
    b"POINT",
    b"LINESTRING",
    b"POLYGON",
    b"MULTIPOINT",
    b"MULTILINESTRING",
    b"MULTIPOLYGON",
    b"GEOMETRYCOLLECTION",
    b"CIRCULARSTRING",
    b"COMPOUNDCURVE",
];

/// Root element, name and remedy of formats in XML.
const ROOTS: &[(&[u8], &str, &str)] = &[
    (b"kml", "KML", CONVERT),
    (b"gpx", "GPX", CONVERT),
    (b"LandXML", "LandXML", DRAWING),
    (b"IndoorFeatures", "IndoorGML", CONVERT),
    (b"CityModel", "CityGML", CONVERT),
    (b"FeatureCollection", "GML", CONVERT),
    (
        b"net",
        "a network of SUMO",
        "Convert it: `netconvert -s FILE --opendrive-output FILE.xodr`",
    ),
    (
        b"html",
        "a web page",
        "Download the file itself: a page about it, or of an error, was saved in its place",
    ),
];

/// Returns the problem of a file of another format that is known.
pub(crate) fn other_format(bytes: &[u8]) -> Option<Problem> {
    let text = without_mark(bytes).trim_ascii_start();
    let problem = |what: &str, remedy: &str| Problem::Unsupported {
        place: Place::element("the file"),
        what: what.to_owned(),
        remedy: remedy.to_owned(),
    };
    let table = |what, read| problem(what, &format!("{TABLE}({read}(\"FILE\"), \"FILE.arrow\")"));
    match bytes {
        [b'P', b'A', b'R', b'1', ..] => {
            return Some(table("a Parquet table", "pyarrow.parquet.read_table"));
        }
        [b'F', b'E', b'A', b'1', ..] => {
            return Some(table("Feather of version 1", "pyarrow.feather.read_table"));
        }
        [b'A', b'C', b'1', b'0', version @ ..]
            if version.first().is_some_and(u8::is_ascii_digit) =>
        {
            let remedy =
                "Save it as DXF in the CAD program, or convert it with the ODA File Converter";
            return Some(problem("a DWG drawing", remedy));
        }
        _ => {}
    }
    let known = match text.first()? {
        b'<' => {
            let root = root_tag(text);
            let mut roots = ROOTS.iter();
            roots.find(|(name, ..)| name.eq_ignore_ascii_case(root))
        }
        b'{' => return json_problem(text, problem),
        b'[' if is_array_of_layouts(text) => {
            let remedy = "Write each layout to a file of its own; commands take several files";
            return Some(problem("an array of layouts", remedy));
        }
        0 if bytes.get(6..15) == Some(b"OSMHeader") => {
            return Some(problem("OpenStreetMap data in the PBF format", OSM));
        }
        _ if is_wkt(text) => return Some(problem("well-known text (WKT)", CONVERT)),
        _ => {
            let mut all = FIRST_BYTES.iter();
            let found = all.find(|(first, ..)| bytes.starts_with(first));
            if found.is_none() && is_table(text) {
                let remedy = "Write it as GeoJSON, such as by `ogr2ogr`, or as Arrow with a column \
                              `control_points`";
                return Some(problem("a table of separated values (CSV)", remedy));
            }
            found
        }
    };
    known.map(|(_, what, remedy)| problem(what, remedy))
}

/// Returns whether a text begins with a geometry as well-known text, such as `LINESTRING Z (`.
fn is_wkt(text: &[u8]) -> bool {
    WKT.iter().any(|word| {
        let (head, rest) = text.split_at(text.len().min(word.len()));
        let is_mark = |byte: &u8| matches!(byte.to_ascii_uppercase(), b'Z' | b'M' | b' ');
        let next = rest.iter().find(|byte| !is_mark(byte));
        head.eq_ignore_ascii_case(word) && matches!(next, Some(b'(' | b'0'..=b'9'))
    })
}

/// Returns whether the first lines of a text have the same separators, as those of a table do.
fn is_table(text: &[u8]) -> bool {
    let Ok(text) = str::from_utf8(&text[..text.len().min(4096)]) else {
        return false;
    };
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let (Some(head), Some(first)) = (lines.next(), lines.next()) else {
        return false;
    };
    // Names stand in the head, and no mark that another syntax has.
    let is_head = head.chars().all(|c| !"{}[]<>=\\".contains(c)) && !head.contains(": ");
    let count = |line: &str, separator: char| line.matches(separator).count();
    let mut separators = [',', ';', '\t'].into_iter();
    is_head && separators.any(|s| count(head, s) > 0 && count(head, s) == count(first, s))
}

/// Returns whether the first object of an array has a key of LIF.
fn is_array_of_layouts(text: &[u8]) -> bool {
    let object = text[1..].trim_ascii_start();
    object.starts_with(b"{") && root_keys(object).find_map(format_of_key) == Some(Format::Lif)
}

/// The problem of a JSON text whose root object has a key of another format, before any key of a
/// layout.
fn json_problem(text: &[u8], problem: impl Fn(&str, &str) -> Problem) -> Option<Problem> {
    let mut keys = root_keys(text).take_while(|key| format_of_key(key).is_none());
    keys.find_map(|key| match key {
        b"arcs" => Some(problem("TopoJSON", CONVERT)),
        b"geometryType" | b"spatialReference" => Some(problem("Esri JSON", CONVERT)),
        _ => None,
    })
}
