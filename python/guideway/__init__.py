"""Path layouts of automated guided vehicles: read, check, edit, draw, convert.

>>> import guideway
>>> site = guideway.open("site.lif.json")
>>> site.check(at_least="warning")
[]
>>> site.save("site.dxf")
"""

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
