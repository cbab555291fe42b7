"""Bad input and bad luck: each is an exception that names the place, and the work goes on."""

from __future__ import annotations

import os
import pathlib
import signal
import sys
from typing import Any, Iterator

import guideway
import pytest

ROOT = pathlib.Path(__file__).parents[2]
SITE = ROOT / "crates/guideway/examples/site.lif.json"
LINE = [[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]


def table(**columns: Any) -> Any:
    return pytest.importorskip("pyarrow").table(columns)


def points(*paths: list[list[float]]) -> Any:
    pyarrow = pytest.importorskip("pyarrow")
    return pyarrow.array(paths, pyarrow.list_(pyarrow.list_(pyarrow.float64(), 2)))


def refusal(source: Any) -> str:
    with pytest.raises(guideway.GuidewayError) as raised:
        guideway.Layout.from_arrow(source)
    assert raised.value.remedy
    return raised.value.message


def test_a_wrong_type_names_the_column_and_what_is_expected() -> None:
    message = refusal(table(id=["a"], control_points=["LINESTRING (0 0, 1 0)"]))
    for part in ["control_points", "expected list<", "found Utf8"]:
        assert part in message, message


def test_a_missing_column_is_named_with_those_that_are_there() -> None:
    message = refusal(table(id=["a"], geometry=[1]))
    for part in ["expected a column control_points", "id, geometry"]:
        assert part in message, message


def test_a_point_that_is_no_number_refuses_its_path_alone() -> None:
    broken = [LINE[0], [float("nan"), 0.0], *LINE[2:]]
    layout = guideway.Layout.from_arrow(table(id=["a", "b"], control_points=points(LINE, broken)))
    assert len(layout) == 1
    [finding] = layout.check(at_least="error")
    assert 'path "b"' in finding.element and "control point 1 is not finite" in finding.message


def test_a_closed_file_and_a_source_that_fails_are_exceptions() -> None:
    with SITE.open("rb") as file:
        pass
    with pytest.raises(ValueError, match="closed"):
        guideway.open(file)
    pyarrow = pytest.importorskip("pyarrow")
    good = table(id=["a"], control_points=points(LINE))

    def batches() -> Iterator[Any]:
        yield from good.to_batches()
        raise RuntimeError("the source died")

    message = refusal(pyarrow.RecordBatchReader.from_batches(good.schema, batches()))
    assert "record batch 1" in message and "the source died" in message


@pytest.mark.skipif(sys.platform == "win32", reason="limits of files are those of Unix")
def test_a_full_disk_leaves_the_file_of_before(tmp_path: pathlib.Path) -> None:
    import resource

    layout = guideway.open(SITE)
    target = tmp_path / "site.arrow"
    target.write_text("before")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, hard))
    try:
        with pytest.raises(guideway.GuidewayError, match="site.arrow"):
            layout.save(target)
        with pytest.raises(guideway.GuidewayError, match="site.png"):
            layout.render(size=(800, 600)).save(tmp_path / "site.png")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, before)
    assert target.read_text() == "before"
    assert os.listdir(tmp_path) == ["site.arrow"]
    layout.save(target)
    assert len(guideway.open(target)) == len(layout)


@pytest.mark.skipif(sys.platform == "win32", reason="signals are those of Unix")
def test_tiles_of_a_worker_that_dies_are_made_by_another_one(tmp_path: pathlib.Path) -> None:
    ray = pytest.importorskip("ray")
    mark, site = str(tmp_path / "died"), str(SITE)

    def draw(addresses: list[list[int]]) -> list[bytes | None]:
        """Draws tiles. The first worker that comes here dies in the middle."""
        # All by its value: workers cannot import a test.
        import os, signal, guideway

        tiles = guideway.tiles(guideway.open(site), *addresses)
        try:
            os.close(os.open(mark, os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            return tiles
        os.kill(os.getpid(), signal.SIGKILL)
        return []

    parts = [[[0, 1, 1], [0, 0, 0], [0, 0, 1]], [[1, 1], [1, 1], [0, 1]]]
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        task = ray.remote(max_retries=2)(draw)
        made = ray.get([task.remote(part) for part in parts])
    finally:
        ray.shutdown()
    assert os.path.exists(mark), "no worker died"
    assert made == [guideway.tiles(guideway.open(SITE), *part) for part in parts]
