"""The package as its users call it: `pytest python/tests`.

Tests that need pyarrow, polars, pandas, duckdb or numpy are skipped where it is missing.
"""

from __future__ import annotations

import io
import pathlib

import guideway
import pytest

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLES = ROOT / "crates/guideway/examples"
SITE = EXAMPLES / "site.lif.json"


@pytest.fixture(scope="module")
def site() -> guideway.Layout:
    return guideway.open(SITE)


def test_opens_paths_bytes_and_files(site: guideway.Layout) -> None:
    assert (len(site), site.format) == (326, "LIF")
    assert site.levels == ["hall", "mezzanine"]
    assert site.vehicle_types == ["stacker-1200", "tugger-3000"]
    data = SITE.read_bytes()
    sources: list[str | bytes | io.BytesIO] = [str(SITE), data, io.BytesIO(data)]
    for source in sources:
        assert site.diff(guideway.open(source)) == []
    with SITE.open("rb") as file:
        assert len(guideway.open(file)) == 326
    assert site.bounds is not None
    min_x, min_y, max_x, max_y = site.bounds
    assert 0 < max_x - min_x < 200 and 0 < max_y - min_y < 200
    assert site.length_m == pytest.approx(sum(edge_lengths(site)))


def edge_lengths(layout: guideway.Layout) -> list[float]:
    pyarrow = pytest.importorskip("pyarrow")
    lengths: list[float] = pyarrow.table(layout.edges)["length_m"].to_pylist()
    return lengths


def test_errors_have_code_message_and_remedy(tmp_path: pathlib.Path) -> None:
    with pytest.raises(guideway.GuidewayError) as raised:
        guideway.open(tmp_path / "none.lif.json")
    error = raised.value
    assert "none.lif.json" in error.message and error.code and error.remedy
    assert str(error) == f"{error.message}. {error.remedy}"
    with pytest.raises(guideway.GuidewayError, match="bytes"):
        guideway.open(SITE.open("r"))  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        guideway.open(17)  # type: ignore[arg-type]
    with pytest.raises(guideway.GuidewayError, match="__arrow_c_stream__"):
        guideway.Layout.from_arrow([1, 2])  # type: ignore[arg-type]


def test_progress_is_called_and_its_exception_stops(site: guideway.Layout) -> None:
    def stop(share: float) -> None:
        raise KeyboardInterrupt

    large = site
    for step in range(3):
        by = [0, 1000 * 4**step]
        large = large.edit([{"do": "copy", "paths": "all", "count": 3, "step": by}])
    assert len(large) == 326 * 4**3
    data = large.to_bytes("lif")
    with pytest.raises(KeyboardInterrupt):
        guideway.open(data, progress=stop)


def test_check_finds_what_the_command_finds(site: guideway.Layout) -> None:
    assert site.check(at_least="warning") == []
    data = SITE.read_bytes()
    second = b'"stationId":"dock-2"'
    assert data.count(second) == 1
    faulty = guideway.open(data.replace(second, b'"stationId":"dock-1"'))
    found = faulty.check(at_least="warning")
    assert [finding.code for finding in found] == ["duplicate-id"]
    assert "dock-1" in found[0].element and found[0].line and found[0].remedy
    assert "duplicate-id" in repr(found[0])
    with pytest.raises(guideway.GuidewayError, match="severity"):
        site.check(at_least="fatal")  # type: ignore[arg-type]


def test_routes_have_times_and_edges(site: guideway.Layout) -> None:
    route = site.route("dock-1", "dock-3", vehicle_type="tugger-3000")
    assert len(route) == len(route.steps) > 1
    assert route.length_m == pytest.approx(sum(step.length_m for step in route.steps))
    assert route.time_s == pytest.approx(route.steps[-1].end_s)
    slow = site.route("dock-1", "dock-3", vehicle_type="tugger-3000", lateral_acceleration_m_s2=0.01)
    assert slow.time_s > route.time_s
    with pytest.raises(guideway.GuidewayError, match="nowhere"):
        site.route("dock-1", "nowhere", vehicle_type="tugger-3000")


def test_edits_return_another_layout(site: guideway.Layout) -> None:
    edited = site.edit(
        [
            {"do": "rename", "station": "dock-1", "to": "gate"},
            {"do": "move", "nodes": ["aisle-1-071"], "by": [0, 0.5]},
        ]
    )
    changes = site.diff(edited)
    assert ("station", "dock-1", "renamed", "gate") in [
        (change.element, change.id, change.change, change.to) for change in changes
    ]
    assert any(change.change == "moved" and change.distance_m == 0.5 for change in changes)
    assert site.diff(site) == []
    with pytest.raises(guideway.GuidewayError, match="step 2") as raised:
        site.edit([{"do": "delete", "paths": "all"}, {"do": "rename", "node": "none", "to": "x"}])
    assert raised.value.remedy.endswith("No step was kept")
    assert len(site) == 326


def test_saves_each_format_and_tells_what_is_lost(
    site: guideway.Layout, tmp_path: pathlib.Path
) -> None:
    assert site.save(tmp_path / "same.lif.json") == []
    assert (tmp_path / "same.lif.json").read_bytes() == SITE.read_bytes() == site.to_bytes("lif")
    losses = site.save(tmp_path / "plan.dxf")
    assert losses and all(loss.count > 0 and loss.message for loss in losses)
    assert guideway.open(tmp_path / "plan.dxf").format == "DXF"
    with pytest.raises(guideway.GuidewayError, match="extension"):
        site.save(tmp_path / "plan.xyz")
    with pytest.raises(guideway.GuidewayError, match="format"):
        site.to_bytes("xyz")


def test_a_drawing_becomes_a_network(tmp_path: pathlib.Path) -> None:
    drawing = guideway.open(
        b'<svg xmlns="http://www.w3.org/2000/svg" width="1000cm" viewBox="0 0 10 10">'
        b'<path d="M0 5H10M5 0V10" stroke="black"/></svg>'
    )
    network, report = drawing.network(split=True)
    assert (len(network), report["crossings"]) == (4, 1)
    assert any("crossing" in line for line in report["lines"])
    with pytest.raises(guideway.GuidewayError, match="source"):
        drawing.network(stations=["letters"])


def test_pictures_show_the_layout(site: guideway.Layout, tmp_path: pathlib.Path) -> None:
    numpy = pytest.importorskip("numpy")
    picture = site.render(size=(320, 180), color_by="maxSpeed", site=True)
    assert (picture.width, picture.height, picture.drawn) == (320, 180, 326)
    pixels = picture.numpy()
    assert pixels.shape == (180, 320, 4) and pixels.dtype == numpy.uint8
    assert len(numpy.unique(pixels.reshape(-1, 4), axis=0)) > 50
    assert picture.png().startswith(b"\x89PNG") and picture._repr_png_() == picture.png()
    assert picture.svg().startswith("<svg")
    for name in ["plan.png", "plan.svg", "plan.pdf"]:
        picture.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 1000
    near = site.render(size=(320, 180), view=(60, 30, 70, 40))
    assert 0 < near.drawn < 326
    with pytest.raises(guideway.GuidewayError, match="maxSpeed"):
        site.render(color_by="maxspeed")
    with pytest.raises(guideway.GuidewayError):
        picture.save(tmp_path / "plan.bmp")


def test_tables_have_names_and_si_units(site: guideway.Layout) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    edges = pyarrow.table(site.edges)
    assert edges.num_rows == len(site) == len(site.edges)
    assert edges.schema.field("maxSpeed").metadata == {b"unit": b"m/s"}
    row = edges.filter(pyarrow.compute.field("id") == "dock-1-002--dock-1-003").to_pylist()[0]
    assert (row["length_m"], row["maxSpeed"], row["direction"]) == (4.0, 0.3, "forward")
    open_to = pyarrow.table(site.edges_for("tugger-3000"))
    assert 0 < open_to.num_rows < edges.num_rows
    nodes, stations = pyarrow.table(site.nodes), pyarrow.table(site.stations)
    assert nodes.column_names[:4] == ["id", "x_m", "y_m", "level"]
    assert set(edges["start_node"].to_pylist()) <= set(nodes["id"].to_pylist())
    assert stations["nodes"].to_pylist()[0]
    with pytest.raises(guideway.GuidewayError, match="tugger"):
        site.edges_for("tugger")


def test_samples_lie_on_the_curves_at_equal_distances(site: guideway.Layout) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    samples = pyarrow.table(site.sample(0.5)).to_pylist()
    lengths = edge_lengths(site)
    for edge, length_m in enumerate(lengths):
        along = [row["along_m"] for row in samples if row["edge"] == edge]
        assert along[0] == 0.0 and along[-1] == pytest.approx(length_m, abs=2e-3)
        steps = [b - a for a, b in zip(along, along[1:])]
        assert max(steps) <= 0.5 + 1e-9 and max(steps) - min(steps) < 1e-6
    with pytest.raises(guideway.GuidewayError, match="spacing"):
        site.sample(0.0)


def by_pyarrow(layout: guideway.Layout) -> object:
    return pytest.importorskip("pyarrow").table(layout)


def by_polars(layout: guideway.Layout) -> object:
    return pytest.importorskip("polars").DataFrame(layout)


def by_pandas(layout: guideway.Layout) -> object:
    pytest.importorskip("pandas")
    return pytest.importorskip("pyarrow").table(layout).to_pandas()


def by_duckdb(layout: guideway.Layout) -> object:
    duckdb = pytest.importorskip("duckdb")
    elements = pytest.importorskip("pyarrow").table(layout)  # noqa: F841: named in the query
    return duckdb.sql("from elements").to_arrow_table()


@pytest.mark.parametrize("by", [by_pyarrow, by_polars, by_pandas, by_duckdb])
@pytest.mark.parametrize("name", ["site.lif.json", "office.building.yaml"])
def test_tables_of_other_programs_come_back_whole(by, name: str) -> None:  # type: ignore[no-untyped-def]
    path = EXAMPLES / name
    if not path.exists():
        path = ROOT.parent / "shared/layouts/rmf_building" / name
    if not path.exists():
        pytest.skip(f"{name} is not here")
    layout = guideway.open(path)
    changes = layout.diff(guideway.Layout.from_arrow(by(layout)))
    if by in (by_pandas, by_duckdb):
        # They drop the type of columns with JSON, which come back as text.
        json = {"column layers", "layout properties"}
        changes = [change for change in changes if change.column not in json]
    assert changes == []


def test_the_law_can_fail(site: guideway.Layout) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(site)
    changed = table.drop_columns(["maxSpeed"])
    assert len(site.diff(guideway.Layout.from_arrow(changed))) > 0


def test_a_plain_table_becomes_a_picture_and_a_check() -> None:
    polars = pytest.importorskip("polars")
    lines = polars.DataFrame(
        {
            "id": ["a", "b"],
            "control_points": [
                [[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0]],
                [[1.0, 0.0], [2.0, 0.0], [3.0, 1.0], [4.0, 3.0]],
            ],
        }
    )
    layout = guideway.Layout.from_arrow(lines)
    assert len(layout) == 2 and layout.render(size=(64, 64)).drawn == 2
    assert all(finding.severity == "info" for finding in layout.check())
