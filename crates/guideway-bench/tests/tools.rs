//! Measurements of the tools of a network, on a small plan.

use guideway_bench::measure_tools;

#[test]
fn every_tool_does_its_work() {
    let rows = measure_tools(2_000).expect("a network with a route");
    let tools: Vec<&str> = rows.iter().map(|row| row.tool).collect();
    assert_eq!(tools, ["network", "check", "router", "route", "diff"]);
    let of = |tool: &str| {
        let mut rows = rows.iter();
        rows.find(|row| row.tool == tool).expect("its row")
    };
    assert_eq!(of("network").paths, 2_000);
    // A line that crosses a street or ends on it makes three pieces more, or one.
    assert!((2_700..3_300).contains(&of("network").results), "{rows:?}");
    assert!(of("route").results > 30, "{rows:?}");
    assert_eq!(of("diff").results, 8 * of("diff").paths);
    assert!(rows.iter().all(|row| row.ms > 0.0));
}
