"""SVG by svgelements: the outlines of all shapes, as seen on the page."""

import numpy as np
from lxml import etree
from svgelements import SVG, Arc, Close, Line, Matrix, Move, Path, Shape

import lines
from comparison import Reading

FORMAT = "SVG"
READER = "svgelements"
TOLERANCE = 1.2e-4
# A pixel of CSS in meters.
PX_M = 0.0254 / 96


def files(folders):
    return folders.find("*.svg")


def read(path):
    """The outlines of the drawing as a whole, with y up."""
    page, origin = page_of(path)
    reading = Reading({}, keys=lambda answer: ["the drawing"] * len(answer.ids))
    found = []
    for shape in page.elements():
        if not isinstance(shape, Shape) or _is_unseen(shape):
            continue
        for piece in Path(shape).reify():
            points = _points(piece)
            if points is not None:
                found.append((points - origin) * PX_M * [1, -1])
    reading.curves = {"the drawing": found}
    return reading


def page_of(path):
    """The page, and where the origin of the drawing lies on it, in pixels with y down.

    Guideway keeps the origin of the drawing, svgelements that of the page.
    """
    root = etree.parse(path, etree.XMLParser(huge_tree=False, load_dtd=False)).getroot()
    box = [float(v) for v in (root.get("viewBox") or "").replace(",", " ").split()]
    size = {"width": box[2], "height": box[3]} if len(box) == 4 else {}
    page = SVG.parse(path, reify=False, ppi=96, **size)
    origin = Matrix(page.viewbox_transform).point_in_matrix_space((0, 0)) if box else (0, 0)
    return page, np.array([origin[0], origin[1]])


def _is_unseen(shape):
    values = shape.values
    if values.get("visibility") in ("hidden", "collapse") or values.get("display") == "none":
        return True
    stroke = shape.stroke.value is not None and (shape.stroke_width or 0) > 0
    return not stroke and shape.fill.value is None


def _points(piece):
    if isinstance(piece, Move) or piece.start is None or piece.end is None:
        return None
    if isinstance(piece, (Line, Close)):
        return _xy((piece.start, piece.end))
    if isinstance(piece, Arc) and (piece.rx == 0 or piece.ry == 0):
        return _xy((piece.start, piece.end))
    if isinstance(piece, Arc):
        flat = lines.flatten(lambda t: _xy(map(piece.point, t)) * PX_M, [0, 1])
    else:
        controls = [
            getattr(piece, name, None)
            for name in ("start", "control", "control1", "control2", "end")
        ]
        flat = lines.bezier(_xy(point for point in controls if point is not None) * PX_M)
    return flat / PX_M


def _xy(points):
    return np.array([(point.x, point.y) for point in points], float)
