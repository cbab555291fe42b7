"""Compares the paths of one file with those of another reader, element by element."""

from dataclasses import dataclass, field

import numpy as np

import lines


@dataclass
class Reading:
    """What another reader makes of a file."""

    # Lines per key, in meters with y up: lists of polylines, shape (n, 2).
    curves: dict
    # The keys of the paths of an answer; `None` leaves a path out. By default their identifiers.
    keys: object = lambda answer: answer.ids
    # Curves begin and end where their paths do.
    directed: bool = False
    # Reasons for which elements are not compared, with their number.
    skipped: dict = field(default_factory=dict)
    # Keys that are not compared, whoever reads them.
    ignored: set = field(default_factory=set)

    def skip(self, reason, key=None):
        """Counts an element that is not compared."""
        self.skipped[reason] = self.skipped.get(reason, 0) + 1
        if key is not None:
            self.ignored.add(key)


@dataclass
class Result:
    """The comparison of a file."""

    elements: int = 0
    deviation: float = 0.0
    at: str = ""
    faults: list = field(default_factory=list)
    skipped: dict = field(default_factory=dict)

    def take(self, deviation, at):
        """Counts an element and its deviation."""
        self.elements += 1
        if not deviation <= self.deviation:
            self.deviation, self.at = deviation, at


def compare(answer, reading):
    """Compares Guideway's answer with another reading."""
    result = Result(skipped=dict(reading.skipped))
    ours = answer.lines_by(reading.keys(answer))
    theirs = {}
    for key, polylines in reading.curves.items():
        parts = [lines.from_points(p) for p in polylines if len(p) > 1]
        parts = [part for part in parts if _has_length(part)]
        if parts:
            theirs[key] = np.concatenate(parts)
    ours = {key: found for key, found in ours.items() if _has_length(found)}
    for key, expected in theirs.items():
        if key in reading.ignored or _name(key) in answer.refused:
            continue
        if key not in ours:
            result.faults.append(f"`{key}` is missing")
            continue
        deviation = lines.farthest(ours[key], expected)
        if reading.directed and answer.ids.count(_name(key)) == 1:
            ends = ours[key][[0, -1], [0, 1]] - expected[[0, -1], [0, 1]]
            deviation = max(deviation, np.linalg.norm(ends, axis=1).max())
        result.take(float(deviation), str(key))
    for key in ours.keys() - theirs.keys() - reading.ignored:
        result.faults.append(f"`{key}` is read by Guideway alone")
    return result


def _name(key):
    return key[-1] if isinstance(key, tuple) else key


def _has_length(found):
    return len(found) > 0 and np.ptp(found.reshape(-1, 2), axis=0).max() > 1e-9
