"""OpenDRIVE by own integration: reference lines by Gauss-Legendre quadrature, lanes beside them."""

from dataclasses import dataclass

import numpy as np
from lxml import etree

import lines
from comparison import Reading

FORMAT = "OpenDRIVE"
READER = "numpy quadrature"
TOLERANCE = 1.2e-4
# Nodes and weights on the interval from 0 to 1.
NODES, WEIGHTS = ((v + shift) / 2 for v, shift in zip(np.polynomial.legendre.leggauss(12), (1, 0)))


def files(folders):
    return folders.find("*.xodr")


def read(path):
    """The center lines of all lanes as `road.section.lane`, in the direction of traffic."""
    root = etree.parse(path, etree.XMLParser(huge_tree=True)).getroot()
    for element in root.iter():
        if isinstance(element.tag, str):
            element.tag = etree.QName(element).localname
    reading = Reading({}, directed=True)
    for road in root.iter("road"):
        _road(reading, road)
    return reading


def _road(reading, road):
    plan = [_Geometry(g) for g in road.iterfind("planView/geometry")]
    length = max(plan[-1].s + plan[-1].length, float(road.get("length")))
    offsets = _records(road.iterfind("lanes/laneOffset"), "s")
    sections = road.findall("lanes/laneSection")
    starts = [float(section.get("s")) for section in sections]
    keep_left = road.get("rule") == "LHT"
    for index, section in enumerate(sections):
        end = starts[index + 1] if index + 1 < len(sections) else length
        end = min(end, plan[-1].s + plan[-1].length)
        sides = {side: _lanes(section, side) for side in ("left", "right")}
        chosen = [(side, lane) for side in sides for lane in sides[side]]
        if not chosen:
            chosen = [("center", None)]
        for side, lane in chosen:
            number = lane.get("id") if lane is not None else "0"
            inner = _up_to(sides[side], lane) if lane is not None else []
            profile = _Profile(offsets, inner, starts[index], -1 if side == "right" else 1)
            found = _beside(plan, profile, starts[index], end)
            if side != "center" and (side == "left") != keep_left:
                found = [part[::-1] for part in reversed(found)]
            reading.curves[f"{road.get('id')}.{index}.{number}"] = found


def _lanes(section, side):
    """The lanes of a side, from the inside to the outside."""
    return sorted(section.iterfind(f"{side}/lane"), key=lambda lane: abs(int(lane.get("id"))))


def _up_to(lanes, lane):
    return lanes[: lanes.index(lane) + 1]


@dataclass
class _Record:
    s: float
    coefficients: list

    def at(self, s):
        return np.polynomial.polynomial.polyval(s - self.s, self.coefficients)


def _records(elements, key, base=0.0):
    found = [
        _Record(base + float(e.get(key, 0)), [float(e.get(c, 0)) for c in "abcd"]) for e in elements
    ]
    return sorted(found, key=lambda record: record.s)


def _valid(records, s):
    before = [record for record in records if record.s <= s]
    return before[-1] if before else None


class _Profile:
    """The distance of the center of a lane from the reference line, left positive."""

    def __init__(self, offsets, lanes, start, side):
        self.offsets, self.side = offsets, side
        self.lanes = [
            (
                _records(lane.iterfind("width"), "sOffset", start),
                _records(lane.iterfind("border"), "sOffset", start),
            )
            for lane in lanes
        ]

    def breaks(self):
        every = [self.offsets, *(records for lane in self.lanes for records in lane)]
        return [record.s for records in every for record in records]

    def at(self, s, middle):
        """Values at an array of distances, by the records that hold at `middle`."""
        offset = _valid(self.offsets, middle)
        base = offset.at(s) if offset else np.zeros_like(s)
        inner = outer = np.zeros_like(s)
        for widths, borders in self.lanes:
            inner = outer
            width, border = _valid(widths, middle), _valid(borders, middle)
            if width:
                outer = inner + width.at(s)
            elif border:
                outer = np.abs(border.at(s))
        return base + self.side * (inner + outer) / 2


class _Geometry:
    """A piece of the reference line."""

    def __init__(self, element):
        self.s, self.x, self.y, self.hdg, self.length = (
            float(element.get(key)) for key in ("s", "x", "y", "hdg", "length")
        )
        shape = next(child for child in element if child.tag != "userData")
        self.kind = shape.tag
        self.values = {key: float(v) if key != "pRange" else v for key, v in shape.attrib.items()}
        if self.kind in ("poly3", "paramPoly3"):
            self._tabulate()

    def at(self, s):
        """Positions and headings at distances along the road."""
        along = s - self.s
        if self.kind in ("line", "arc", "spiral"):
            start = self.values.get("curvature", self.values.get("curvStart", 0.0))
            change = (self.values.get("curvEnd", start) - start) / max(self.length, 1e-300)
            return self._clothoid(along, start, change)
        p = np.interp(along, self.arc, self.p)
        u, v, du, dv = self._polynomial(p)
        c, sn = np.cos(self.hdg), np.sin(self.hdg)
        points = np.column_stack([self.x + c * u - sn * v, self.y + sn * u + c * v])
        return points, self.hdg + np.arctan2(dv, du)

    def _clothoid(self, along, start, change):
        def heading(s):
            return self.hdg + s * (start + change * s / 2)

        # Panels of at most a fifth of a turn and 5 m, each integrated to the last bit.
        bend = abs(start) + abs(change) * self.length
        panels = int(np.ceil(max(bend * self.length, self.length / 5, 1)))
        size = self.length / panels
        angles = heading((np.arange(panels)[:, None] + NODES) * size)
        steps = np.stack([np.cos(angles) @ WEIGHTS, np.sin(angles) @ WEIGHTS], axis=1) * size
        corners = np.concatenate([[[self.x, self.y]], [self.x, self.y] + np.cumsum(steps, axis=0)])
        panel = np.clip((along / max(size, 1e-300)).astype(int), 0, panels - 1)
        rest = along - panel * size
        angles = heading(panel[:, None] * size + rest[:, None] * NODES)
        last = np.stack([np.cos(angles) @ WEIGHTS, np.sin(angles) @ WEIGHTS], axis=1)
        return corners[panel] + last * rest[:, None], heading(along)

    def _polynomial(self, p):
        v, poly = self.values, np.polynomial.polynomial
        if self.kind == "poly3":
            side = [v[key] for key in "abcd"]
            return p, poly.polyval(p, side), np.ones_like(p), poly.polyval(p, poly.polyder(side))
        forward, side = ([v[key + axis] for key in "abcd"] for axis in "UV")
        parts = [(poly.polyval(p, c), poly.polyval(p, poly.polyder(c))) for c in (forward, side)]
        return parts[0][0], parts[1][0], parts[0][1], parts[1][1]

    def _tabulate(self):
        """Parameters at equal steps, and the arc length there in proportion to the stated one."""
        end = self.length if self.kind == "poly3" else self._range()
        count = 4_000
        p = np.linspace(0, end, count + 1)
        step = end / count
        inside = p[:-1, None] + NODES * step
        _, _, du, dv = self._polynomial(inside.ravel())
        speed = np.hypot(du, dv).reshape(inside.shape) @ WEIGHTS * step
        arc = np.concatenate([[0], np.cumsum(speed)])
        if self.kind == "poly3":
            # The stated length ends the curve, which goes on for as long as it takes.
            p, arc = p[arc <= self.length], arc[arc <= self.length]
        self.p, self.arc = p, arc * (self.length / arc[-1])

    def _range(self):
        return self.length if self.values.get("pRange") == "arcLength" else 1.0


def _beside(plan, profile, start, end):
    """The line beside the reference line, in pieces between all places where a record begins."""
    breaks = [start, end, *profile.breaks(), *(g.s for g in plan)]
    breaks = np.unique([s for s in breaks if start <= s <= end])
    found = []
    for first, last in zip(breaks[:-1], breaks[1:]):
        middle = (first + last) / 2
        geometry = [g for g in plan if g.s <= middle] or plan[:1]

        def curve(s, geometry=geometry[-1], middle=middle):
            points, heading = geometry.at(s)
            t = profile.at(s, middle)
            return points + np.column_stack([-np.sin(heading) * t, np.cos(heading) * t])

        if last - first > 1e-9:
            found.append(lines.flatten(curve, [first, last]))
    return found
