"""GeoJSON by numpy, with positions on earth by pyproj: its units, scales and geodesics."""

import json

import numpy as np
from pyproj import CRS, Transformer

from comparison import Reading
from lanelets import per_degree

FORMAT = "GeoJSON"
READER = "numpy, pyproj"
TOLERANCE = 1.2e-4


def files(folders):
    # No real file states a system; the cases of public reports do.
    cases = folders.find("g01*.geojson", "g02[!h]*.geojson", "g06*.geojson", below=["cases"])
    return folders.find("*.geojson", "no_frame.json") + cases


def read(path):
    """The lines of all features; by identifier where each feature has one, else as a whole."""
    data = json.loads(path.read_text())
    features = [f for f in data["features"] if f["geometry"]]
    reading = Reading({})
    found = [(_name(f), part) for f in features for part in _parts(f["geometry"])]
    is_graph = any("startid" in (f["properties"] or {}) for f in features)
    nodes = [f["geometry"]["coordinates"] for f in features if f["geometry"]["type"] == "Point"]
    lines_m = _meters(data, [p for _, p in found], is_graph, nodes)
    names = [name for name, _ in found]
    if None in names or len(set(names)) < len(names):
        names = ["the file"] * len(names)
        reading.keys = lambda answer: ["the file"] * len(answer.ids)
    for name, line in zip(names, lines_m):
        reading.curves.setdefault(name, []).append(line)
    return reading


def _name(feature):
    own = feature.get("id", (feature["properties"] or {}).get("id"))
    return None if own is None else str(own)


def _parts(geometry):
    points = geometry["coordinates"]
    kind = geometry["type"]
    if kind == "LineString":
        # A graph of Nav2 has a line nested as in a MultiLineString.
        yield from points if isinstance(points[0][0], list) else [points]
    elif kind in ("MultiLineString", "Polygon"):
        yield from points
    elif kind == "MultiPolygon":
        yield from (ring for polygon in points for ring in polygon)


def _meters(data, parts, is_graph, nodes):
    """The lines in meters: in the unit of the system, or about the center of positions on earth."""
    flat = [np.array([p[:2] for p in part], float) for part in parts]
    name = (data.get("crs") or {}).get("properties", {}).get("name")
    if is_graph or not flat:
        return flat
    every = np.concatenate([*flat, *[np.array([p[:2]], float) for p in nodes]])
    if name is None:
        if np.abs(every).max(axis=0)[0] > 180 or np.abs(every).max(axis=0)[1] > 90:
            return flat
        name = "OGC:CRS84"
    system = CRS.from_user_input(name)
    method = system.coordinate_operation.method_name if system.is_projected else "Mercator"
    if "Mercator" not in method or "Transverse" in method:
        return [p * system.axis_info[0].unit_conversion_factor for p in flat]
    to_degrees = Transformer.from_crs(system, "OGC:CRS84", always_xy=True)
    degrees = [np.column_stack(to_degrees.transform(p[:, 0], p[:, 1])) for p in flat]
    every = np.column_stack(to_degrees.transform(every[:, 0], every[:, 1]))
    center = (every.min(axis=0) + every.max(axis=0)) / 2
    return [(p - center) * per_degree(*center) for p in degrees]
