"""Compares what Guideway reads and writes with other implementations, and prints a table.

python tests/conformance GUIDEWAY SHARED [--quick] [FORMAT...]

Exits with 1 if a deviation exceeds its tolerance, if an element is missing, or if a written file
breaks its schema. `--quick` takes a few small files per format.
"""

import argparse
import os
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import comparison
import dxf
import geojson
import guideway
import lanelets
import nurbs
import opendrive
import opentcs
import pictures
import rmf
import schemas
import selftest
import svg
from folders import Folders

READERS = (dxf, svg, pictures, nurbs, opentcs, opendrive, lanelets, rmf, geojson)
QUICK_FILES = 5
QUICK_BYTES = 40_000
# Larger files would take minutes to write to every target, and have no other elements.
SCHEMA_BYTES = 300_000


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("guideway", type=Path)
    parser.add_argument("shared", type=Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("formats", nargs="*")
    arguments = parser.parse_args()
    command = guideway.Command(arguments.guideway)
    folders = Folders(arguments.shared)
    selftest.run(command)
    print("self test: every comparator finds a changed file")
    for name in folders.missing():
        print(f"SKIPPED: there is no folder {name} below {arguments.shared}")
    failures = []
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        row("format", "second implementation", "files", "elements", "deviation", "tolerance")
        for reader in READERS:
            if not arguments.formats or reader.FORMAT in arguments.formats:
                files = chosen(reader.files(folders), arguments.quick)
                failures += report(
                    reader, files, pool.map(partial(one, command, reader.__name__), files)
                )
        if not arguments.formats and (arguments.shared / "conformance/schemas").is_dir():
            failures += written(pool, command, folders, arguments.quick)
    for failure in failures:
        print("FAILED:", failure)
    return 1 if failures else 0


def chosen(files, quick):
    """All files; or a few small ones, spread over all."""
    if not quick:
        return files
    small = [file for file in files if file.stat().st_size <= QUICK_BYTES]
    small = small or sorted(files, key=lambda file: file.stat().st_size)[:1]
    return small[:: max(1, len(small) // QUICK_FILES)][:QUICK_FILES]


def one(command, name, file):
    """The comparison of a file, or the reason why there is none."""
    reader = sys.modules[name]
    try:
        answer = command.read(file)
    except guideway.Refused as refused:
        return "Guideway: " + str(refused).removeprefix(f"error: {file}: ")
    try:
        if hasattr(reader, "compare"):
            return reader.compare(answer, file)
        return comparison.compare(answer, reader.read(file))
    except Exception as error:  # Another reader may fail in any way; it is no fault of Guideway.
        return f"{reader.READER}: {type(error).__name__}: {error}"


def report(reader, files, results):
    """Prints the row of a reader; returns its failures."""
    failures, skipped, largest = [], Counter(), comparison.Result()
    compared = 0
    for file, result in zip(files, results):
        if isinstance(result, str):
            skipped[f"{file.name}: {result[:100]}"] += 1
            continue
        skipped.update(result.skipped)
        compared += result.elements > 0
        largest.elements += result.elements
        largest.deviation = max(largest.deviation, result.deviation)
        if not result.deviation <= reader.TOLERANCE:
            failures.append(f"{file}: {result.deviation:.2g} at {result.at}")
        failures += [f"{file}: {fault}" for fault in result.faults]
    if files and not compared:
        failures.append(f"{reader.FORMAT}: no file was compared with {reader.READER}")
    unit = getattr(reader, "UNIT", "m")
    deviation, tolerance = (f"{v:.1e} {unit}" for v in (largest.deviation, reader.TOLERANCE))
    count = f"{compared} of {len(files)}"
    row(reader.FORMAT, reader.READER, count, largest.elements, deviation, tolerance)
    for reason, number in sorted(skipped.items()):
        print(f"    not compared: {reason} ({number})")
    return failures


def written(pool, command, folders, quick):
    """Checks what is written from every source against the schemas; returns the failures."""
    files = [f for f in folders.find("*") if f.suffix != ".md" and f.stat().st_size <= SCHEMA_BYTES]
    files = chosen(files, quick)
    checked, failures = Counter(), []
    check = partial(check_one, command, folders.top / "conformance/schemas")
    for file, results in zip(files, pool.map(check, files)):
        for target, errors in results:
            checked[target] += errors is not None
            failures += [f"{file} to {target}: {error}" for error in errors or ()]
    for target, _, schema in schemas.TARGETS:
        row("written " + target, schema or "audit of ezdxf", checked[target], "", "", "")
    return failures


def check_one(command, folder, file):
    """The errors of a file as written to every target."""
    return list(schemas.check(command, file, schemas.checkers(folder)))


def row(*cells):
    widths = (17, 31, 11, 9, 11, 10)
    print(
        "  ".join(str(cell).ljust(width) for cell, width in zip(cells, widths)).rstrip(), flush=True
    )


if __name__ == "__main__":
    sys.exit(main())
