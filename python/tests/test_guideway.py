"""The package as its users call it: `pytest python/tests`.

Tests that need pyarrow, polars, pandas, duckdb or numpy are skipped where it is missing.
"""

from __future__ import annotations

import io
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys

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


def test_tiles_are_png_or_vector_tiles_by_address(site: guideway.Layout) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    tiler = guideway.Tiler(site)
    addresses = pyarrow.table(tiler.addresses(0, 4))
    assert addresses.column_names == ["z", "x", "y"] and addresses.slice(0, 1).to_pylist() == [
        {"z": 0, "x": 0, "y": 0}
    ]
    drawn = tiler.draw(addresses["z"], addresses["x"], addresses["y"])
    shown = [tile for tile in drawn if tile is not None]
    assert all(tile.startswith(b"\x89PNG") for tile in shown) and len(shown) > len(drawn) / 2
    for row in [0, 7, len(drawn) - 1]:
        address = addresses.slice(row, 1).to_pylist()[0]
        assert guideway.tiles(site, **address) == drawn[row]
        assert tiler.draw(**address) == drawn[row]
    assert tiler.draw(4, [0, 0], [0, 0]) == [tiler.draw(4, 0, 0)] * 2
    colored = guideway.tiles(site, 0, 0, 0, color_by="maxSpeed")
    assert colored is not None and colored != drawn[0]
    mvt = guideway.tiles(site, 0, 0, 0, content="vector", columns=["maxSpeed"])
    assert mvt is not None and b"paths" in mvt and b"maxSpeed" in mvt and b"aisle" in mvt
    assert tiler.grid is not None and tiler.grid[2] >= 128


def test_tiles_of_batches_of_the_paths_near_them_are_those_of_the_whole(
    site: guideway.Layout,
) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    whole = guideway.Tiler(site)
    table = pyarrow.table(site)
    paths = table.filter(pyarrow.compute.field("guideway.element") == "path")
    reader = pyarrow.RecordBatchReader.from_batches(paths.schema, paths.to_batches())
    part = guideway.Tiler(reader, grid=whole.grid)
    assert part.draw(2, [1, 2], [1, 2]) == whole.draw(2, [1, 2], [1, 2])
    half = guideway.Tiler(paths.slice(0, 100), grid=whole.grid)
    assert half.draw(0, 0, 0) != whole.draw(0, 0, 0)


def test_tiles_refuse_wrong_arguments(site: guideway.Layout) -> None:
    for wrong, options in [
        ("columns", {"columns": ["maxSpeed"]}),
        ("color_by", {"color_by": "maxSpeed", "content": "vector"}),
        ("maxspeed", {"color_by": "maxspeed"}),
        ("grid", {"grid": (0.0, 0.0, 100.0)}),
        ("roof", {"level": "roof"}),
        ("content", {"content": "pdf"}),
    ]:
        with pytest.raises(guideway.GuidewayError, match=wrong):
            guideway.Tiler(site, **options)  # type: ignore[arg-type]
    tiler = guideway.Tiler(site)
    for wrong, z, x, y in [
        ("zoom 3", 3, 8, 0),
        ("Zooms", 29, 0, 0),
        ("x is neither", 3, -1, 0),
        ("y is neither", 3, 0, "0"),
        ("lengths", 3, [0, 1], [0]),
    ]:
        with pytest.raises(guideway.GuidewayError, match=wrong):
            tiler.draw(z, x, y)  # type: ignore[call-overload]
    with pytest.raises(guideway.GuidewayError, match="zooms"):
        tiler.addresses(3, 2)
    with pytest.raises(guideway.GuidewayError, match="28"):
        tiler.addresses(0, 29)
    with pytest.raises(TypeError):
        guideway.tiles(site, 0, 0, 0, colour_by="maxSpeed")  # type: ignore[call-overload]


def test_many_files_are_checked_as_one_table(tmp_path: pathlib.Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    data = SITE.read_bytes()
    faulty = tmp_path / "faulty.lif.json"
    faulty.write_bytes(data.replace(b'"stationId":"dock-2"', b'"stationId":"dock-1"'))
    broken = tmp_path / "broken.lif.json"
    broken.write_bytes(data[: len(data) // 2])
    paths = [SITE, broken, faulty, tmp_path / "none.lif.json"]
    shares: list[float] = []
    table = pyarrow.table(
        guideway.check_many(paths, at_least="warning", progress=shares.append)
    ).to_pylist()
    assert [row["path"] for row in table] == [str(broken), str(faulty), str(paths[3])]
    assert {row["severity"] for row in table[::2]} == {"error"}
    assert table[0]["message"] and table[1]["code"] == "duplicate-id" and table[2]["remedy"]
    found = guideway.open(faulty).check()
    table = pyarrow.table(guideway.check_many([str(faulty)])).to_pylist()
    of = ["code", "severity", "element", "line", "column", "message", "remedy"]
    assert [[row[name] for name in of] for row in table] == [
        [getattr(finding, name) for name in of] for finding in found
    ]
    assert len(guideway.check_many([])) == 0
    for wrong in ["site.lif.json", [17], 3]:
        with pytest.raises(guideway.GuidewayError, match="paths"):
            guideway.check_many(wrong)  # type: ignore[arg-type]


def test_features_have_geoarrow_geometry(site: guideway.Layout) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    edges = pyarrow.table(site.features("edges"))
    geometry = edges.schema.field("geometry")
    assert geometry.metadata[b"ARROW:extension:name"] == b"geoarrow.linestring"
    lines = edges["geometry"].to_pylist()
    lengths = [
        sum(math.dist(a.values(), b.values()) for a, b in zip(line, line[1:])) for line in lines
    ]
    assert lengths == pytest.approx(edges["length_m"].to_pylist(), abs=0.05)
    coarse = pyarrow.table(site.features("edges", tolerance_m=1.0))["geometry"].to_pylist()
    assert sum(map(len, coarse)) < sum(map(len, lines))
    nodes = pyarrow.table(site.features("nodes")).slice(0, 1).to_pylist()[0]
    assert nodes["geometry"] == {"x": nodes["x_m"], "y": nodes["y_m"]}
    assert len(site.features("stations")) == len(site.stations)
    with pytest.raises(guideway.GuidewayError, match="place on earth"):
        site.features("edges", on_earth=True)
    with pytest.raises(guideway.GuidewayError, match="called `zones`"):
        site.features("zones")  # type: ignore[arg-type]
    with pytest.raises(guideway.GuidewayError, match="tolerance"):
        site.features("edges", tolerance_m=0.0)


def test_geopandas_reads_features_on_earth() -> None:
    geopandas = pytest.importorskip("geopandas")
    lane = {"type": "LineString", "coordinates": [[11.5, 48.1], [11.501, 48.1005]]}
    roads = guideway.open(json.dumps({"type": "Feature", "properties": {}, "geometry": lane}).encode())
    frame = geopandas.GeoDataFrame.from_arrow(
        pytest.importorskip("pyarrow").table(roads.features("edges", on_earth=True))
    )
    assert frame.crs == "OGC:CRS84" and frame.geom_type.tolist() == ["LineString"]
    assert frame.total_bounds == pytest.approx([11.5, 48.1, 11.501, 48.1005], abs=1e-9)
    meters = frame.to_crs(frame.estimate_utm_crs()).length.sum()
    assert meters == pytest.approx(roads.length_m, rel=1e-3)


def lines_as_structs() -> object:
    pyarrow = pytest.importorskip("pyarrow")
    point = pyarrow.struct([("x", pyarrow.float64()), ("y", pyarrow.float64())])
    line = [{"x": -1.0, "y": 0.0}, {"x": 0.0, "y": 0.0}, {"x": 1.0, "y": 0.0}, {"x": 2.0, "y": 0.0}]
    points = pyarrow.array([line, None, line], pyarrow.list_(point))
    return pyarrow.table({"id": ["a", "none", "b"], "control_points": points})


def test_an_arrow_file_is_read_in_part(tmp_path: pathlib.Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    lines = [[[x - 1.0, 0.0], [x, 0.0], [x + 1.0, 0.0], [x + 2.0, 0.0]] for x in range(40_000)]
    points = pyarrow.array(lines, pyarrow.list_(pyarrow.list_(pyarrow.float64(), 2)))
    layout = guideway.Layout.from_arrow(pyarrow.table({"control_points": points}))
    layout.save(tmp_path / "lines.arrow")
    part = guideway.open(tmp_path / "lines.arrow", area=(20_000.0, -1.0, 20_010.0, 1.0))
    assert len(part) == 16_384 and len(layout) == 40_000
    assert len(guideway.open(tmp_path / "lines.arrow")) == 40_000
    # A tile needs the paths near it only.
    whole = guideway.Tiler(layout, content="vector")
    assert whole.grid is not None
    near = guideway.Tiler(part, content="vector", grid=whole.grid)
    left, top, side = whole.grid
    address = (12, int((20_005 - left) / side * 4096), int(top / side * 4096))
    assert whole.draw(*address) and whole.draw(*address) == near.draw(*address)
    with pytest.raises(guideway.GuidewayError, match="is no box"):
        guideway.open(tmp_path / "lines.arrow", area=(1.0, 0.0, 0.0, 1.0))


def test_points_as_structs_and_missing_lists_are_read() -> None:
    layout = guideway.Layout.from_arrow(lines_as_structs())  # type: ignore[arg-type]
    assert len(layout) == 2 and layout.length_m == pytest.approx(2.0)
    found = layout.check(at_least="warning")
    assert any("none" in finding.element for finding in found), found


@pytest.mark.parametrize("compression", ["snappy", "zstd"])
def test_parquet_files_go_through_pyarrow(
    site: guideway.Layout, tmp_path: pathlib.Path, compression: str
) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    parquet.write_table(pyarrow.table(site), tmp_path / "site.parquet", compression=compression)
    again = guideway.Layout.from_arrow(parquet.read_table(tmp_path / "site.parquet"))
    assert site.diff(again) == []


NODES = "id,x,y,kind\n1,0,0,dock\n2,10,0,\n3,10,5,\n"
EDGES = (
    "id,start_node,end_node,direction,max_speed,kind\n"
    "a,1,2,forward,1.5,7\nb,2,3,both,,8\nc,3,1,,0.5,9\n"
)


@pytest.mark.parametrize("library", ["polars", "pandas", "pyarrow.csv"])
def test_csv_files_of_nodes_and_edges_become_a_layout(library: str) -> None:
    pytest.importorskip(library)
    edges, nodes = read_csv(library, EDGES), read_csv(library, NODES)
    layout = guideway.Layout.from_tables(edges, nodes)  # type: ignore[arg-type]
    assert len(layout) == 3 and layout.length_m == pytest.approx(15 + math.hypot(10, 5))
    pyarrow = pytest.importorskip("pyarrow")
    rows = pyarrow.table(layout.edges).to_pylist()
    assert [(row["start_node"], row["end_node"]) for row in rows] == [
        ("1", "2"),
        ("2", "3"),
        ("3", "1"),
    ]
    assert [row["direction"] for row in rows] == ["forward", "both", "forward"]
    assert [row["max_speed"] for row in rows] == [1.5, None, 0.5]
    assert [row["kind"] for row in rows] == [7, 8, 9]
    places = pyarrow.table(layout.nodes).to_pylist()
    assert [(at["x_m"], at["y_m"]) for at in places] == [(0, 0), (10, 0), (10, 5)]
    assert places[0]["kind"] == "dock"
    route = layout.route("1", "3")
    assert [step.edge for step in route.steps] == ["a", "b"]
    for wrong, of_edges, of_nodes in [
        ("end_node is `4`", EDGES.replace("a,1,2", "a,1,4"), NODES),
        ("no column `end_node`", EDGES.replace("end_node", "to"), NODES),
        ("a second node `1`", EDGES, NODES.replace("\n2,", "\n1,")),
        ("no number in the column `x`", EDGES, NODES.replace("2,10,0", "2,,0")),
        ("no column `x_m`", EDGES, NODES.replace("x,y", "east,north")),
    ]:
        with pytest.raises(guideway.GuidewayError, match=wrong):
            guideway.Layout.from_tables(
                read_csv(library, of_edges),  # type: ignore[arg-type]
                read_csv(library, of_nodes),  # type: ignore[arg-type]
            )


def read_csv(library: str, text: str) -> object:
    file = io.BytesIO(text.encode())
    return pytest.importorskip(library).read_csv(file)


def other_pythons() -> list[str]:
    """The versions from 3.9 on that are installed, by their names or by pyenv."""
    names = [f"python3.{minor}" for minor in range(9, 20)]
    found = [path for name in names if (path := shutil.which(name)) and "shims" not in path]
    of_pyenv = pathlib.Path.home().glob(".pyenv/versions/3.*/bin/python3.*[0-9]")
    return found + sorted(str(path) for path in of_pyenv if path.name in names)


@pytest.mark.parametrize("python", other_pythons() or [sys.executable])
def test_one_module_serves_all_versions(python: str) -> None:
    package = pathlib.Path(guideway.__file__).parents[1]
    call = "import guideway, sys; print(len(guideway.tiles(guideway.open(sys.argv[1]), 0, 0, 0)))"
    ran = subprocess.run(
        [python, "-c", call, SITE],
        capture_output=True,
        env={**os.environ, "PYTHONPATH": str(package)},
        check=False,
    )
    assert ran.returncode == 0 and int(ran.stdout) > 1000, ran.stderr
