//! Tests the page and the tables of a run.

use guideway_reproduce::report::{PAGE, files};
use guideway_reproduce::reproduce::Run;
use guideway_scene::Cancel;
use roxmltree::{Document, ParsingOptions};
use serde_json::Value;

use super::fake::{FAKE, Fake};
use super::{plan, run_with};

const METHODS: [&str; 5] = [
    "grid",
    "grid+scan",
    "grid+scan+radius",
    "tessellation",
    "tessellation-compact",
];

fn full() -> Run {
    run_with(&plan(&METHODS), &Cancel::default(), |_| Some(FAKE))
}

fn page(run: &Run) -> String {
    let files = files(run);
    assert_eq!(files[0].name, PAGE);
    files[0].text.clone()
}

fn with_dtd<'a>() -> ParsingOptions<'a> {
    ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    }
}

#[test]
fn the_page_has_every_table_and_figure() {
    let run = full();
    let page = page(&run);
    let document = Document::parse_with_options(&page, with_dtd()).expect("well-formed");
    let captions: Vec<String> = document
        .descendants()
        .filter(|node| node.has_tag_name("figcaption") || node.has_tag_name("summary"))
        .filter_map(|node| node.text().map(str::to_owned))
        .collect();
    let wanted = [
        "Table 5.1",
        "Table 5.2",
        "Table 5.3",
        "Figure 5.1",
        "Figure 5.2",
        "Figure 5.3",
        "Figure 5.4",
        "Figure 5.5",
        "Figure 5.6",
        "Figure 5.7",
    ];
    for name in wanted {
        let found = captions
            .iter()
            .any(|caption| caption.starts_with(&format!("{name}:")));
        assert!(found, "no {name} among {captions:?}");
    }
    let count = |tag: &str| {
        document
            .descendants()
            .filter(|n| n.has_tag_name(tag))
            .count()
    };
    assert_eq!(count("img"), 2 + 4 + 2 + 2);
    assert_eq!(count("article"), 16);
    for method in METHODS {
        assert!(page.contains(method));
    }
}

#[test]
fn the_page_loads_no_other_file() {
    let page = page(&full());
    let document = Document::parse_with_options(&page, with_dtd()).expect("well-formed");
    for node in document.descendants() {
        assert!(!node.has_tag_name("script") && !node.has_tag_name("link"));
        for attribute in node.attributes() {
            let value = attribute.value();
            match attribute.name() {
                "src" => assert!(value.starts_with("data:image/png;base64,"), "{value}"),
                "href" => {
                    let is_there = |n: roxmltree::Node<'_, '_>| n.attribute("id") == value.get(1..);
                    assert!(
                        value.starts_with('#') && document.descendants().any(is_there),
                        "{value}"
                    );
                }
                _ => {}
            }
        }
    }
    assert!(!page.contains("url(") && !page.contains("@import"));
}

#[test]
fn the_page_states_missing_measurements() {
    let run = run_with(&plan(&METHODS), &Cancel::default(), |_| None);
    let text = page(&run);
    Document::parse_with_options(&text, with_dtd()).expect("well-formed");
    assert!(text.contains("needs a &lt;device&gt; &amp; a driver"));
    assert!(text.contains("Figure 5.1: dataset D1: no method for it runs on this computer."));
    assert!(text.contains("no measurements."));
    let mut run = full();
    assert!(!page(&run).contains("Stopped before its end"));
    run.is_partial = true;
    assert!(page(&run).contains("Stopped before its end"));
    assert!(page(&run).contains("This is the quick run"));
    run.plan.is_quick = false;
    assert!(!page(&run).contains("This is the quick run"));
}

#[test]
fn warns_about_tessellation_on_compute_devices() {
    let on = |device| {
        let run = run_with(&plan(&["grid", "tessellation"]), &Cancel::default(), |_| {
            Some(Fake { device, ..FAKE })
        });
        page(&run).matches("Mind the device").count()
    };
    assert_eq!((on("NVIDIA H200"), on("llvmpipe")), (2, 0));
}

#[test]
fn writes_every_table_as_csv() {
    let run = full();
    let files = files(&run);
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let wanted = [
        PAGE,
        "table-5.1.csv",
        "table-5.2.csv",
        "table-5.3.csv",
        "figure-5.3.csv",
        "figure-5.4.csv",
        "figure-5.5.csv",
        "changes.csv",
        "borders.csv",
        "work.csv",
        "methods.csv",
        "parts.csv",
    ];
    assert_eq!(names, wanted);
    let table = &files[1].text;
    let mut lines = table.lines();
    assert_eq!(
        lines.next().unwrap(),
        "dataset,method,paths,limit,reason,held_mb,peak_mb,thesis_paths,thesis_mb,frame_mean_ms,\
         frame_median_ms,frame_p5_ms,frame_p95_ms,frame_spread,wall_median_ms"
    );
    let grid = lines.next().unwrap();
    assert!(
        grid.starts_with("D1,grid,15") && grid.contains(",1020350,1090,"),
        "{grid}"
    );
    assert_eq!(lines.count(), 2 * METHODS.len() - 1);
}

/// Returns `true` if two values are equal up to the last digit of their numbers, which the reader
/// may round.
fn are_equal(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            (a - b).abs() <= 1e-12 * a.abs()
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| are_equal(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let same = |(key, value)| b.get(key).is_some_and(|other| are_equal(value, other));
            a.len() == b.len() && a.iter().all(same)
        }
        (a, b) => a == b,
    }
}

#[test]
fn json_round_trip_preserves_a_run() {
    let run = run_with(&plan(&METHODS), &Cancel::default(), |spec| {
        (spec != "grid+scan").then_some(FAKE)
    });
    let saved = serde_json::to_value(&run).unwrap();
    let back: Run = serde_json::from_str(&saved.to_string()).unwrap();
    assert!(are_equal(&saved, &serde_json::to_value(&back).unwrap()));
    Document::parse_with_options(&page(&back), with_dtd()).expect("well-formed");

    let mut other = saved.clone();
    other["results"]["zoom"][0]["paths"] = 301.into();
    assert!(!are_equal(&saved, &other));
    other = saved.clone();
    other["results"]["zoom"][0]["method"] = "cpu".into();
    assert!(!are_equal(&saved, &other));
}
