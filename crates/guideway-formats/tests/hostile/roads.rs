//! Generated bad files of Open-RMF, SVG, OpenDRIVE and Lanelet2.

use super::{MILLION, join};

pub(super) fn rmf(name: &str) -> Option<String> {
    let level = |vertices: &str, lanes: &str| {
        format!("levels:\n  L1:\n    vertices:\n{vertices}    lanes:\n{lanes}")
    };
    let vertices = "      - [0, 0, 0, a]\n      - [9, 9, 0, b]\n";
    let lines = |count: usize, line: &str| line.repeat(count);
    Some(match name {
        "deep-flow" => format!("levels: {}", "[".repeat(MILLION)),
        "deep-flow-closed" => ["levels: ", &"[".repeat(MILLION), &"]".repeat(MILLION)].concat(),
        "deep-maps" => format!("levels: {}", "{a: ".repeat(MILLION)),
        "deep-block" => {
            let line = |i| format!("{}a:\n", " ".repeat(i));
            format!("levels:\n{}", (1..2_000).map(line).collect::<String>())
        }
        "deep-dashes" => format!("levels:\n  {}", "- ".repeat(MILLION)),
        "deep-keys" => format!("levels:\n  {}", "? ".repeat(MILLION / 10)),
        "many-lanes" => level(vertices, &lines(100_000, "      - [0, 1, {}]\n")),
        "many-parameters" => {
            let parameters = join(100_000, |i| format!("p{i}: [2, {i}]"));
            level(vertices, &format!("      - [0, 1, {{{parameters}}}]\n"))
        }
        "many-levels" => {
            let level = |i| format!("  L{i}: {{vertices: [[0, 0, 0]]}}\n");
            format!("levels:\n{}", (0..100_000).map(level).collect::<String>())
        }
        "many-fiducials" => {
            let fiducials = join(20_000, |i| format!("[{i}, 0, f{i}]"));
            let level = |name| format!("  {name}: {{fiducials: [{fiducials}]}}\n");
            format!("levels:\n{}{}", level("L1"), level("L2"))
        }
        // Each level repeats all lanes.
        "lanes-by-alias" => {
            let lanes = vec!["[0, 1]"; 10_000].join(", ");
            let level = |i| format!("  M{i}: *l\n");
            let first =
                format!("  L1: &l {{vertices: [[0, 0, 0], [9, 9, 0]], lanes: [{lanes}]}}\n");
            format!(
                "levels:\n{first}{}",
                (0..10_000).map(level).collect::<String>()
            )
        }
        "many-anchors" => {
            let lanes: String = (0..100_000)
                .map(|i| format!("      - &a{i} [0, 1]\n"))
                .collect();
            level(vertices, &lanes)
        }
        "long-key" => format!("levels:\n  {}: 1\n", "L".repeat(2 * MILLION)),
        "long-name" => level(
            &format!("      - [0, 0, 0, {}]\n", "n".repeat(2 * MILLION)),
            "",
        ),
        "long-text" => format!("text: |\n{}levels:\n", "  line\n".repeat(MILLION)),
        "many-questions" => format!("levels:\n{}", "?\n".repeat(MILLION / 10)),
        _ => return None,
    })
}

pub(super) fn svg(name: &str) -> Option<String> {
    let svg = |content: &str| {
        format!("<svg xmlns='http://www.w3.org/2000/svg' width='9mm' stroke='red'>{content}</svg>")
    };
    // Ten uses per level.
    let tower = |top: &str| {
        let level = |i: usize| {
            let uses = format!("<use href='#l{}'/>", i - 1).repeat(10);
            format!("<g id='l{i}'>{uses}</g>")
        };
        let levels: String = (1..9).map(level).collect();
        svg(&format!(
            "<defs><g id='l0'>{top}</g>{levels}</defs><use href='#l8'/>"
        ))
    };
    Some(match name {
        "billion-uses" => tower("<path d='M0 0 H1'/>"),
        "billion-groups" => tower("<g/>"),
        "billion-symbols" => tower("<symbol/>"),
        "uses-of-a-long-path" => {
            let path = format!("<path id='p' d='M0 0{}'/>", " h1 v1".repeat(MILLION / 10));
            svg(&(path + &"<use href='#p'/>".repeat(MILLION / 10)))
        }
        "uses-of-nothing" => svg(&"<use href='#p'/>".repeat(MILLION / 10)),
        "use-chain" => {
            let link = |i| format!("<g id='c{i}'><use href='#c{}'/></g>", i + 1);
            svg(&(0..100_000).map(link).collect::<String>())
        }
        "long-ids" => {
            let link = |i: usize| {
                let id = "i".repeat(100_000);
                format!("<use id='{id}{i}' href='#{id}{}'/>", i + 1)
            };
            svg(&(0..100).map(link).collect::<String>())
        }
        "deep-groups" => svg(&"<g>".repeat(MILLION)),
        "many-rules" => {
            let rules: String = (0..50_000)
                .map(|i| format!(".c{i} {{ fill: red }}"))
                .collect();
            let shapes = "<path class='c1 c2' d='M0 0 H1'/>".repeat(20_000);
            svg(&format!("<style>{rules}</style>{shapes}"))
        }
        "many-styles" => {
            let style = "fill:red;".repeat(MILLION / 10);
            svg(&format!("<path style='{style}' d='M0 0 H1'/>"))
        }
        "many-arcs" => {
            let arcs = " a9e11 9e11 0 0 1 1 1".repeat(MILLION / 10);
            svg(&format!("<path d='M0 0{arcs}'/>"))
        }
        "many-circles" => svg(&"<circle r='1e12'/>".repeat(MILLION / 10)),
        "long-polyline" => svg(&format!(
            "<polyline points='{}'/>",
            "1 2 3 4 ".repeat(MILLION)
        )),
        "long-number" => svg(&format!("<path d='M0 0 H{}'/>", "9".repeat(MILLION))),
        "many-transforms" => {
            let list = "rotate(1) ".repeat(MILLION / 10);
            svg(&format!("<path transform='{list}' d='M0 0 H1'/>"))
        }
        "many-namespaces" => svg(&(0..10_000)
            .map(|i| format!("<g xmlns:n{i}='n'/>"))
            .collect::<String>()),
        "entities-by-the-million" => {
            let value = "x".repeat(100_000);
            let body = svg(&format!("<text>{}</text>", "&a;".repeat(MILLION / 10)));
            format!("<!DOCTYPE svg [<!ENTITY a '{value}'>]>{body}")
        }
        _ => return None,
    })
}

pub(super) fn opendrive(name: &str) -> Option<String> {
    let road = |geometry: &str, sections: &str| {
        format!(
            "<OpenDRIVE><road id='1'><planView>{geometry}</planView>\
             <lanes>{sections}</lanes></road></OpenDRIVE>"
        )
    };
    let geometry = |s: usize, length: &str, shape: &str| {
        format!("<geometry s='{s}' x='0' y='0' hdg='0' length='{length}'>{shape}</geometry>")
    };
    let width = |s: usize| format!("<width sOffset='{s}' a='3' b='0' c='0' d='0'/>");
    let lane = |id: usize| format!("<lane id='{id}'>{}</lane>", width(0));
    let section =
        |s: usize, lanes: &str| format!("<laneSection s='{s}'><left>{lanes}</left></laneSection>");
    let line = geometry(0, "1e6", "<line/>");
    Some(match name {
        "lanes-times-widths" => {
            let widths: String = (0..20_000).map(width).collect();
            let lanes: String = (2..20_000).map(lane).collect();
            road(
                &line,
                &section(0, &format!("<lane id='1'>{widths}</lane>{lanes}")),
            )
        }
        "sections-times-geometry" => {
            let lines: String = (0..10_000).map(|s| geometry(s, "1", "<line/>")).collect();
            road(&lines, &section(0, &lane(1)).repeat(5_000))
        }
        "many-wild-spirals" => {
            let spiral = "<spiral curvStart='-300' curvEnd='300'/>";
            let lines: String = (0..2_000).map(|s| geometry(s, "100", spiral)).collect();
            road(&lines, &section(0, &lane(1)))
        }
        "many-cusps" => {
            let cusp = "<paramPoly3 aU='0' bU='0' cU='9' dU='0' aV='0' bV='0' cV='0' dV='9'/>";
            let lines: String = (0..5_000).map(|s| geometry(s, "1", cusp)).collect();
            road(&lines, &section(0, &lane(1)))
        }
        "many-poly3" => {
            let poly = "<poly3 a='0' b='0' c='1' d='1'/>";
            let lines: String = (0..20_000).map(|s| geometry(s, "1", poly)).collect();
            road(&lines, &section(0, &lane(1)))
        }
        "many-lanes" => road(
            &line,
            &section(0, &(1..100_000).map(lane).collect::<String>()),
        ),
        "many-empty-roads" => {
            format!("<OpenDRIVE>{}</OpenDRIVE>", "<road/>".repeat(MILLION / 4))
        }
        "deep" => format!("<OpenDRIVE>{}", "<road>".repeat(MILLION)),
        "long-id" => {
            road(&line, "").replace("id='1'", &format!("id='{}'", "1".repeat(2 * MILLION)))
        }
        _ => return None,
    })
}

pub(super) fn lanelet2(name: &str) -> Option<String> {
    let osm = |content: &str| format!("<osm version='0.6'>{content}</osm>");
    let node = |i: usize| {
        let lat = 49.0 + (i % 1_000) as f64 * 1e-6;
        format!("<node id='{i}' lat='{lat}' lon='8.4'/>")
    };
    let nodes = |count| (0..count).map(node).collect::<String>();
    let lanelet = |left: &str, right: &str| {
        format!(
            "<relation id='9'><member type='way' ref='{left}' role='left'/>\
             <member type='way' ref='{right}' role='right'/><tag k='type' v='lanelet'/></relation>"
        )
    };
    let references = |count: usize, of: usize| {
        (0..count)
            .map(|i| format!("<nd ref='{}'/>", i % of))
            .collect::<String>()
    };
    Some(match name {
        "lanelets-of-a-long-way" => {
            let way = format!("<way id='w'>{}</way>", references(100_000, 1_000));
            osm(&(nodes(1_000) + &way + &lanelet("w", "w").repeat(20_000)))
        }
        "lanelets-of-one-place" => {
            let way = format!("<way id='w'>{}</way>", references(100_000, 1));
            osm(&(nodes(1) + &way + &lanelet("w", "w").repeat(20_000)))
        }
        "long-way" => osm(&(nodes(2) + "<way id='w'>" + &references(MILLION + 1, 2) + "</way>")),
        "many-empty-ways" => osm(&"<way/>".repeat(MILLION / 4)),
        "many-nodes" => osm(&nodes(MILLION / 10)),
        "many-tags" => {
            let tags: String = (0..100_000)
                .map(|i| format!("<tag k='k{i}' v='v'/>"))
                .collect();
            osm(&(nodes(2) + "<way id='w'><nd ref='0'/><nd ref='1'/>" + &tags + "</way>"))
        }
        "many-types" => {
            let relation = |i| format!("<relation id='{i}'><tag k='type' v='t{i}'/></relation>");
            osm(&(0..100_000).map(relation).collect::<String>())
        }
        "many-members" => {
            let member = "<member type='way' ref='1' role='x'/>".repeat(100_000);
            osm(&format!(
                "<relation id='1'>{member}<tag k='type' v='lanelet'/></relation>"
            ))
        }
        "deep" => format!("<osm>{}", "<way>".repeat(MILLION)),
        "long-id" => osm(&format!("<way id='{}'/>", "1".repeat(2 * MILLION))),
        _ => return None,
    })
}
