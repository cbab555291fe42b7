"""Flattens curves to lines, and measures the distance between two sets of lines."""

from math import comb

import numpy as np
import shapely

# Largest distance between a curve and its lines, in meters: a small part of every tolerance.
FLATNESS_M = 5e-6
# Most lines per cubic segment.
MOST_LINES = 4096


def flatten_runs(segments):
    """Lines of uniform cubic segments, shape (n, 4, 2), within FLATNESS_M.

    Returns the lines, shape (m, 2, 2), and the number of the segment of each.
    """
    bends = segments[:, :-2] - 2 * segments[:, 1:-1] + segments[:, 2:]
    bend = np.linalg.norm(bends, axis=2).max(axis=1)
    counts = np.clip(np.ceil(np.sqrt(bend / (8 * FLATNESS_M))), 1, MOST_LINES).astype(int)
    owners = np.repeat(np.arange(len(segments)), counts)
    step = np.arange(len(owners)) - np.repeat(np.cumsum(counts) - counts, counts)
    size = counts[owners]
    ends = [evaluate(segments[owners], (step + by) / size) for by in (0, 1)]
    return np.stack(ends, axis=1), owners


def evaluate(segments, t):
    """Points of uniform cubic B-spline segments at parameters from 0 to 1."""
    t = t[:, None]
    basis = (
        (1 - t) ** 3,
        3 * t**3 - 6 * t**2 + 4,
        -3 * t**3 + 3 * t**2 + 3 * t + 1,
        t**3,
    )
    return sum(b * segments[:, i] for i, b in enumerate(basis)) / 6


def from_points(points):
    """Lines through points, shape (n, 2)."""
    points = np.asarray(points, float)[:, :2]
    return np.stack([points[:-1], points[1:]], axis=1)


def farthest(lines, others):
    """The largest distance of an end of `lines` from `others`, in both directions."""
    return max(_one_way(lines, others), _one_way(others, lines))


def _one_way(lines, others):
    return float(distances(np.unique(lines.reshape(-1, 2), axis=0), others).max())


def distances(points, lines):
    """The distance of each point from the nearest of the lines."""
    if len(points) * len(lines) <= 200_000:
        return _distances(points, lines).min(axis=1)
    tree = shapely.STRtree(shapely.linestrings(lines))
    _, found = tree.query_nearest(shapely.points(points), all_matches=False, return_distance=True)
    return found


def _distances(points, lines):
    start, along = lines[:, 0], lines[:, 1] - lines[:, 0]
    square = np.maximum((along**2).sum(axis=1), 1e-300)
    to = points[:, None] - start[None]
    t = np.clip((to * along).sum(axis=2) / square, 0, 1)
    return np.linalg.norm(to - t[..., None] * along, axis=2)


def flatten(curve, breaks):
    """Points of a curve, a function of an array of parameters, within FLATNESS_M of it.

    `breaks` are the parameters where the curve may have a kink, in order.
    """
    breaks = np.unique(np.asarray(breaks, float))
    spans = zip(breaks[:-1], breaks[1:])
    t = np.append(np.concatenate([np.linspace(*s, 8, endpoint=False) for s in spans]), breaks[-1])
    points = curve(t)
    open_ones = np.arange(len(t) - 1)
    for _ in range(20):
        # A chord is halved until the middle of its piece is near.
        middles_t = (t[open_ones] + t[open_ones + 1]) / 2
        middles = curve(middles_t)
        chords = (points[open_ones] + points[open_ones + 1]) / 2
        far = np.linalg.norm(middles - chords, axis=1) > FLATNESS_M
        if not far.any():
            break
        at = open_ones[far] + 1
        t = np.insert(t, at, middles_t[far])
        points = np.insert(points, at, middles[far], axis=0)
        moved = at + np.arange(len(at))
        open_ones = np.column_stack([moved - 1, moved]).ravel()
    return points


def bezier(control):
    """Points of a Bezier curve of any degree, by its Bernstein form."""
    n = len(control) - 1

    def curve(t):
        basis = [comb(n, i) * t**i * (1 - t) ** (n - i) for i in range(n + 1)]
        return sum(b[:, None] * p for b, p in zip(basis, control))

    return flatten(curve, [0, 1])
