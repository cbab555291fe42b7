"""Open-RMF by PyYAML and numpy, after the rules of rmf_building_map_tools."""

import json

import numpy as np
import yaml

from comparison import Reading
from lanelets import per_degree

FORMAT = "Open-RMF"
READER = "PyYAML, numpy"
TOLERANCE = 1.2e-4
# Meters per pixel of a level without a measurement: the default of the editor.
DEFAULT_SCALE = 0.05
LISTS = ("lanes", "walls", "doors", "human_lanes")


def files(folders):
    return folders.find("*.building.yaml", "*nav_graph*.yaml", "*.site.json")


def read(path):
    """The lanes, walls and doors by level, list and number."""
    if path.name.endswith(".json"):
        return _site(json.loads(path.read_text()))
    data = yaml.safe_load(path.read_text())
    system = data.get("coordinate_system", "reference_image")
    is_graph = "coordinate_system" not in data and "drawing" not in next(
        iter(data["levels"].values())
    )
    if system == "cartesian_meters" or is_graph:
        places = {name: _vertices(level) for name, level in data["levels"].items()}
    elif system == "reference_image":
        places = _aligned(data)
    elif system == "wgs84":
        places = _about_center(data)
    else:
        reading = Reading({}, keys=lambda answer: [None] * len(answer.ids))
        reading.skip(f"coordinates of the kind {system}")
        return reading
    reading = _lines(data, places)
    if is_graph:
        for name, door in (data.get("doors") or {}).items():
            reading.curves[name] = [np.array(door["endpoints"], float)]
    return reading


def _about_center(data):
    """Meters about the center of all vertices, which are x = longitude and y = latitude."""
    degrees = {name: _vertices(level) for name, level in data["levels"].items()}
    points = np.concatenate(list(degrees.values()))
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    return {name: (p - center) * per_degree(*center) for name, p in degrees.items()}


def _vertices(level):
    return np.array([v[:2] for v in level.get("vertices", [])], float).reshape(-1, 2)


def _aligned(data):
    """Meters of all levels: pixels times the scale of the reference level, by way of fiducials."""
    levels = data["levels"]
    reference = data.get("reference_level_name") or next(iter(levels))
    scale = _scale(levels[reference])
    found = {}
    for name, level in levels.items():
        pixels = _vertices(level)
        if name != reference:
            pixels = _onto(level, levels[reference], pixels)
        found[name] = pixels * scale * [1, -1] if pixels is not None else None
    return found


def _scale(level):
    scales = []
    vertices = _vertices(level)
    for start, end, parameters in level.get("measurements", []):
        pixels = np.linalg.norm(vertices[end] - vertices[start])
        scales.append(parameters["distance"][1] / pixels)
    return np.mean(scales) if scales else DEFAULT_SCALE


def _onto(level, reference, pixels):
    """Pixels of a level as pixels of the reference level: turned, scaled and moved by the means."""
    to = {f[2]: np.array(f[:2], float) for f in reference.get("fiducials", [])}
    own = {f[2]: np.array(f[:2], float) for f in level.get("fiducials", [])}
    names = [name for name in own if name in to]
    if len(names) < 2:
        return None
    scales, turns = [], []
    for i, first in enumerate(names):
        for second in names[i + 1 :]:
            ours, theirs = own[second] - own[first], to[second] - to[first]
            scales.append(np.linalg.norm(ours) / np.linalg.norm(theirs))
            turns.append(np.arctan2(theirs[1], theirs[0]) - np.arctan2(ours[1], ours[0]))
    turn = np.angle(np.mean(np.exp(1j * np.array(turns))))
    scale, c, s = 1 / np.mean(scales), np.cos(turn), np.sin(turn)
    turned = np.array([[c, -s], [s, c]])
    moved = np.mean([to[n] - scale * turned @ own[n] for n in names], axis=0)
    return scale * pixels @ turned.T + moved


def _lines(data, places):
    reading = Reading({})
    for name, level in data["levels"].items():
        for kind in LISTS:
            for number, item in enumerate(level.get(kind) or []):
                key = f"{name}.{kind}[{number}]"
                parameters = item[2] if len(item) > 2 else {}
                if kind == "doors":
                    key = _text(parameters.get("name")) or key
                if places[name] is None:
                    reading.skip("levels without two common fiducials", key)
                    continue
                reading.curves.setdefault(key, []).append(places[name][list(item[:2])])
    return reading


def _text(value):
    return value[1] if isinstance(value, list) else value


def _site(data):
    anchors = {int(i): a for i, a in data.get("anchors", {}).items()}
    items = dict(data.get("navigation", {}).get("guided", {}).get("lanes", {}))
    levels = data["levels"].values() if isinstance(data["levels"], dict) else data["levels"]
    names = {}
    for level in levels:
        anchors.update({int(i): a for i, a in level["anchors"].items()})
        for kind in ("walls", "doors"):
            items.update(level.get(kind, {}))
        names.update({i: door["name"] for i, door in level.get("doors", {}).items()})
    places = {i: a["Translate2D"] for i, a in anchors.items() if "Translate2D" in a}
    reading = Reading({})
    for number, item in items.items():
        ends = item.get("anchors")
        if all(end in places for end in ends):
            line = np.array([places[end] for end in ends])
            reading.curves.setdefault(names.get(number) or str(number), []).append(line)
        else:
            reading.skip("lanes into a lift", str(number))
    return reading
