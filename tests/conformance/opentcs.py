"""openTCS plants by numpy: Bezier curves by their Bernstein form, in the units of the drawing."""

import numpy as np
from lxml import etree

import lines
from comparison import Reading

FORMAT = "openTCS"
READER = "numpy, Bernstein"
TOLERANCE = 1.2e-4


def files(folders):
    return folders.find("Demo*.xml", "PlantModel*.xml", "otcs4*.xml")


def read(path):
    """The paths by their names: from point to point as drawn, by way of their control points."""
    model = etree.parse(path, etree.XMLParser(recover=False, resolve_entities=False)).getroot()
    for element in model.iter():
        element.tag = etree.QName(element).localname if isinstance(element.tag, str) else ""
    scale = _scale_m(model)
    drawings = _drawings(model)
    points = {p.get("name"): _place(p, drawings) for p in model.iter("point")}
    reading = Reading({})
    names = [point.get("name") for point in model.iter("point")]
    twice = {name for name in names if names.count(name) > 1}
    hidden = _hidden_layers(model)
    for path in model.iter("path"):
        name = path.get("name")
        layout = path.find("pathLayout")
        layer = layout.get("layerId") if layout is not None else None
        if layer in hidden:
            reading.skip("paths on hidden layers", name)
            continue
        if twice & {path.get("sourcePoint"), path.get("destinationPoint")}:
            reading.skip("points with a name given twice", name)
            continue
        ends = [points[path.get(key)] for key in ("sourcePoint", "destinationPoint")]
        kind, control = _control_points(path, drawings, scale)
        reading.curves[name] = [_curve(kind, [ends[0], *control, ends[1]])]
        if float(path.get("maxVelocity", "0")) == 0 < float(path.get("maxReverseVelocity", "0")):
            reading.curves[name][0] = reading.curves[name][0][::-1]
    return reading


def _scale_m(model):
    visual = model.find("visualLayout")
    if visual is None:
        return (0.05, 0.05)
    scale = [float(visual.get(key)) / 1000 for key in ("scaleX", "scaleY")]
    return [value if value > 0 else 0.05 for value in scale]


def _hidden_layers(model):
    groups = {g.get("id") for g in model.iter("layerGroup") if g.get("visible") == "false"}
    layers = model.iter("layer")
    return {
        m.get("id") for m in layers if m.get("visible") == "false" or m.get("groupId") in groups
    }


def _drawings(model):
    """The properties of drawn elements by name, as models before version 4 have them."""
    return {
        drawn.get("visualizedObjectName"): {p.get("name"): p.get("value") for p in drawn}
        for drawn in model.iter("modelLayoutElement")
    }


def _place(point, drawings):
    layout = point.find("pointLayout")
    drawn = drawings.get(point.get("name"), {})
    for of, names in (
        (layout, ("positionX", "positionY")),
        (layout, ("xPosition", "yPosition")),
        (drawn, ("POSITION_X", "POSITION_Y")),
        (point, ("positionX", "positionY")),
        (point, ("xPosition", "yPosition")),
    ):
        if of is not None and of.get(names[0]) is not None:
            return [float(of.get(name)) / 1000 for name in names]
    raise ValueError(f"the point {point.get('name')} has no position")


def _control_points(path, drawings, scale):
    layout, drawn = path.find("pathLayout"), drawings.get(path.get("name"), {})
    if layout is None:
        kind = drawn.get("CONN_TYPE", "DIRECT")
        control = [pair.split(",") for pair in drawn.get("CONTROL_POINTS", "").split(";") if pair]
    else:
        kind = layout.get("connectionType", "DIRECT")
        control = [(c.get("x"), c.get("y")) for c in path.iter("controlPoint")]
    return kind, [[float(x) * scale[0], -float(y) * scale[1]] for x, y in control]


def _curve(kind, control):
    control = np.array(control)
    if kind in ("DIRECT", "ELBOW", "SLANTED"):
        return control[[0, -1]]
    if kind == "BEZIER" and len(control) in (3, 4):
        return lines.bezier(control)
    if kind == "BEZIER_3" and len(control) == 7:
        return np.concatenate([lines.bezier(control[:4]), lines.bezier(control[3:])])
    return control
