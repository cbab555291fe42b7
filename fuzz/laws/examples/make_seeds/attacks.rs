//! Makes small files of the kinds that once cost readers too much: each repeats a construct whose
//! cost grew faster than the file.

/// Repetitions: enough for a mutant to multiply, few enough for a short run.
const MANY: usize = 40;

/// Target, name and bytes of each file.
pub(crate) fn files() -> Vec<(&'static str, &'static str, Vec<u8>)> {
    let texts = [
        ("dxf", "arrays-in-arrays.dxf", dxf_arrays()),
        ("dxf", "clip-with-many-corners.dxf", dxf_clip()),
        (
            "geojson",
            "collections-in-collections.json",
            geojson_nested(),
        ),
        ("lanelet2", "one-bound-of-many.osm", lanelet2_shared()),
        (
            "lif",
            "back-and-forth.json",
            lif_curve(|i| [(i % 2) as f64 * 1e8, (i % 3) as f64 * 1e8]),
        ),
        ("lif", "star.json", lif_star()),
        ("lif", "types-of-one-edge.json", lif_types()),
        (
            "lif",
            "wide-curve.json",
            lif_curve(|i| [i as f64, (i * 7919 % 13) as f64]),
        ),
        (
            "opendrive",
            "sections-of-one-road.xodr",
            opendrive_sections(),
        ),
        ("opentcs", "members-of-blocks.xml", opentcs_blocks()),
        ("rmf", "aliases-of-aliases.yaml", rmf_aliases()),
        ("svg", "entities-behind-a-quoted-end.svg", svg_entities()),
        ("svg", "references-to-references.svg", svg_references()),
        ("svg", "rules-of-one-class.svg", svg_rules()),
        ("vda5050", "same-node.json", vda5050_same_node()),
    ];
    let texts = texts.into_iter();
    texts
        .map(|(target, name, text)| (target, name, text.into_bytes()))
        .collect()
}

fn repeat(each: impl Fn(usize) -> String, between: &str) -> String {
    let all: Vec<String> = (0..MANY).map(each).collect();
    all.join(between)
}

fn lif(nodes: &str, edges: &str) -> String {
    format!(
        "{{\"metaInformation\": {{\"lifVersion\": \"1.0.0\"}}, \"layouts\": \
         [{{\"layoutId\": \"L\",\n\
         \"nodes\": [{nodes}],\n\"edges\": [{edges}], \"stations\": []}}]}}\n"
    )
}

fn lif_node(id: &str, x: usize, y: usize) -> String {
    format!("{{\"nodeId\": \"{id}\", \"nodePosition\": {{\"x\": {x}, \"y\": {y}}}}}")
}

fn lif_edge(id: usize, end: &str, types: &str) -> String {
    format!(
        "{{\"edgeId\": \"{id}\", \"startNodeId\": \"A\", \"endNodeId\": \"{end}\", \
         \"vehicleTypeEdgeProperties\": [{types}]}}"
    )
}

fn lif_star() -> String {
    let around = repeat(|i| lif_node(&i.to_string(), i % 9 + 1, i / 9 + 1), ",\n");
    let edges = repeat(
        |i| lif_edge(i, &i.to_string(), "{\"vehicleTypeId\": \"t\"}"),
        ",\n",
    );
    lif(&format!("{},\n{around}", lif_node("A", 0, 0)), &edges)
}

fn lif_types() -> String {
    let types = repeat(|i| format!("{{\"vehicleTypeId\": \"{i}\"}}"), ",\n");
    let nodes = [lif_node("A", 0, 0), lif_node("B", 9, 0)].join(", ");
    lif(&nodes, &lif_edge(0, "B", &types))
}

fn lif_curve(at: impl Fn(usize) -> [f64; 2]) -> String {
    let point = |i| {
        let [x, y] = at(i);
        format!("{{\"x\": {x}, \"y\": {y}, \"weight\": {}}}", 1 + i % 5)
    };
    let degree = 25;
    let knot = |i: usize| i.clamp(degree, MANY) - degree;
    let knots: Vec<String> = (0..=MANY + degree).map(|i| knot(i).to_string()).collect();
    let curve = format!(
        "{{\"vehicleTypeId\": \"t\", \"trajectory\": {{\"degree\": {degree}, \
         \"knotVector\": [{}],\n\
         \"controlPoints\": [{}]}}}}",
        knots.join(", "),
        repeat(point, ",\n")
    );
    let nodes = [lif_node("A", 0, 0), lif_node("B", 9, 0)].join(", ");
    lif(&nodes, &lif_edge(0, "B", &curve))
}

fn svg(before: &str, content: &str) -> String {
    format!(
        "{before}<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" height=\"9mm\" \
         stroke=\"red\">\n{content}\n</svg>\n"
    )
}

/// The end of the document type within a quoted value is not its end.
fn svg_entities() -> String {
    let nest = |i: usize| format!("<!ENTITY e{} \"{}\">", i + 1, format!("&e{i};").repeat(4));
    let nests: Vec<String> = (0..4).map(nest).collect();
    let subset = format!(
        "<!DOCTYPE svg [<!ENTITY q \"]>\"> <?x ]> ?>\n<!ENTITY e0 \"0 1 \">\n{}]>\n",
        nests.join("\n")
    );
    svg(&subset, "<polyline points=\"&e4; 9 9\"/>")
}

fn svg_rules() -> String {
    let rules = repeat(|_| ".a{stroke:red}".to_owned(), "\n");
    let groups = repeat(|_| "<g class=\"a\"/>".to_owned(), "\n");
    svg(
        "",
        &format!("<style>{rules}</style>{groups}<line class=\"a\" x2=\"9\"/>"),
    )
}

fn svg_references() -> String {
    let uses =
        |i: usize| format!("<use href=\"#g{i}\" style=\"transform-box: fill-box\"/>").repeat(4);
    let group = |i: usize| {
        format!(
            "<g id=\"g{}\" transform=\"scale(1)\">{}</g>",
            i + 1,
            uses(i)
        )
    };
    let groups: Vec<String> = (0..4).map(group).collect();
    let line = "<line id=\"g0\" x2=\"9\"/>";
    svg(
        "",
        &format!("<defs>{line}\n{}</defs>{}", groups.join("\n"), uses(4)),
    )
}

/// Lines of `code value` as lines of a drawing in meters.
fn dxf(blocks: &str, entities: &str, objects: &str) -> String {
    let pairs = format!(
        "0 SECTION|2 HEADER|9 $INSUNITS|70 6|0 ENDSEC|0 SECTION|2 BLOCKS|{blocks}|0 ENDSEC|\
         0 SECTION|2 ENTITIES|{entities}|0 ENDSEC|0 SECTION|2 OBJECTS|{objects}|0 ENDSEC|0 EOF"
    );
    let lines = pairs.split('|').filter_map(|pair| pair.split_once(' '));
    lines
        .map(|(code, value)| format!("{code}\n{value}\n"))
        .collect()
}

const DXF_LINE: &str = "0 LINE|5 A|8 0|10 0|20 0|11 9|21 9";

fn dxf_arrays() -> String {
    let array = "10 0|20 0|70 9|71 9|44 1|45 1";
    let blocks = format!(
        "0 BLOCK|2 A|10 0|20 0|{DXF_LINE}|0 ENDBLK|0 BLOCK|2 B|10 0|20 0|0 INSERT|5 I|2 A|{array}|\
         0 ENDBLK"
    );
    dxf(
        &blocks,
        &format!("0 INSERT|5 J|2 B|{array}"),
        "0 DICTIONARY|5 D",
    )
}

fn dxf_clip() -> String {
    let block = format!("0 BLOCK|2 A|10 0|20 0|{DXF_LINE}|0 ENDBLK");
    let corners = repeat(|i| format!("10 {}|20 {}", i % 2 * 9, i * 9 / MANY), "|");
    let matrix = "40 1|40 0|40 0|40 0|40 0|40 1|40 0|40 0|40 0|40 0|40 1|40 0";
    let objects = format!(
        "0 DICTIONARY|5 D|330 I|0 DICTIONARY|5 E|330 D|0 SPATIAL_FILTER|5 F|330 E|70 {MANY}|\
         {corners}|71 1|{matrix}|{matrix}"
    );
    dxf(&block, "0 INSERT|5 I|2 A|10 0|20 0", &objects)
}

fn geojson_nested() -> String {
    let open = "{\"type\": \"GeometryCollection\", \"geometries\": [".repeat(MANY);
    let line = "{\"type\": \"LineString\", \"coordinates\": [[0, 0], [1e-5, 0]]}";
    format!("{open}{line}{}\n", "]}".repeat(MANY))
}

fn opentcs_blocks() -> String {
    let point = |name: &str, x: usize| {
        format!("<point name=\"{name}\" positionX=\"{x}\" positionY=\"0\" type=\"HALT_POSITION\"/>")
    };
    let path = |i: usize| {
        format!(
            "<path name=\"{i}\" sourcePoint=\"A\" destinationPoint=\"B\" length=\"1\" \
             maxVelocity=\"1\" maxReverseVelocity=\"0\"/>"
        )
    };
    let members = repeat(|i| format!("<member name=\"{i}\"/>"), "");
    format!(
        "<?xml version=\"1.0\"?>\n<model version=\"6.0.0\" name=\"m\">{}{}\n{}\n{}\n</model>\n",
        point("A", 0),
        point("B", 9000),
        repeat(path, "\n"),
        format!("<block name=\"b\" type=\"SINGLE_VEHICLE_ONLY\">{members}</block>\n").repeat(3)
    )
}

fn opendrive_sections() -> String {
    let width = "<width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/>";
    let section = |i: usize| {
        format!(
            "<laneSection s=\"{i}\"><center><lane id=\"0\" type=\"none\"/></center><right>\
             <lane id=\"-1\" type=\"driving\">{width}</lane></right></laneSection>"
        )
    };
    format!(
        "<OpenDRIVE><header revMajor=\"1\" revMinor=\"6\"/><road id=\"1\" length=\"{MANY}\" \
         junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{MANY}\">\
         <line/></geometry></planView><lanes>\n{}\n</lanes></road></OpenDRIVE>\n",
        repeat(section, "\n")
    )
}

fn lanelet2_shared() -> String {
    let node = |i: usize| {
        format!(
            "<node id='{}'><tag k='local_x' v='{}'/><tag k='local_y' v='{}'/></node>",
            i + 1,
            i / 2,
            i % 2 * 3
        )
    };
    let way = |id: usize, first: usize| {
        let nodes = (first..=MANY)
            .step_by(2)
            .map(|i| format!("<nd ref='{i}'/>"));
        format!("<way id='{id}'>{}</way>", nodes.collect::<String>())
    };
    let lanelet = |i: usize| {
        format!(
            "<relation id='{}'><member type='way' ref='101' role='left'/><member type='way' \
             ref='102' role='right'/><tag k='subtype' v='road'/><tag k='type' v='lanelet'/>\
             </relation>",
            200 + i
        )
    };
    format!(
        "<osm version='0.6'>\n{}\n{}\n{}\n{}\n</osm>\n",
        repeat(node, "\n"),
        way(101, 2),
        way(102, 1),
        repeat(lanelet, "\n")
    )
}

fn rmf_aliases() -> String {
    let nest = |i: usize| {
        format!(
            "a{}: &a{} [{}]\n",
            i + 1,
            i + 1,
            vec![format!("*a{i}"); 4].join(", ")
        )
    };
    let nests: String = (0..4).map(nest).collect();
    format!(
        "a0: &a0 [0, 0, 0, a]\n{nests}levels:\n  L1:\n    vertices: [*a0, [9, 0, 0, b]]\n    \
         lanes:\n      - [0, 1, {{}}]\nname: site\n"
    )
}

fn vda5050_same_node() -> String {
    let node = |i: usize| {
        format!(
            "{{\"nodeId\": \"A\", \"sequenceId\": {}, \"released\": true, \"actions\": [], \
             \"nodePosition\": {{\"x\": {i}, \"y\": 0, \"mapId\": \"hall\"}}}}",
            2 * i
        )
    };
    let edge = |i: usize| {
        format!(
            "{{\"edgeId\": \"E\", \"sequenceId\": {}, \"released\": true, \"actions\": [], \
             \"startNodeId\": \"A\", \"endNodeId\": \"A\"}}",
            2 * i + 1
        )
    };
    format!(
        "{{\"headerId\": 1, \"version\": \"2.0.0\", \"orderId\": \"O\", \"orderUpdateId\": 0,\n\
         \"nodes\": [{}],\n\"edges\": [{}]}}\n",
        repeat(node, ",\n"),
        repeat(edge, ",\n")
    )
}
