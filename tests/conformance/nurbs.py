"""LIF and VDA 5050 by scipy: trajectories as B-splines in homogeneous coordinates."""

import json

import numpy as np
from scipy.interpolate import BSpline

import lines
from comparison import Reading

FORMAT = "LIF, VDA 5050"
READER = "scipy BSpline"
TOLERANCE = 1.2e-4


def files(folders):
    return folders.find("*.lif.json", "lif*.json", "*order*.json", "scenic_guideway.json")


def points_of(control, degree, knots, weights=None):
    """Points of a NURBS over its domain, from knot `degree` to knot n."""
    control = np.asarray(control, float)
    count = len(control)
    if weights is None:
        weights = np.ones(count)
    weights = np.asarray(weights, float)
    homogeneous = np.column_stack([control[:, :2] * weights[:, None], weights])
    spline = BSpline(np.asarray(knots, float), homogeneous, degree)
    domain = spline.t[degree : count + 1]

    def curve(t):
        found = spline(t)
        return found[:, :2] / found[:, 2:]

    return lines.flatten(curve, domain)


def read(path):
    """The trajectories of all edges, by the identifier of the edge."""
    data = json.loads(path.read_text("utf-8-sig"))
    reading = Reading({})
    for level in data.get("layouts") or [o for g in data.get("origins", []) for o in g["layouts"]]:
        nodes = {n["nodeId"]: _xy(n["nodePosition"]) for n in level["nodes"]}
        for edge in level["edges"]:
            _lif_edge(reading, edge, nodes)
    _order(reading, data.get("nodes", []), data.get("edges", []))
    return reading


def _lif_edge(reading, edge, nodes):
    name = edge["edgeId"]
    types = (
        edge.get("vehicleTypeEdgeProperties") or edge.get("mobileRobotTypeEdgeProperties") or [{}]
    )
    ends = [edge[k] for k in ("startNodeId", "endNodeId")]
    if not all(end in nodes for end in ends):
        reading.skip("edges between layouts", name)
        return
    for properties in types:
        straight = [nodes[end] for end in ends]
        _add(reading, name, properties.get("trajectory"), straight)
    reading.keys = _edge_ids


def _edge_ids(answer):
    """Several paths of one edge have its identifier in a column."""
    return [of or path for of, path in zip(answer.column("edgeId"), answer.ids)]


def _order(reading, nodes, edges):
    places = {n["sequenceId"]: n.get("nodePosition") for n in nodes}
    for edge in edges:
        ends = [places.get(edge["sequenceId"] + by) for by in (-1, 1)]
        if None in ends and not edge.get("trajectory"):
            reading.skip("edges without positions", edge["edgeId"])
            continue
        straight = [_xy(end) for end in ends if end]
        _add(reading, edge["edgeId"], edge.get("trajectory"), straight)


def _xy(place):
    return place["x"], place["y"]


def _add(reading, name, trajectory, straight):
    if not trajectory:
        reading.curves.setdefault(name, []).append(np.array(straight))
        return
    points = [_xy(point) for point in trajectory["controlPoints"]]
    degree = int(trajectory.get("degree", 1))
    knots = trajectory.get("knotVector") or []
    weights = [point.get("weight") or 1.0 for point in trajectory["controlPoints"]]
    if len(knots) != len(points) + degree + 1 or len(points) <= degree:
        reading.skip("trajectories that define no curve", name)
        return
    reading.curves.setdefault(name, []).append(points_of(points, degree, knots, weights))
