"""Lanelet2 by its own library: ways, and the middle between the bounds that it directs."""

import lanelet2
import numpy as np
from lanelet2.projection import UtmProjector
from lxml import etree
from pyproj import Geod

from comparison import Reading

FORMAT = "Lanelet2"
READER = "lanelet2"
TOLERANCE = 1.2e-4


def files(folders):
    return folders.find("*.osm")


def read(path):
    """The ways and lanelets by their numbers; both in meters about the center of the map."""
    nodes = list(etree.parse(path).getroot().iter("node"))
    tags = [{t.get("k"): t.get("v") for t in node.iter("tag")} for node in nodes]
    if all("local_x" in tag and "local_y" in tag for tag in tags):
        places = {
            int(n.get("id")): (float(t["local_x"]), float(t["local_y"]))
            for n, t in zip(nodes, tags)
        }
    else:
        places = _about_center(
            {int(n.get("id")): (float(n.get("lon")), float(n.get("lat"))) for n in nodes}
        )
    origin = lanelet2.io.Origin(float(nodes[0].get("lat")), float(nodes[0].get("lon")))
    read, errors = lanelet2.io.loadRobust(str(path), UtmProjector(origin))
    # Ways and lanelets are numbered apart.
    reading = Reading({}, keys=lambda answer: list(zip(answer.column("element"), answer.ids)))
    for _ in errors:
        reading.skip("errors of lanelet2")
    for line in read.lineStringLayer:
        reading.curves["way", str(line.id)] = [_points(line, places)]
    for lanelet in read.laneletLayer:
        left, right = (_points(bound, places) for bound in (lanelet.leftBound, lanelet.rightBound))
        reading.curves["lanelet", str(lanelet.id)] = [middle(left, right)]
    return reading


def _points(line, places):
    return np.array([places[point.id] for point in line if point.id in places])


def _about_center(degrees):
    """Meters about the center of the bounds, by the radii of the ellipsoid of WGS 84."""
    points = np.array(list(degrees.values()))
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    scale = per_degree(*center)
    return {i: tuple((np.array(p) - center) * scale) for i, p in degrees.items()}


def per_degree(longitude, latitude):
    """Meters per degree east and north, measured with geodesics of pyproj."""
    geod, step = Geod(ellps="WGS84"), 1e-4
    east = geod.inv(longitude - step, latitude, longitude + step, latitude)[2]
    north = geod.inv(longitude, latitude - step, longitude, latitude + step)[2]
    return np.array([east, north]) / (2 * step)


def middle(left, right):
    """The points between two bounds at equal fractions of their lengths."""
    fractions = [_fractions(bound) for bound in (left, right)]
    at = np.unique(np.concatenate(fractions))
    found = [
        np.column_stack([np.interp(at, of, bound[:, axis]) for axis in (0, 1)])
        for of, bound in zip(fractions, (left, right))
    ]
    return (found[0] + found[1]) / 2


def _fractions(bound):
    lengths = np.linalg.norm(np.diff(bound, axis=0), axis=1)
    return np.concatenate([[0], np.cumsum(lengths)]) / max(lengths.sum(), 1e-300)
