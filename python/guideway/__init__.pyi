import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, Protocol, SupportsIndex, TypedDict, final, overload

from typing_extensions import Unpack

from ._widget import Widget as Widget

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

class _ArrowStream(Protocol):
    """An object with the Arrow C stream interface."""

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...

class _BinaryFile(Protocol):
    """A file that was opened for reading bytes."""

    def read(self) -> bytes: ...

class GuidewayError(Exception):
    """A file, a value or an option that Guideway cannot take."""

    code: str
    message: str
    remedy: str

@final
class Table:
    """A table with the Arrow C stream interface."""

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...
    def __len__(self) -> int: ...
    @property
    def column_names(self) -> list[str]: ...

@final
class Finding:
    """A finding of `Layout.check`."""

    @property
    def code(self) -> str: ...
    @property
    def severity(self) -> Literal["info", "warning", "error"]: ...
    @property
    def element(self) -> str: ...
    @property
    def line(self) -> int | None: ...
    @property
    def column(self) -> int | None: ...
    @property
    def message(self) -> str: ...
    @property
    def remedy(self) -> str: ...

@final
class RouteStep:
    """One edge of a route."""

    @property
    def edge(self) -> str: ...
    @property
    def backward(self) -> bool: ...
    @property
    def start_node(self) -> str: ...
    @property
    def end_node(self) -> str: ...
    @property
    def turn_rad(self) -> float: ...
    @property
    def turn_s(self) -> float: ...
    @property
    def length_m(self) -> float: ...
    @property
    def speed_m_s(self) -> float: ...
    @property
    def drive_s(self) -> float: ...
    @property
    def end_s(self) -> float: ...

@final
class Route:
    """The fastest way between two stations or nodes."""

    def __len__(self) -> int: ...
    @property
    def length_m(self) -> float: ...
    @property
    def time_s(self) -> float: ...
    @property
    def steps(self) -> list[RouteStep]: ...

@final
class Change:
    """A difference between two layouts."""

    @property
    def element(self) -> str: ...
    @property
    def id(self) -> str: ...
    @property
    def change(
        self,
    ) -> Literal["added", "removed", "renamed", "moved", "reshaped", "set", "counted"]: ...
    @property
    def to(self) -> str | None: ...
    @property
    def distance_m(self) -> float | None: ...
    @property
    def column(self) -> str | None: ...
    @property
    def vehicle_type(self) -> str | None: ...
    @property
    def before(self) -> str | None: ...
    @property
    def after(self) -> str | None: ...

@final
class Loss:
    """What a format cannot hold, or holds in another form."""

    @property
    def what(self) -> str: ...
    @property
    def count(self) -> int: ...
    @property
    def message(self) -> str: ...

@final
class Picture:
    """A picture of a layout. Jupyter shows it by itself."""

    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def drawn(self) -> int:
        """Number of edges that the picture shows."""

    def numpy(self) -> Any:
        """The pixels as a NumPy array of shape (height, width, 4), `uint8`, RGBA."""

    def png(self) -> bytes: ...
    def svg(self) -> str: ...
    def save(self, path: str | os.PathLike[str]) -> None: ...
    def _repr_png_(self) -> bytes: ...

@final
class Layout:
    """A network of edges, nodes and stations. It never changes: edits return another one."""

    @staticmethod
    def from_arrow(
        table: _ArrowStream, *, progress: Callable[[float], object] | None = None
    ) -> Layout: ...
    @staticmethod
    def from_tables(edges: _ArrowStream, nodes: _ArrowStream) -> Layout:
        """A layout of straight edges, from the tables of CSV files."""

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...
    def __len__(self) -> int: ...
    @property
    def format(self) -> str: ...
    @property
    def levels(self) -> list[str]: ...
    @property
    def vehicle_types(self) -> list[str]: ...
    @property
    def on_earth(self) -> bool:
        """`True` if the layout has a place on earth."""

    @property
    def length_m(self) -> float: ...
    @property
    def bounds(self) -> tuple[float, float, float, float] | None: ...
    @property
    def edges(self) -> Table: ...
    def edges_for(self, vehicle_type: str) -> Table: ...
    @property
    def nodes(self) -> Table: ...
    @property
    def stations(self) -> Table: ...
    def features(
        self,
        kind: Literal["edges", "nodes", "stations"],
        *,
        tolerance_m: float = 0.01,
        on_earth: bool = False,
    ) -> Table:
        """Elements with a GeoArrow column `geometry`, in meters or on earth in degrees."""

    def sample(self, spacing_m: float) -> Table: ...
    def check(
        self, *, at_least: Literal["info", "warning", "error"] = "info"
    ) -> list[Finding]: ...
    def route(
        self,
        start: str,
        goal: str,
        *,
        vehicle_type: str | None = None,
        speed_m_s: float = 1.0,
        lateral_acceleration_m_s2: float | None = None,
    ) -> Route: ...
    def diff(self, other: Layout) -> list[Change]: ...
    def edit(self, steps: Sequence[dict[str, Any]]) -> Layout: ...
    def network(
        self,
        *,
        weld_m: float | None = None,
        split: bool = False,
        smooth_m: float | None = None,
        stations: Sequence[str] = ...,
        names: Sequence[str] = ...,
        one_way: bool = False,
        options: str | None = None,
    ) -> tuple[Layout, dict[str, Any]]: ...
    def save(
        self, path: str | os.PathLike[str], *, format: str | None = None
    ) -> list[Loss]: ...
    def to_bytes(self, format: str) -> bytes: ...
    def render(
        self,
        *,
        size: tuple[int, int] = ...,
        view: tuple[float, float, float, float] | None = None,
        color_by: str | None = None,
        level: str | None = None,
        site: bool = False,
        title: str | None = None,
    ) -> Picture: ...
    def _repr_png_(self) -> bytes: ...

def open(
    source: str | os.PathLike[str] | bytes | _BinaryFile,
    *,
    area: tuple[float, float, float, float] | None = None,
    progress: Callable[[float], object] | None = None,
) -> Layout:
    """Reads a layout of any format; the content decides which.

    `area` is a box (min_x, min_y, max_x, max_y) in meters: of an Arrow file, only the record
    batches that may have points in it are read. Edges lose nodes that are elsewhere.
    """

def check_many(
    paths: Iterable[str | os.PathLike[str]],
    *,
    at_least: Literal["info", "warning", "error"] = "info",
    progress: Callable[[float], object] | None = None,
) -> Table:
    """The findings of many files as a table; a file that cannot be read is an error in it."""

class _TilerOptions(TypedDict, total=False):
    content: Literal["raster", "vector"]
    color_by: str | None
    level: str | None
    columns: Sequence[str] | None
    max_paths: int | None
    plane: bool
    grid: tuple[float, float, float] | None

@final
class Tiler:
    """Draws tiles of a layout by their addresses: a worker makes one and keeps it."""

    def __new__(
        cls,
        source: Layout | _ArrowStream,
        *,
        content: Literal["raster", "vector"] = "raster",
        color_by: str | None = None,
        level: str | None = None,
        columns: Sequence[str] | None = None,
        max_paths: int | None = None,
        plane: bool = False,
        grid: tuple[float, float, float] | None = None,
    ) -> Tiler: ...
    @property
    def grid(self) -> tuple[float, float, float] | None:
        """Upper left corner and side in meters of the square of zoom 0; `None` on earth."""

    def addresses(self, first_zoom: int, last_zoom: int) -> Table:
        """The tiles of some zooms that paths may touch: columns `z`, `x`, `y`."""

    @overload
    def draw(self, z: SupportsIndex, x: SupportsIndex, y: SupportsIndex) -> bytes | None: ...
    @overload
    def draw(
        self, z: _Numbers, x: Iterable[SupportsIndex], y: Iterable[SupportsIndex]
    ) -> list[bytes | None]: ...

_Numbers = SupportsIndex | Iterable[SupportsIndex]

@overload
def tiles(
    source: Layout | _ArrowStream,
    z: SupportsIndex,
    x: SupportsIndex,
    y: SupportsIndex,
    **options: Unpack[_TilerOptions],
) -> bytes | None: ...
@overload
def tiles(
    source: Layout | _ArrowStream,
    z: _Numbers,
    x: Iterable[SupportsIndex],
    y: Iterable[SupportsIndex],
    **options: Unpack[_TilerOptions],
) -> list[bytes | None]: ...
