"""Tiles of a layout by Ray workers: python ray_tiles.py LAYOUT FIRST_ZOOM LAST_ZOOM WORKERS"""

import os
import sys
import time

import guideway
import pyarrow
import pyarrow.compute as compute
import ray

BATCH = 256  # addresses: some blocks of 8 x 8 tiles, which are drawn at once


class Draw:
    """Draws batches of addresses. Each worker reads and prepares the layout once."""

    def __init__(self, path: str, content: str) -> None:
        self.tiler = guideway.Tiler(guideway.open(path), content=content)

    def __call__(self, batch: pyarrow.Table) -> pyarrow.Table:
        drawn = self.tiler.draw(batch["z"], batch["x"], batch["y"])
        return batch.append_column("tile", pyarrow.array(drawn, pyarrow.binary()))


def timed(work):
    """The result of a call, and its seconds."""
    start = time.perf_counter()
    return work(), time.perf_counter() - start


def main(path: str, first: int, last: int, workers: int) -> None:
    os.environ.setdefault("RAYON_NUM_THREADS", "1")  # one core per worker
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # no report to its makers
    ray.init(num_cpus=workers, include_dashboard=False, log_to_driver=False)
    addresses = pyarrow.table(guideway.Tiler(guideway.open(path)).addresses(first, last))
    for content in ["raster", "vector"]:
        parts = [addresses.slice(row, BATCH) for row in range(0, len(addresses), BATCH)]
        data = ray.data.from_arrow(parts).map_batches(
            Draw, fn_constructor_args=(path, content), batch_size=BATCH, batch_format="pyarrow",
            compute=ray.data.ActorPoolStrategy(size=workers),
        )
        parts, took_s = timed(lambda: ray.get(data.to_arrow_refs()))
        tiles = pyarrow.concat_tables(parts)
        alone, alone_s = timed(lambda: Draw(path, content)(addresses))
        order = [("z", "ascending"), ("x", "ascending"), ("y", "ascending")]
        assert tiles.sort_by(order).equals(alone.sort_by(order)), "workers draw other tiles"
        size = compute.sum(compute.binary_length(tiles["tile"])).as_py()
        print(
            f"{content}: {len(tiles)} tiles of {size // len(tiles)} bytes on average, "
            f"{took_s:.1f} s with {workers} workers, {alone_s:.1f} s in one process"
        )


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:5]))
