"""Path layouts of automated guided vehicles: read, check, edit, draw, convert.

>>> import guideway
>>> site = guideway.open("site.lif.json")
>>> site.check(at_least="warning")
[]
>>> site.save("site.dxf")
"""

from typing import Any

from ._guideway import (
    Change,
    Finding,
    GuidewayError,
    Layout,
    Loss,
    Picture,
    Route,
    RouteStep,
    Table,
    Tiler,
    check_many,
    open,
    tiles,
)

__all__ = [
    "Change",
    "Finding",
    "GuidewayError",
    "Layout",
    "Loss",
    "Picture",
    "Route",
    "RouteStep",
    "Table",
    "Tiler",
    "check_many",
    "open",
    "tiles",
]


def __getattr__(name: str) -> Any:
    if name != "Widget":
        raise AttributeError(f"module 'guideway' has no attribute {name!r}")
    # Only this needs anywidget.
    try:
        import anywidget  # noqa: F401
    except ImportError as error:
        from ._error import refusal

        message = "`guideway.Widget` needs the package anywidget, which cannot be imported"
        remedy = 'Install it: pip install "guideway[widget]"'
        raise refusal(message, remedy, "missing-package") from error
    from ._widget import Widget

    return Widget
