"""The widget for notebooks, without a browser: `web/tests/widget.mjs` has one."""

from __future__ import annotations

import base64
import gzip
import importlib
import io
import math
import pathlib
import subprocess
import sys
from typing import Any

import guideway
import pytest

ROOT = pathlib.Path(__file__).parents[2]
SITE = ROOT / "crates/guideway/examples/site.lif.json"
PAGE = ROOT / "crates/guideway/page"


@pytest.fixture(scope="module")
def site() -> guideway.Layout:
    return guideway.open(SITE)


@pytest.fixture
def widget(site: guideway.Layout) -> Any:
    pytest.importorskip("anywidget")
    return guideway.Widget(site)


def refusal(act: Any, *args: Any, **kwargs: Any) -> str:
    with pytest.raises(guideway.GuidewayError) as raised:
        act(*args, **kwargs)
    assert raised.value.code and raised.value.remedy
    return raised.value.message


def test_the_browser_gets_the_engine_and_all_of_the_layout(
    site: guideway.Layout, widget: Any
) -> None:
    state = widget.get_state()
    assert state["_engine"] == (PAGE / "engine-arrow.wasm.gz").read_bytes()
    for font in ("_letters", "_symbols"):
        assert gzip.decompress(state[font])[:4] == b"\0\1\0\0"
    assert state["_esm"].encode() == gzip.decompress((PAGE / "widget.js.gz").read_bytes())
    again = guideway.open(io.BytesIO(state["_layout"]))
    assert len(again) == 326 and site.diff(again) == []
    # The same digits, so that the browser draws the same pixels.
    assert again.render(size=(320, 200)).png() == site.render(size=(320, 200)).png()


def test_points_of_few_digits_travel_in_half_the_bytes(site: guideway.Layout) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    pytest.importorskip("anywidget")
    lines = {
        kind: pyarrow.array(
            [[[i + at / 3, 0.0] for i in range(4)] for at in range(1000)],
            pyarrow.list_(pyarrow.list_(kind, 2)),
        )
        for kind in (pyarrow.float32(), pyarrow.float64())
    }
    sizes = {}
    for kind, points in lines.items():
        layout = guideway.Layout.from_arrow(pyarrow.table({"control_points": points}))
        sizes[str(kind)] = len(guideway.Widget(layout).get_state()["_layout"])
    assert sizes["double"] - sizes["float"] == pytest.approx(1000 * 4 * 2 * 4, abs=500)


def test_python_and_the_browser_share_the_traits(widget: Any) -> None:
    seen: list[Any] = []
    widget.observe(lambda change: seen.append(change["new"]), ["selected", "center"])
    widget.set_state({"selected": "dock-1", "center": [1, 2.5], "scale": 12.5})
    assert (widget.selected, widget.center, widget.scale) == ("dock-1", (1.0, 2.5), 12.5)
    widget.selected = "dock-1-001--dock-1-002"
    widget.color_by, widget.level = "maxSpeed", "hall"
    widget.highlight = ["dock-2", "dock-3"]
    widget.center = None
    assert seen == ["dock-1", (1.0, 2.5), "dock-1-001--dock-1-002", None]
    state = widget.get_state()
    assert (state["color_by"], state["level"]) == ("maxSpeed", "hall")
    assert state["highlight"] == ["dock-2", "dock-3"]


def test_what_an_observer_sets_is_checked(widget: Any) -> None:
    refused = []

    def recolor(change: Any) -> None:
        refused.append(refusal(setattr, widget, "color_by", change["new"]))

    widget.observe(recolor, "selected")
    widget.set_state({"selected": "dock-1"})
    assert len(refused) == 1 and "dock-1" in refused[0]
    assert (widget.selected, widget.color_by) == ("dock-1", None)


def test_methods_tell_the_browser_what_to_do(widget: Any) -> None:
    widget.set_state({"center": [1, 2], "scale": 3})
    widget.fly_to("dock-1")
    assert widget.get_state()["_target"] == {"number": 1, "element": "dock-1"}
    assert (widget.center, widget.scale) == (None, None)
    widget.fly_to((0, 1, 20, 30))
    assert widget.get_state()["_target"] == {"number": 2, "box": [0, 1, 20, 30]}
    widget.fit()
    assert widget.get_state()["_target"] == {"number": 3}
    widget.set_vehicles([{"id": 7, "x": 1, "y": 2, "theta": 0.5, "length_m": 2}], duration_ms=500)
    vehicle = {"id": "7", "x": 1.0, "y": 2.0, "theta": 0.5, "lengthM": 2.0}
    assert widget.get_state()["_fleet"] == {"vehicles": [vehicle], "durationMs": 500}
    # A click selects a vehicle, too.
    widget.selected = "7"


def test_wrong_arguments_are_refused_and_nothing_changes(
    site: guideway.Layout, widget: Any
) -> None:
    assert "not a str" in refusal(guideway.Widget, str(SITE))
    assert "weight" in refusal(guideway.Widget, site, color_by="weight")
    assert "attic" in refusal(guideway.Widget, site, level="attic")
    assert "`no-such`" in refusal(guideway.Widget, site, selected="no-such")
    assert "together" in refusal(guideway.Widget, site, scale=2.0)
    for name, value, said in [
        ("color_by", "weight", "weight"),
        ("level", "attic", "attic"),
        ("selected", "no-such", "`no-such`"),
        ("hovered", "no-such", "`no-such`"),
        ("highlight", ["dock-1", "no-such"], "`no-such`"),
        ("scale", -1.0, "-1"),
        ("scale", math.nan, "nan"),
        ("center", (math.inf, 0.0), "inf"),
    ]:
        before = getattr(widget, name)
        assert said in refusal(setattr, widget, name, value), name
        assert getattr(widget, name) == before
    assert "`no-such`" in refusal(widget.fly_to, "no-such")
    for box, said in [
        ((0, 0, 1), "no box"),
        ((1, 0, 0, 1), "no box"),
        ((0, 0, math.nan, 1), "nan"),
        ((0, 0, "wide", 1), "wide"),
    ]:
        assert said in refusal(widget.fly_to, box)
    for vehicle, said in [
        ({"x": 1, "y": 2}, "`id`"),
        ({"id": "a", "x": 1}, "`y`"),
        ({"id": "a", "x": 1, "y": math.nan}, "vehicle a"),
        ({"id": "a", "x": "left", "y": 1}, "'left'"),
        ({"id": "a", "x": 1, "y": 2, "speed": 3}, "`speed`"),
    ]:
        assert said in refusal(widget.set_vehicles, [vehicle])
    assert "-1" in refusal(widget.set_vehicles, [], duration_ms=-1)
    with pytest.raises(importlib.import_module("traitlets").TraitError, match="height"):
        widget.height = 0


def test_a_closed_widget_says_so_and_leaves_a_picture(widget: Any) -> None:
    data, _ = widget._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data
    assert base64.b64decode(data["image/png"]).startswith(b"\x89PNG")
    widget.close()
    data, _ = widget._repr_mimebundle_()
    assert sorted(data) == ["image/png", "text/plain"] and "closed" in data["text/plain"]
    for act in [widget.fit, lambda: widget.fly_to("dock-1"), lambda: widget.set_vehicles([])]:
        assert "closed" in refusal(act)
    assert "closed" in refusal(setattr, widget, "selected", "dock-1")
    widget.close()


def test_an_empty_layout_has_a_widget() -> None:
    pytest.importorskip("anywidget")
    empty = guideway.open(SITE).edit([{"do": "delete", "paths": "all"}])
    assert len(empty) == 0
    widget = guideway.Widget(empty)
    widget.fit()
    data, _ = widget._repr_mimebundle_()
    assert "image/png" in data


def test_without_anywidget_the_rest_works_and_the_widget_says_what_to_install() -> None:
    script = """
import sys
sys.modules["anywidget"] = None
import guideway
from guideway import *
assert not hasattr(guideway, "Wodget")
try:
    guideway.Widget
except guideway.GuidewayError as error:
    print(error.code, "|", error.remedy)
"""
    ran = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert ran.stdout == 'missing-package | Install it: pip install "guideway[widget]"\n'
