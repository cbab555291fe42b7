"""DXF by ezdxf: every curve of the model space, blocks placed, on its own points."""

import logging
import re

import ezdxf.recover
import numpy as np
from ezdxf import units
from ezdxf.entities import Insert

import lines
import nurbs
from comparison import Reading

FORMAT = "DXF"
READER = "ezdxf"
TOLERANCE = 1.2e-4
CURVES = {"LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE", "POLYLINE"}
DEEPEST = 40

logging.getLogger("ezdxf").setLevel(logging.CRITICAL)


def files(folders):
    return folders.find("*.dxf")


def read(path):
    """The curves by the handle of their entity in the model space; without handles, as a whole."""
    reading = Reading({})
    document = _load(path, reading)
    unit_m = _unit_m(document)
    for entity in document.modelspace():
        handle = entity.dxf.handle
        try:
            for leaf, layer in _leaves(entity, entity.dxf.get("layer", "0"), document, 0):
                if leaf.dxftype() not in CURVES or _is_hidden(leaf, layer, document):
                    continue
                if leaf.dxftype() == "SPLINE" and not leaf.control_points:
                    reading.skip("splines through fit points: approximate everywhere", handle)
                    continue
                for points in _flatten(leaf, lines.FLATNESS_M / unit_m):
                    polyline = np.array([(p[0], p[1]) for p in points]) * unit_m
                    reading.curves.setdefault(handle, []).append(polyline)
        except (ezdxf.DXFError, ValueError, ZeroDivisionError, IndexError) as error:
            reading.skip(f"ezdxf: {error}", handle)
    reading.keys = lambda answer: _keys(answer, reading, document)
    return reading


def _load(path, reading):
    try:
        document, auditor = ezdxf.recover.readfile(path)
    except (ezdxf.DXFError, UnicodeError, ValueError):
        return ezdxf.readfile(path)
    for fix in auditor.fixes:
        removed = re.search(r"Removed .*\(#([0-9A-F]+)\)", fix.message)
        if removed:
            reading.skip("removed by ezdxf's audit", removed[1])
    return document


def _keys(answer, reading, document):
    known = {entity.dxf.handle for entity in document.modelspace()} | reading.ignored
    keys = [path.split("/")[0].split("[")[0].split(" ")[0] for path in answer.ids]
    is_curve = [kind in CURVES for kind in answer.column("entity")]
    if not known.issuperset(keys):
        # A file without handles: ezdxf numbers the entities, Guideway names their lines.
        whole = [part for parts in reading.curves.values() for part in parts]
        reading.curves = {"the drawing": whole}
        keys = ["the drawing"] * len(keys)
        if reading.ignored:
            reading.skip("no handles, and entities that are not compared", "the drawing")
    return [key if curve else None for key, curve in zip(keys, is_curve)]


def _unit_m(document):
    code = document.header.get("$INSUNITS", 0)
    if code == 0:
        return 0.0254 if document.header.get("$LUNITS", 2) in (3, 4) else 0.001
    return units.conversion_factor(units.InsertUnits(code), units.InsertUnits.Meters)


def _leaves(entity, layer, document, depth):
    """The entities that an entity consists of, each with the layer that decides if it is seen."""
    if not isinstance(entity, Insert):
        yield entity, layer
        return
    if depth > DEEPEST or _is_hidden(entity, layer, document) or entity.block() is None:
        return
    for placed in entity.multi_insert() if entity.mcount > 1 else [entity]:
        for child in placed.virtual_entities():
            own = child.dxf.get("layer", "0")
            yield from _leaves(child, layer if own == "0" else own, document, depth + 1)


def _is_hidden(entity, layer, document):
    if entity.dxf.get("invisible", 0):
        return True
    if layer not in document.layers:
        return False
    found = document.layers.get(layer)
    return found.is_off() or found.is_frozen()


def _flatten(entity, sagitta):
    kind = entity.dxftype()
    if kind == "LINE":
        yield [entity.dxf.start, entity.dxf.end]
    elif kind in ("LWPOLYLINE", "POLYLINE"):
        if kind == "POLYLINE" and not (entity.is_2d_polyline or entity.is_3d_polyline):
            return
        if kind == "POLYLINE" and entity.dxf.flags & 4:
            # Fitted by a spline: the points of its frame (flag 16) are not on the line.
            yield [v.dxf.location for v in entity.vertices if not v.dxf.flags & 16]
            return
        for part in entity.virtual_entities():
            yield from _flatten(part, sagitta)
    elif kind in ("ARC", "CIRCLE", "ELLIPSE"):
        yield list(entity.flattening(sagitta))
    elif kind == "SPLINE":
        yield _spline(entity, sagitta)


def _spline(entity, sagitta):
    knots, degree = list(entity.knots), entity.dxf.degree
    count = len(entity.control_points)
    clamped = knots and knots[0] == knots[degree] and knots[count] == knots[-1]
    if clamped or len(knots) != count + degree + 1:
        return list(entity.flattening(sagitta, segments=16))
    # ezdxf begins at the first knot, where the basis functions do not sum to 1.
    return nurbs.points_of(entity.control_points, degree, knots, entity.weights or None)
