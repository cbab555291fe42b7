"""Runs the command and takes its answer: the paths of a file, out of an Arrow table."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pyarrow.feather

import lines


class Refused(Exception):
    """The command does not read a file; the message is its first line."""


class Answer:
    """The paths that the command makes of a file."""

    def __init__(self, table):
        columns = set(table.column_names)
        rows = table.num_rows
        kinds = table["guideway.element"].to_pylist() if "guideway.element" in columns else []
        kinds = [kind or "path" for kind in kinds] or ["path"] * rows
        ids = table["id"].to_pylist() if "id" in columns else [str(i) for i in range(rows)]
        self.refused = {i for i, kind in zip(ids, kinds) if kind == "refused path"}
        is_path = [i for i, kind in enumerate(kinds) if kind == "path"]
        self.ids = [ids[i] for i in is_path]
        self._table = table
        parts = table["guideway.part"].to_pylist() if "guideway.part" in columns else [0] * rows
        self._parts = [parts[i] for i in is_path]
        self._is_path = is_path
        self._lines, self._owners = _flatten(table["control_points"].combine_chunks(), is_path)

    def column(self, name):
        """The values of a column, one per row of a path; `None` where there is no such column.

        A path of several runs has its values in the first of its rows.
        """
        if name not in self._table.column_names:
            return [None] * len(self.ids)
        values = self._table[name].to_pylist()
        return [values[self._is_path[row]] for row in self.firsts()]

    def firsts(self):
        """The first row of the path of each row: a path of several runs has several rows."""
        found = []
        for row, part in enumerate(self._parts):
            found.append(found[-1] if part else row)
        return found

    def lines_by(self, keys):
        """The lines of all paths with the same key; rows with the key `None` are left out."""
        groups = {}
        order = np.argsort(self._owners, kind="stable")
        cuts = np.searchsorted(self._owners[order], np.arange(len(keys) + 1))
        for row, key in enumerate(keys):
            if key is not None:
                groups.setdefault(key, []).append(self._lines[order[cuts[row] : cuts[row + 1]]])
        return {key: np.concatenate(parts) for key, parts in groups.items()}


def _flatten(column, rows):
    offsets = column.offsets.to_numpy()
    points = column.values.flatten().to_numpy(zero_copy_only=False).astype(float).reshape(-1, 2)
    starts, owners = [], []
    for owner, row in enumerate(rows):
        first, last = offsets[row], offsets[row + 1]
        starts.append(np.arange(first, max(first, last - 3)))
        owners.append(np.full(len(starts[-1]), owner))
    if not starts:
        return np.zeros((0, 2, 2)), np.zeros(0, int)
    starts, owners = np.concatenate(starts), np.concatenate(owners)
    segments = points[starts[:, None] + np.arange(4)] if len(starts) else np.zeros((0, 4, 2))
    flat, of = lines.flatten_runs(segments)
    return flat, owners[of] if len(of) else np.zeros(0, int)


class Command:
    """The built command."""

    def __init__(self, program):
        self.program = str(program)

    def run(self, *arguments):
        """Runs the command; returns the finished process."""
        return subprocess.run(
            [self.program, *map(str, arguments)], capture_output=True, text=True, timeout=300
        )

    def convert(self, source, target, *arguments):
        """Writes a file in another format, or raises `Refused`."""
        done = self.run("convert", "-q", source, target, *arguments)
        if done.returncode not in (0, 2) or not Path(target).exists():
            raise Refused((done.stderr.strip() or "no output").splitlines()[0])

    def read(self, source):
        """Guideway's answer for a file, or raises `Refused`."""
        with tempfile.TemporaryDirectory() as folder:
            target = Path(folder) / "answer.arrow"
            self.convert(source, target)
            return Answer(pyarrow.feather.read_table(target, memory_map=False))
