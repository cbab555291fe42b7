"""`Widget`: a layout in a notebook, which the browser draws. `guideway` imports it at first use."""

from __future__ import annotations

import base64
import gzip
import importlib
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import anywidget
import traitlets

from . import Layout
from ._error import refusal

_native: Any = importlib.import_module("guideway._guideway")
_module: str = gzip.decompress(_native.widget_module()).decode()
_engine: bytes = _native.widget_engine()
_letters: bytes = _native.widget_letters()
_symbols: bytes = _native.widget_symbols()

#: Fields of a vehicle, and their names in the browser.
_VEHICLE = {
    "id": "id",
    "x": "x",
    "y": "y",
    "theta": "theta",
    "level": "level",
    "label": "label",
    "color": "color",
    "length_m": "lengthM",
    "width_m": "widthM",
}
_NUMBERS = ("x", "y", "theta", "length_m", "width_m")


def _synced(trait: Any) -> Any:
    """A trait that the browser shares."""
    return trait.tag(sync=True)


if TYPE_CHECKING:
    from typing import Optional

    _Text = traitlets.TraitType[Optional[str], Optional[str]]
    _Number = traitlets.TraitType[Optional[float], Optional[float]]
    _Switch = traitlets.TraitType[bool, bool]


class Widget(anywidget.AnyWidget, metaclass=traitlets.MetaHasTraits):
    """A layout in Jupyter: zoom, move, hover and click. The browser draws it, without a network.

    `source` is the layout. `color_by` and `level` are as in `Layout.render`, `center` (meters) and
    `scale` (CSS pixels per meter) the first view, `highlight` and `selected` identifiers of edges,
    nodes or stations, `site` shows arrows, nodes, stations, names and a scale bar, `dark` is for
    dark notebooks, `height` is in CSS pixels.

    All of these are traits: Python reads and sets them, and `observe` tells of changes.
    `selected` and `hovered` follow clicks and the pointer; `center` and `scale` follow the map;
    `error` is the last failure of the browser, or `None`.

    >>> widget = guideway.Widget(guideway.open("site.lif.json"), color_by="maxSpeed")
    >>> widget.observe(lambda change: print(change["new"]), "selected")
    """

    _esm = _synced(traitlets.Unicode(_module))
    _engine = _synced(traitlets.Bytes(_engine))
    _letters = _synced(traitlets.Bytes(_letters))
    _symbols = _synced(traitlets.Bytes(_symbols))
    _layout = _synced(traitlets.Bytes())
    _name = _synced(traitlets.Unicode("layout.arrow"))
    _target = _synced(traitlets.Dict(None, allow_none=True))
    _fleet = _synced(traitlets.Dict())

    selected: _Text = _synced(traitlets.Unicode(None, allow_none=True))
    hovered: _Text = _synced(traitlets.Unicode(None, allow_none=True))
    center: traitlets.TraitType[Any, Any] = _synced(
        traitlets.Tuple(
            traitlets.Float(), traitlets.Float(), default_value=None, allow_none=True
        )
    )
    scale: _Number = _synced(traitlets.Float(None, allow_none=True))
    color_by: _Text = _synced(traitlets.Unicode(None, allow_none=True))
    level: _Text = _synced(traitlets.Unicode(None, allow_none=True))
    highlight: traitlets.TraitType[Any, Any] = _synced(traitlets.List(traitlets.Unicode()))
    site: _Switch = _synced(traitlets.Bool(False))
    dark: _Switch = _synced(traitlets.Bool(False))
    height: traitlets.TraitType[int, int] = _synced(traitlets.Int(480, min=1))
    error: _Text = _synced(traitlets.Unicode(None, allow_none=True))

    def __init__(
        self,
        source: Layout,
        /,
        *,
        color_by: str | None = None,
        level: str | None = None,
        center: tuple[float, float] | None = None,
        scale: float | None = None,
        highlight: Sequence[str] = (),
        selected: str | None = None,
        site: bool = False,
        dark: bool = False,
        height: int = 480,
    ) -> None:
        if not isinstance(source, Layout):
            message = f"a widget shows a Layout, not a {type(source).__name__}"
            raise refusal(message, "Open it first: `guideway.Widget(guideway.open(path))`")
        self._source = source
        if (center is None) != (scale is None):
            raise refusal("`center` and `scale` make a view together", "Give both, or neither")
        self._is_closed = False
        self._from_browser: frozenset[str] = frozenset()
        super().__init__(
            _layout=_native.widget_layout(source),
            _fleet={"vehicles": [], "durationMs": 0},
            color_by=color_by,
            level=level,
            center=center,
            scale=scale,
            highlight=list(highlight),
            selected=selected,
            site=site,
            dark=dark,
            height=height,
        )

    @property
    def source(self) -> Layout:
        """The layout that the widget shows."""
        return self._source

    def fly_to(self, target: str | Sequence[float]) -> None:
        """Shows an edge, node or station by its identifier, or a box (min x, min y, max x, max y)
        in meters."""
        if isinstance(target, str):
            self._check_elements([target])
            self._go({"element": target})
            return
        box = [_finite(value, "a side of the box") for value in target]
        if len(box) != 4 or box[0] > box[2] or box[1] > box[3]:
            remedy = "Write it as (min_x, min_y, max_x, max_y), in meters"
            raise refusal(f"the area {tuple(target)} is no box", remedy)
        self._go({"box": box})

    def fit(self) -> None:
        """Shows all of the layout."""
        self._go({})

    def set_vehicles(
        self, vehicles: Iterable[Mapping[str, Any]], *, duration_ms: float = 0
    ) -> None:
        """Replaces all vehicles; those that are elsewhere go there within `duration_ms`.

        A vehicle has `id`, `x` and `y` in meters, and may have `theta` in radians, `level`,
        `label`, `color`, `length_m` and `width_m`.
        """
        self._check_open()
        if not (math.isfinite(duration_ms) and duration_ms >= 0):
            raise refusal(f"{duration_ms} is no time", "Give milliseconds, from 0 on")
        fleet = [_vehicle(vehicle) for vehicle in vehicles]
        self._fleet = {"vehicles": fleet, "durationMs": duration_ms}

    def close(self) -> None:
        """Ends the widget: the browser removes it, and it takes no more changes."""
        self._is_closed = True
        super().close()
        # ipywidgets sets it to `None`, but a closed widget still has a picture.
        self.__dict__.pop("_repr_mimebundle_", None)

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Takes changes from the browser."""
        self._from_browser = frozenset(sync_data)
        try:
            super().set_state(sync_data)
        finally:
            self._from_browser = frozenset()

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        # A picture stands for the widget where there is no kernel, such as on a forge.
        size = (960, max(min(self.height, 2160), 1))
        picture = self._source.render(
            size=size, color_by=self.color_by, level=self.level, site=self.site
        )
        png = base64.b64encode(picture.png()).decode()
        shown = None if self._is_closed else super()._repr_mimebundle_(**kwargs)
        data, metadata = shown or ({"text/plain": "<Widget, closed>"}, {})
        return {**data, "image/png": png}, metadata

    def _go(self, target: dict[str, Any]) -> None:
        self._check_open()
        number = (self._target or {"number": 0})["number"] + 1
        with self.hold_sync():
            # The browser states them when it is there.
            self.center = self.scale = None
            self._target = {"number": number, **target}

    def _check_open(self) -> None:
        if self._is_closed:
            raise refusal("the widget is closed", "Make another one: `guideway.Widget(layout)`")

    def _check_elements(self, names: Iterable[str]) -> None:
        missing = _native.widget_missing(self._source, list(names))
        if missing is not None:
            message = f"the layout has no path, node or station `{missing}`"
            raise refusal(message, "Write its name as the file does")

    @traitlets.validate(
        "selected", "hovered", "center", "scale", "color_by", "level", "highlight", "height"
    )
    def _check(self, proposal: Any) -> Any:
        name, value = proposal["trait"].name, proposal["value"]
        # The browser may still report what Python has just replaced.
        if name in self._from_browser:
            return value
        self._check_open()
        if name in ("color_by", "level"):
            look = {"color_by": self.color_by, "level": self.level, name: value}
            _native.widget_check(self._source, look["color_by"], look["level"])
        elif name == "highlight":
            self._check_elements(value)
        elif name in ("selected", "hovered") and value is not None:
            vehicles = {vehicle["id"] for vehicle in self._fleet["vehicles"]}
            self._check_elements({value} - vehicles)
        elif name == "scale" and value is not None and not (0 < value < math.inf):
            raise refusal(f"the scale {value} is no number above 0", "Give CSS pixels per meter")
        elif name == "center" and value is not None and not all(map(math.isfinite, value)):
            raise refusal(f"the center {value} is not finite", "Give x and y in meters")
        return value


def _finite(value: Any, name: str) -> float:
    """A number for the browser, which has neither infinities nor texts in its place."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise refusal(f"{name} is {value!r}", "Give finite numbers, in meters and radians")
    return number


def _vehicle(of: Mapping[str, Any]) -> dict[str, Any]:
    """A vehicle for the browser."""
    unknown = sorted(set(of) - set(_VEHICLE))
    if unknown:
        message = f"a vehicle has no field `{unknown[0]}`"
        raise refusal(message, f"The fields are {', '.join(_VEHICLE)}")
    for name in ("id", "x", "y"):
        if of.get(name) is None:
            raise refusal(f"a vehicle without `{name}`", "Give `id`, and `x` and `y` in meters")
    given = {name: value for name, value in of.items() if value is not None}
    for name in given.keys() & set(_NUMBERS):
        given[name] = _finite(given[name], f"vehicle {of['id']}: `{name}`")
    return {
        _VEHICLE[name]: value if name in _NUMBERS else str(value) for name, value in given.items()
    }
