//! Tests of growth: reading time against the size of inputs that attack one stage.

use guideway_formats::{ReadOptions, read_bytes};
use guideway_growth::exponent_of_time;

/// Largest exponent of a stage that is linear but for memory and logarithms.
const LINEAR: f64 = 1.5;

/// Checks that the time to read the file of a size grows at most linearly.
fn assert_linear(name: &str, size: usize, file: impl Fn(usize) -> String + Sync) {
    let found = exponent_of_time([size, size * 3, size * 9], file, |text| {
        let _ = read_bytes(name, text.as_bytes(), &ReadOptions::default());
    });
    assert!(found < LINEAR, "{name} grows with the exponent {found:.2}");
}

fn svg(content: &str) -> String {
    let namespace = "http://www.w3.org/2000/svg";
    format!("<svg xmlns='{namespace}' width='9mm' viewBox='0 0 9 9'>{content}</svg>")
}

#[test]
fn styles_are_folded_once() {
    let shape = "<path class='a b' id='i' d='M0 0H1' stroke='red'/>";
    for (name, selector) in [
        ("every element", "*"),
        ("elements", "path"),
        ("classes", ".a"),
        ("elements with a class", "path.b"),
        ("identifiers", "#i"),
    ] {
        assert_linear(name, 300, |size| {
            let rules = format!("{selector}{{fill:red}}").repeat(size);
            svg(&format!("<style>{rules}</style>{}", shape.repeat(size)))
        });
    }
    assert_linear("a long rule", 300, |size| {
        let rule = format!("path{{{}}}", "fill:red;stroke:blue;".repeat(size));
        svg(&format!("<style>{rule}</style>{}", shape.repeat(size)))
    });
    assert_linear("a rule of many selectors", 300, |size| {
        let selectors: Vec<String> = (0..size).map(|i| format!(".c{i}")).collect();
        let rule = format!("{}{{{}}}", selectors.join(","), "fill:red;".repeat(size));
        svg(&format!("<style>{rule}</style>"))
    });
    assert_linear("many sheets", 300, |size| {
        let sheets = "<style>.a{fill:red}</style>".repeat(size);
        svg(&(sheets + &shape.repeat(size)))
    });
}

#[test]
fn repeated_elements_pay_for_their_bytes() {
    // The budget of repetitions is at least 16 MiB, so the sizes begin above it.
    for (name, attribute, part) in [
        ("styles", "style", "fill:red;"),
        ("transforms", "transform", "scale(1)"),
    ] {
        assert_linear(name, 1500, |size| {
            let heavy = format!("<g {attribute}='{}'/>", part.repeat(size));
            let uses = "<use href='#t'/>".repeat(size);
            svg(&format!("<defs><g id='t'>{heavy}</g></defs>{uses}"))
        });
    }
    assert_linear("identifiers of references", 4500, |size| {
        let id = "i".repeat(size);
        let target = format!("<g id='t'>{}</g>", "<g/>".repeat(size));
        svg(&format!("<defs>{target}</defs><use id='{id}' href='#t'/>"))
    });
}

#[test]
fn entities_and_namespaces_are_counted() {
    let document = |declarations: &str, content: &str| {
        format!("<!DOCTYPE svg [{declarations}]>{}", svg(content))
    };
    // The budget of expansions is at least 4 MiB, so the sizes begin above it.
    assert_linear("references to a long entity", 3000, |size| {
        let entity = format!("<!ENTITY a '{}'>", "x".repeat(size));
        document(&entity, &"&a;".repeat(size))
    });
    assert_linear("names of entities that have no end", 3000, |size| {
        document("<!ENTITY a 'x'>", &"<g id='&a&a&a'/>".repeat(size))
    });
    assert_linear("default attributes", 300, |size| {
        let names: String = (0..size).map(|i| format!(" a{i} CDATA 'x'")).collect();
        document(&format!("<!ATTLIST g{names}>"), &"<g/>".repeat(size))
    });
    assert_linear("default attributes of one element", 3000, |size| {
        let names: String = (0..size).map(|i| format!(" a{i} CDATA 'x'")).collect();
        document(&format!("<!ATTLIST g{names}>"), "")
    });
    assert_linear("prefixes", 3000, |size| {
        let outer = |i: usize| format!("<g xmlns:n{i}='u{i}'>");
        let open: String = (0..100).map(outer).collect();
        let inner = "<g n0:a='1'/>".repeat(size);
        svg(&format!("{open}{inner}{}", "</g>".repeat(100)))
    });
}

#[test]
fn roads_of_many_sections_are_linear() {
    let road = |geometry: &str, types: &str, lanes: &str| {
        format!(
            "<OpenDRIVE><road id='1' length='1'>{types}<planView>{geometry}</planView>\
             <lanes>{lanes}</lanes></road></OpenDRIVE>"
        )
    };
    let geometries = |size: usize| -> String {
        let line =
            |s| format!("<geometry s='{s}' x='{s}' y='0' hdg='0' length='1'><line/></geometry>");
        (0..size).map(line).collect()
    };
    let width = "<width sOffset='0' a='3' b='0' c='0' d='0'/>";
    let sections = |size: usize| -> String {
        let lane = format!("<left><lane id='1'>{width}</lane></left>");
        let section = |s| format!("<laneSection s='{s}'>{lane}</laneSection>");
        (0..size).map(section).collect()
    };
    assert_linear("sections beside geometries", 300, |size| {
        road(&geometries(size), "", &sections(size))
    });
    assert_linear("sections beside lane offsets", 300, |size| {
        let offset = |s| format!("<laneOffset s='{s}' a='1' b='0' c='0' d='0'/>");
        let offsets: String = (0..size).map(offset).collect();
        road(&geometries(size), "", &(offsets + &sections(size)))
    });
    let limit = |s| format!("<type s='{s}'><speed max='{}'/></type>", s % 9 + 1);
    assert_linear("sections beside speed limits", 300, |size| {
        let limits: String = (0..size).map(limit).collect();
        road(&geometries(size), &limits, &sections(size))
    });
    assert_linear("lanes beside speed limits", 300, |size| {
        let limits: String = (0..size).map(limit).collect();
        let lane = |id| format!("<lane id='{id}'>{width}</lane>");
        let lanes: String = (1..size).map(lane).collect();
        let line = "<geometry s='0' x='0' y='0' hdg='0' length='1e5'><line/></geometry>";
        let section = format!("<laneSection s='0'><left>{lanes}</left></laneSection>");
        road(line, &limits, &section)
    });
    assert_linear("findings beside sections", 300, |size| {
        let lane = "<left><lane id='1'/></left>";
        let section = |s| format!("<laneSection s='{s}'>{lane}</laneSection>");
        road(
            &geometries(size),
            "",
            &(0..size).map(section).collect::<String>(),
        )
    });
}

#[test]
fn lanelets_that_share_a_long_bound_are_linear() {
    let member = |role| format!("<member type='way' ref='w' role='{role}'/>");
    let lanelet = format!(
        "<relation>{}{}<tag k='type' v='lanelet'/></relation>",
        member("left"),
        member("right")
    );
    for places in [1, 1000] {
        // The budget of control points is at least 262,144, so the sizes begin above it.
        assert_linear("a long bound", 1000, |size| {
            let node = |i| format!("<node id='{i}' lat='{}' lon='8'/>", 49.0 + i as f64 * 1e-6);
            let nodes: String = (0..places).map(node).collect();
            let ends: String = (0..5 * size)
                .map(|i| format!("<nd ref='{}'/>", i % places))
                .collect();
            let way = format!("<way id='w'>{ends}</way>");
            format!(
                "<osm version='0.6'>{nodes}{way}{}</osm>",
                lanelet.repeat(size)
            )
        });
    }
}

#[test]
fn findings_within_one_edge_are_located_at_once() {
    assert_linear("repeated vehicle types", 400, |size| {
        let entries = vec![r#"{"vehicleTypeId": "a"}"#; size].join(", ");
        format!(
            r#"{{"metaInformation": {{"lifVersion": "1.0.0"}}, "layouts": [{{"layoutId": "L",
            "nodes": [{{"nodeId": "A", "nodePosition": {{"x": 0, "y": 0}}}},
            {{"nodeId": "B", "nodePosition": {{"x": 10, "y": 0}}}}], "edges": [{{"edgeId": "E",
            "startNodeId": "A", "endNodeId": "B", "vehicleTypeEdgeProperties": [{entries}]}}],
            "stations": []}}]}}"#
        )
    });
}
