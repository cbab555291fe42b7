"""Findings of many layout files by Dask: python dask_check.py WORKERS FILE..."""

import sys
import time

import dask.dataframe
import guideway
import pandas
import pyarrow


def check(files: pandas.DataFrame) -> pandas.DataFrame:
    """A row per finding; a file that cannot be read is a finding too."""
    return pyarrow.table(guideway.check_many(files["path"])).to_pandas()


def main(workers: int, paths: list[str]) -> None:
    files = pandas.DataFrame({"path": paths})
    start = time.perf_counter()
    parts = dask.dataframe.from_pandas(files, npartitions=4 * workers)
    found = parts.map_partitions(check, meta=check(files[:0]))
    found = found.compute(scheduler="processes", num_workers=workers).reset_index(drop=True)
    took_s = time.perf_counter() - start
    start = time.perf_counter()
    alone = check(files)
    alone_s = time.perf_counter() - start
    assert len(alone) > 0 and found.equals(alone), "workers find other faults"
    print(f"{len(found)} findings in {len(paths)} files, {took_s:.1f} s with {workers} workers, "
          f"{alone_s:.1f} s in one process")
    print(found.groupby(["severity", "code"]).size().to_string())


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
