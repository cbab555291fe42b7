//! Generated bad files that are too large to store, by the names in the tables of expected
//! outcomes.

mod roads;

/// Start of a small LIF file, which the generated ones vary.
const LIF_HEAD: &str = r#"{"layouts": [{"layoutId": "L", "nodes": [
    {"nodeId": "A", "nodePosition": {"x": 0, "y": 0}},
    {"nodeId": "B", "nodePosition": {"x": 10, "y": 0}}], "edges": ["#;

const MILLION: usize = 1_000_000;
/// Elements that are read: a quadratic step over that number takes minutes.
const MANY: usize = 250_000;

/// Generates the file of a name in a folder of bad files.
pub(crate) fn generate(folder: &str, name: &str) -> Option<Vec<u8>> {
    match folder {
        "lif" => lif(name).map(String::into_bytes),
        "opentcs" => open_tcs(name).map(String::into_bytes),
        "dxf" => dxf(name).map(String::into_bytes),
        "geojson" => geojson(name).map(String::into_bytes),
        "vda5050" => vda_5050(name).map(String::into_bytes),
        "rmf" => roads::rmf(name).map(String::into_bytes),
        "svg" => roads::svg(name).map(String::into_bytes),
        "opendrive" => roads::opendrive(name).map(String::into_bytes),
        "lanelet2" => roads::lanelet2(name).map(String::into_bytes),
        "any" => any(name),
        _ => None,
    }
}

fn lif(name: &str) -> Option<String> {
    Some(match name {
        "deep-lists" => format!("{{\"layouts\": {}", "[".repeat(MILLION)),
        "deep-objects" => format!("{{\"layouts\": {}", "{\"a\":".repeat(MILLION)),
        "deep-unknown-key" => {
            let (open, close) = ("[".repeat(MILLION), "]".repeat(MILLION));
            format!("{{\"x\": {open}{close}, \"layouts\": []}}")
        }
        "deep-attribute" => {
            let (open, close) = ("[".repeat(200), "]".repeat(200));
            edge(&format!(r#"{{"maxSpeed": {open}{close}}}"#))
        }
        "many-empty-edges" => edges(&vec!["{}"; MANY].join(",")),
        "many-equal-nodes" => {
            let node = r#"{"nodeId":"A","nodePosition":{"x":1,"y":1}}"#;
            let nodes = vec![node; MANY].join(",");
            format!(r#"{{"layouts": [{{"layoutId": "L", "nodes": [{nodes}]}}]}}"#)
        }
        "many-layouts" => format!(r#"{{"layouts": [{}]}}"#, vec!["{}"; MANY].join(",")),
        "many-types-of-one-edge" => edge(&join(MANY, |i| format!(r#"{{"vehicleTypeId":"{i}"}}"#))),
        "curves-of-one-edge" => edge(&join(10_000, |i| {
            format!(r#"{{"trajectory":{{"controlPoints":[{{"x":0,"y":0}},{{"x":{i},"y":9}}]}}}}"#)
        })),
        "long-id" => edges(&format!(r#"{{"edgeId": "{}"}}"#, "E".repeat(2 * MILLION))),
        "long-knots" => {
            let knots = vec!["0"; MILLION + 1].join(",");
            edge(&format!(r#"{{"trajectory": {{"knotVector": [{knots}]}}}}"#))
        }
        "long-load-sets" => {
            let sets = vec![r#""set""#; MILLION].join(",");
            edge(&format!(
                r#"{{"loadRestriction": {{"loadSetNames": [{sets}]}}}}"#
            ))
        }
        "many-repeated-keys" => edges(&format!(
            r#"{{{}"edgeId": "E", "startNodeId": "A", "endNodeId": "B",
                "vehicleTypeEdgeProperties": [{{}}]}}"#,
            r#""edgeId": "E","#.repeat(MANY)
        )),
        "long-number" => edge("{}").replace("10,", &format!("9.{},", "9".repeat(MILLION))),
        "heavy-rational" => {
            let points = join(100_000, |i| {
                format!(
                    r#"{{"x":{},"y":1e8,"weight":{}}}"#,
                    i % 2 * 100_000_000,
                    i % 7 + 1
                )
            });
            edge(&format!(
                r#"{{"trajectory": {{"degree": 3, "knotVector": [{}],
                "controlPoints": [{points}]}}}}"#,
                join(100_004, |i| i.clamp(3, 100_000).to_string())
            ))
        }
        _ => return None,
    })
}

fn edges(edges: &str) -> String {
    format!("{LIF_HEAD}{edges}]}}]}}")
}

fn edge(properties: &str) -> String {
    edges(&format!(
        r#"{{"edgeId": "E", "startNodeId": "A", "endNodeId": "B",
            "vehicleTypeEdgeProperties": [{properties}]}}"#
    ))
}

fn join(count: usize, item: impl Fn(usize) -> String) -> String {
    (0..count).map(item).collect::<Vec<_>>().join(",")
}

fn vda_5050(name: &str) -> Option<String> {
    Some(match name {
        "deep-actions" => {
            let (open, close) = ("[".repeat(200), "]".repeat(200));
            format!(r#"{{"nodes": [{{"nodeId": "A", "actions": {open}{close}}}], "edges": []}}"#)
        }
        "many-equal-nodes" => {
            let node = r#"{"nodeId":"A","sequenceId":0,"nodePosition":{"x":1,"y":1}}"#;
            format!(r#"{{"nodes": [{}]}}"#, vec![node; MANY].join(","))
        }
        "many-empty-edges" => format!(r#"{{"edges": [{}]}}"#, vec!["{}"; MANY].join(",")),
        "million-maps" => {
            let node = |i| {
                let position = format!(r#"{{"x":0,"y":0,"mapId":"{i}"}}"#);
                format!(r#"{{"nodeId":"{i}","nodePosition":{position}}}"#)
            };
            format!(r#"{{"nodes": [{}]}}"#, join(MILLION / 10, node))
        }
        // The key that identifies the format comes last, after many nested keys.
        "late-key" => format!(r#"{{{}"nodes": []}}"#, r#""a": {"b": []},"#.repeat(MILLION)),
        _ => return None,
    })
}

fn dxf(name: &str) -> Option<String> {
    let file = |blocks: &str, entities: &str| {
        format!(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n\
             0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n\
             0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
        )
    };
    let block = |name: &str, content: &str| {
        format!("0\nBLOCK\n2\n{name}\n10\n0\n20\n0\n{content}0\nENDBLK\n")
    };
    let insert = |name: &str| format!("0\nINSERT\n2\n{name}\n10\n1\n20\n0\n");
    let line = "0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n";
    let repeat =
        |count: usize, item: &dyn Fn(usize) -> String| -> String { (0..count).map(item).collect() };
    Some(match name {
        // Ten inserts per level: 10^10 lines from a kilobyte.
        "billion-lines" => {
            let level =
                |i: usize| block(&format!("{i}"), &insert(&format!("{}", i + 1)).repeat(10));
            let blocks = repeat(10, &level) + &block("10", line);
            file(&blocks, &insert("0"))
        }
        "deep-blocks" => {
            let level = |i: usize| block(&format!("{i}"), &insert(&format!("{}", i + 1)));
            file(&repeat(MILLION / 10, &level), &insert("0"))
        }
        "wide-blocks" => file(&repeat(MILLION / 10, &|i| block(&i.to_string(), line)), ""),
        "many-inserts-of-a-ring" => {
            let ring = block("A", &(line.repeat(MILLION / 10) + &insert("A")));
            file(&ring, &insert("A").repeat(MILLION / 100))
        }
        "long-polyline" => {
            let vertices = repeat(MILLION + 1, &|i| format!("10\n{i}\n20\n0\n"));
            file("", &format!("0\nLWPOLYLINE\n{vertices}"))
        }
        "long-spline" => file("", &format!("0\nSPLINE\n{}", "40\n0\n".repeat(8 * MILLION))),
        "many-kinds" => file("", &repeat(MILLION / 10, &|i| format!("0\nK{i}\n"))),
        "many-layers" => {
            let on = |i| format!("0\nLINE\n8\nL{i}\n10\n0\n20\n0\n11\n1\n21\n{i}\n");
            file("", &repeat(MILLION / 100, &on))
        }
        "long-layer" => {
            let name = "L".repeat(2 * MILLION);
            file(
                "",
                &format!("0\nLINE\n8\n{name}\n10\n0\n20\n0\n11\n1\n21\n1\n"),
            )
        }
        // Arcs of the largest radius, which convert to the most control points.
        "circles-of-one-block" => {
            let circle = "0\nCIRCLE\n10\n0\n20\n0\n40\n9e8\n";
            let array = format!("{}70\n100\n71\n900\n", insert("A"));
            file(&block("A", circle), &array)
        }
        "heavy-splines" => {
            let knots = repeat(104, &|i| format!("40\n{}\n", i.clamp(3, 100)));
            let points = |i| format!("10\n{}\n20\n9e8\n41\n{}\n", i % 2 * 900_000_000, i % 7 + 1);
            let spline = format!("0\nSPLINE\n71\n3\n{knots}{}", repeat(100, &points));
            let array = format!("{}70\n200\n71\n100\n", insert("A"));
            file(&block("A", &spline), &array)
        }
        "noise-after-section" => {
            let noise: String = any("noise")?.into_iter().map(char::from).collect();
            format!("0\nSECTION\n{noise}")
        }
        _ => return None,
    })
}

fn geojson(name: &str) -> Option<String> {
    let line =
        |coordinates: &str| format!(r#"{{"type": "LineString", "coordinates": {coordinates}}}"#);
    let with = |properties: &str| {
        let line = line("[[0,0],[1000,0]]");
        format!(r#"{{"features": [{{"properties": {{{properties}}}, "geometry": {line}}}]}}"#)
    };
    Some(match name {
        "deep-coordinates" => line(&["[".repeat(MILLION), "]".repeat(MILLION)].concat()),
        "deep-properties" => with(&[r#""a":{"#.repeat(100), "}".repeat(100)].concat()),
        "deep-collections" => r#"{"geometries":["#.repeat(MILLION),
        "million-points" => {
            let point = r#"{"geometry":{"type":"Point","coordinates":[1000,0]}}"#;
            format!(
                r#"{{"features": [{}]}}"#,
                vec![point; MILLION / 4].join(",")
            )
        }
        "many-positions" => line(&format!("[{}]", join(MANY, |i| format!("[{i},0]")))),
        "long-line" => line(&format!("[{}]", vec!["[0,0]"; MILLION + 1].join(","))),
        "many-properties" => with(&join(MANY, |i| format!(r#""p{i}":1"#))),
        // The name of each value contains the long name of its object.
        "long-names" => {
            let inner = join(MILLION / 4, |i| format!(r#""{i}":1"#));
            with(&format!(r#""{}":{{{inner}}}"#, "n".repeat(MILLION)))
        }
        "wide-columns" => {
            let feature = |i| {
                let line = line("[[0,0],[1000,0]]");
                format!(r#"{{"properties":{{"p{i}":{i}}},"geometry":{line}}}"#)
            };
            format!(r#"{{"features": [{}]}}"#, join(20_000, feature))
        }
        _ => return None,
    })
}

fn open_tcs(name: &str) -> Option<String> {
    let model = |content: &str| format!("<model>{content}</model>");
    Some(match name {
        "deep-elements" => format!("<model>{}", "<a>".repeat(MILLION)),
        "deep-closed-elements" => model(&["<a>".repeat(MILLION), "</a>".repeat(MILLION)].concat()),
        "many-attributes" => {
            let attributes: String = (0..100_000).map(|i| format!(" a{i}=''")).collect();
            format!("<model{attributes}/>")
        }
        "many-namespaces" => {
            let one = |i| format!("<point xmlns:n{i}='n{i}'/>");
            model(&(0..100_000).map(one).collect::<String>())
        }
        "many-equal-points" => {
            let point = "<point name='A' positionX='1' positionY='1'/>";
            format!("<model version='7.0.0'>{}</model>", point.repeat(300_000))
        }
        "many-control-points" => {
            let control = "<controlPoint x='1' y='1'/>".repeat(MILLION + 1);
            model(&format!(
                "<path name='P'><pathLayout connectionType='POLYPATH'>{control}</pathLayout></path>"
            ))
        }
        "many-members" => model(&format!(
            "<block name='K'>{}</block>",
            "<member name='P'/>".repeat(MANY)
        )),
        "long-name" => {
            let name = "A".repeat(2 * MILLION);
            model(&format!(
                "<point name='{name}' positionX='1' positionY='1'/>"
            ))
        }
        "million-entities" => {
            let name = "&amp;".repeat(2 * MILLION);
            model(&format!(
                "<point name='{name}' positionX='1' positionY='1'/>"
            ))
        }
        "long-comment" => model(&format!("<!--{}-->", "<".repeat(10 * MILLION))),
        "many-links" => {
            let links = "<link point='Z'/>".repeat(300_000);
            model(&format!(
                "<location name='L' positionX='0' positionY='0'>{links}</location>"
            ))
        }
        "many-empty-paths" => model(&"<path/>".repeat(300_000)),
        _ => return None,
    })
}

fn any(name: &str) -> Option<Vec<u8>> {
    Some(match name {
        "zeros" => vec![0; MILLION],
        "spaces" => vec![b' '; MILLION],
        "all-bytes" => (0..=255).collect(),
        "noise" => {
            // A linear congruential generator: the same bytes on every machine.
            let mut state = 7_u32;
            let mut next = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 24) as u8
            };
            (0..MILLION).map(|_| next()).collect()
        }
        _ => return None,
    })
}
