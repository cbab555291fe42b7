"""SVG against pictures of resvg: where there is a line there is ink, and an edge has a line."""

import re

import numpy as np
import shapely
from PIL import Image
from scipy.ndimage import distance_transform_edt

import lines
import svg
from comparison import Result

FORMAT = "SVG"
READER = "resvg's pictures"
UNIT = "px"
# Half a pixel of either rasterization, and the half of a pixel's diagonal.
TOLERANCE = 1.5
# Least difference of opacity or color that makes an edge, of 255.
EDGE = 96
# Inks without an outline of their own.
UNLIKE = {
    "texts": rb"<(text|tspan)\b",
    "markers": rb"\bmarker",
    "patterns": rb"<pattern\b",
    "filters": rb"<filter\b",
    "clip paths and masks": rb"<(clipPath|mask)\b",
    "images": rb"<image\b",
    "dashes": rb"stroke-dasharray",
    "line ends other than butt, and joins": rb"stroke-linejoin|stroke-linecap",
    "viewports, which clip": rb"<symbol\b|<svg[^>]*>[\s\S]*<svg\b|slice",
    "pages without a plain size": rb"<svg[^>]*(width|height)=.(-|0.|[^\"']*%)",
}
# Pictures that differ for a reason.
DIFFERENT = {
    "painting/color/recursive-nested-context-without-color": "context paints have the view's color",
    "painting/context/without-context-element": "context paints have the view's color",
    "painting/stroke-width/negative": "an invalid width counts as none given, as CSS says",
    "shapes/rect/q-values": "resvg does not know the unit Q",
    "shapes/rect/rem-values": "resvg does not know the unit rem",
    "structure/systemLanguage/on-svg": "a page in another language is drawn all the same",
    "structure/style-attribute/non-presentational-attribute": "styles state lengths, as SVG 2 says",
    "structure/svg/no-size": "the page of resvg is its content",
}


def files(folders):
    pairs = folders.find("*.svg", below=["conformance/resvg"])
    return [file for file in pairs if file.with_suffix(".png").exists()]


def compare(answer, path):
    """Compares the lines of an answer with the picture beside its file, in pixels."""
    result = Result()
    content = path.read_bytes()
    reason = DIFFERENT.get("/".join(path.with_suffix("").parts[-3:]))
    if reason:
        result.skipped[reason] = 1
        return result
    for reason, pattern in UNLIKE.items():
        if re.search(pattern, content):
            result.skipped[reason] = 1
            return result
    picture = np.asarray(Image.open(path.with_suffix(".png")).convert("RGBA"), int)
    scale, origin = _page(content, picture.shape)
    px_per_m = scale / svg.PX_M
    widths = answer.column("width_m")
    drawn = []
    for row, found in answer.lines_by(answer.firsts()).items():
        half = (widths[row] or 0) * px_per_m / 2
        drawn.append((found * px_per_m * [1, -1] + origin, 0 if np.isnan(half) else half))
    result.elements = len(set(answer.ids))
    result.take(_without_ink(drawn, picture), "a line without ink")
    result.take(_without_line(drawn, picture), "an edge without a line")
    result.elements -= 2
    return result


def _page(content, shape):
    """Pixels of the picture per pixel of the page, and the place of the origin of the drawing."""
    root = re.search(rb"<svg\b[^>]*>", content)[0]
    box = re.search(rb"viewBox=.([^\"']*)", root)
    size = [
        re.search(rb"\s" + name + rb"=.([0-9.]+)(px)?[\"']", root) for name in (b"width", b"height")
    ]
    box = [float(v) for v in box[1].replace(b",", b" ").split()] if box else None
    width, height = (float(s[1]) if s else box[2 + axis] for axis, s in enumerate(size))
    scale = np.array([shape[1] / width, shape[0] / height])
    if box is None:
        return scale[0], np.zeros(2)
    unit = np.array([width, height]) / box[2:]
    if b"preserveAspectRatio" in root:
        align = re.search(rb"preserveAspectRatio=.(\w+)", root)[1].decode()
    else:
        align = "xMidYMid"
    if align == "none":
        return scale[0], -np.array(box[:2]) * unit * scale
    unit = min(unit)
    rest = np.array([width, height]) - np.array(box[2:]) * unit
    share = [{"Min": 0, "Mid": 0.5, "Max": 1}[align[at : at + 3]] for at in (1, 5)]
    return scale[0], (rest * share - np.array(box[:2]) * unit) * scale


def _without_ink(drawn, picture):
    """The farthest point of a line from ink."""
    ink = picture[..., 3] > 8
    if not drawn:
        return 0.0
    if not ink.any():
        return np.inf
    to_ink = distance_transform_edt(~ink)
    height, width = ink.shape
    farthest = 0.0
    for found, _ in drawn:
        for t in np.linspace(0, 1, 9):
            points = found[:, 0] * (1 - t) + found[:, 1] * t
            inside = ((points > 2) & (points < [width - 2, height - 2])).all(axis=1)
            x, y = points[inside].astype(int).T
            farthest = max(farthest, to_ink[y, x].max(initial=0.0))
    return farthest


def _stroke(found, half):
    """The area of lines of a width, with mitered corners and open ends."""
    found = found[np.linalg.norm(found[:, 1] - found[:, 0], axis=1) > 0]
    if len(found) == 0:
        return shapely.MultiPolygon()
    gaps = np.linalg.norm(found[1:, 0] - found[:-1, 1], axis=1) > 0.05
    chains = np.split(found, np.nonzero(gaps)[0] + 1)
    whole = []
    for chain in chains:
        points = np.concatenate([chain[:, 0], chain[-1:, 1]])
        is_ring = len(points) > 3 and np.linalg.norm(points[0] - points[-1]) < 0.05
        whole.append(shapely.linearrings(points[:-1]) if is_ring else shapely.linestrings(points))
    style = {"cap_style": "flat", "join_style": "mitre", "mitre_limit": 4}
    return shapely.union_all([part.buffer(half, **style) for part in whole])


def _without_line(drawn, picture):
    """The farthest edge of ink from the edge of a line."""
    edges = np.zeros(picture.shape[:2], bool)
    mixed = picture.copy()
    mixed[..., :3] = picture[..., :3] * picture[..., 3:] // 255
    for axis in (0, 1):
        steps = np.abs(np.diff(mixed, axis=axis)).max(axis=2) > EDGE
        edges |= np.pad(steps, ((0, 1), (0, 0)) if axis == 0 else ((0, 0), (0, 1)))
    y, x = np.nonzero(edges)
    if len(x) == 0:
        return 0.0
    if not drawn:
        return np.inf
    points = np.column_stack([x + 0.5, y + 0.5])
    rest = np.full(len(points), np.inf)
    for found, half in drawn:
        if half == 0:
            away = lines.distances(points, found)
        else:
            area = _stroke(found, half)
            away = shapely.distance(shapely.points(points), area) if area.area else np.inf
        rest = np.minimum(rest, away)
    return max(float(rest.max()), 0.0)
