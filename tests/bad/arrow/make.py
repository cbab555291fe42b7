"""Makes the damaged and odd Arrow files of this folder, with pyarrow.

    python3 tests/bad/arrow/make.py

What is expected of each is in expect.tsv. Most begin as a sound table of 13 rows, of which single numbers
are then changed: 13 rows make lengths that are easy to find.
"""

import io
import pathlib
import struct

import pyarrow as pa

HERE = pathlib.Path(__file__).parent
ROWS = 13
POINT = pa.list_(pa.float32(), 2)
POLYGON = pa.list_(POINT)
VERSION = {"guideway.version": "1"}


def line(y, points=4):
    return [[float(x), float(y)] for x in range(points)]


def table(columns=None, metadata=VERSION, polygons=None):
    if polygons is None:
        polygons = pa.array([line(y) for y in range(ROWS)], POLYGON)
    data = {"id": [f"path-{y}" for y in range(len(polygons))], "control_points": polygons}
    data.update(columns or {})
    return pa.table(data).replace_schema_metadata(metadata)


def file(t, compression=None, batches=1):
    out = io.BytesIO()
    options = pa.ipc.IpcWriteOptions(compression=compression)
    with pa.ipc.new_file(out, t.schema, options=options) as writer:
        for _ in range(batches):
            writer.write_table(t)
    return bytearray(out.getvalue())


def stream(t):
    out = io.BytesIO()
    with pa.ipc.new_stream(out, t.schema) as writer:
        writer.write_table(t)
    return bytearray(out.getvalue())


def messages(data, at=8):
    """Start, header length with its prefix and body length of each message."""
    reader = pa.BufferReader(bytes(data))
    reader.seek(at)
    found = []
    while True:
        start = reader.tell()
        try:
            message = pa.ipc.read_message(reader)
        except (EOFError, pa.ArrowInvalid):
            return found
        header = 8 + struct.unpack_from("<i", data, start + 4)[0]
        found.append((start, header, message.body.size if message.body else 0))


def batch(data, at=8, index=1):
    return messages(data, at)[index]


def put(data, at, fmt, *values):
    struct.pack_into("<" + fmt, data, at, *values)
    return data


def block_at(data, index=1):
    """Where the footer keeps the block of a message: offset, header length, padding, body length."""
    pattern = struct.pack("<qi4xq", *batch(data, index=index))
    return data.rindex(pattern)


def with_block(fmt, offset, *values, batches=1, index=1):
    data = file(table(), batches=batches)
    return put(data, block_at(data, index) + offset, fmt, *values)


def numbers_at(data, length, index=0, message=1):
    """Where the header of a message keeps the offset and length of a buffer of `length` bytes."""
    start, header, _ = batch(data, index=message)
    # Offset and length take turns; the first buffers are those of `id`: no nulls, then its offsets.
    first = data.index(struct.pack("<4q", 0, 0, 0, OFFSETS), start, start + header)
    found = [
        at
        for at in range(first, start + header - 8, 16)
        if struct.unpack_from("<q", data, at + 8)[0] == length
    ]
    return found[index]


def buffer_of(data, length, index=0, message=1):
    """Where in the file a buffer of `length` bytes begins."""
    start, header, _ = batch(data, index=message)
    return start + header + struct.unpack_from("<q", data, numbers_at(data, length, index, message))[0]


OFFSETS = 4 * (ROWS + 1)
IDS, LISTS = 0, 1  # Both columns have offsets of this length, in this order.


def with_number(fmt, shift, value):
    data = file(table())
    return put(data, numbers_at(data, OFFSETS, LISTS) + shift, fmt, value)


def with_node(shift, value):
    data = file(table())
    start, header, _ = batch(data)
    node = data.index(struct.pack("<qq", ROWS, 0), start, start + header)
    return put(data, node + shift, "q", value)


def with_offset(column, index, value):
    data = file(table())
    return put(data, buffer_of(data, OFFSETS, column) + 4 * index, "i", value)


def compressed(codec, fmt, value):
    data = file(table(), compression=codec)
    start, header, body = batch(data)
    # The largest buffer declared: the coordinates, whose uncompressed length comes first.
    length = struct.pack("<q", ROWS * 4 * 2 * 4)
    at = data.index(length, start + header, start + header + body)
    return put(data, at, fmt, value)


def garbled(codec):
    data = compressed(codec, "q", ROWS * 4 * 2 * 4)
    start, header, body = batch(data)
    at = data.index(struct.pack("<q", ROWS * 4 * 2 * 4), start + header)
    data[at + 8 : at + 16] = b"\xAA" * 8
    return data


def footer(data, fill):
    length = struct.unpack_from("<i", data, len(data) - 10)[0]
    data[len(data) - 10 - length : len(data) - 10] = bytes([fill]) * length
    return data


def views(count, points):
    """Many rows that are views of the same points."""
    values = pa.array(line(0, points), POINT)
    offsets = pa.array([0] * count, pa.int32())
    sizes = pa.array([points] * count, pa.int32())
    return pa.ListViewArray.from_arrays(offsets, sizes, values)


def laughs(depth, width):
    """Lists of views of lists of views, each of all that is below it."""
    values = pa.array(["ha"] * width)
    for _ in range(depth):
        offsets = pa.array([0] * width, pa.int32())
        sizes = pa.array([width] * width, pa.int32())
        values = pa.ListViewArray.from_arrays(offsets, sizes, values)
    return values[:ROWS]


def dictionary_out_of_range():
    keys = pa.array([7] * ROWS, pa.int8())
    column = pa.DictionaryArray.from_arrays(keys, pa.array(["x"]), safe=False)
    return file(table({"kind": column}))


def shared_blocks():
    data = file(table(), batches=2)
    first = struct.pack("<qi4xq", *batch(data, index=1))
    at = block_at(data, 2)
    data[at : at + 24] = first
    return data


def sloppy():
    nan, inf = float("nan"), float("inf")
    polygons = [line(0), None, line(2, 3), line(3), line(4), line(5), line(6), line(7), []]
    polygons[3][1][0] = nan
    polygons[4][2][1] = -inf
    polygons[5][3][1] = 3e9
    polygons[6][0] = None
    polygons[7][2] = [1.0, None]
    return pa.array(polygons, POLYGON)


sound = file(table())
FILES = {
    "magic-only.arrow": b"ARROW1\0\0",
    "no-footer.arrow": sound[: sum(batch(sound))],
    "no-closing-magic.arrow": sound[:-1],
    "footer-length-negative.arrow": put(file(table()), len(sound) - 10, "i", -5),
    "footer-length-huge.arrow": put(file(table()), len(sound) - 10, "i", 0x7FFFFFFF),
    "footer-zeros.arrow": footer(file(table()), 0),
    "footer-ones.arrow": footer(file(table()), 0xFF),
    "block-offset-negative.arrow": with_block("q", 0, -64),
    "block-offset-beyond.arrow": with_block("q", 0, 1 << 40),
    "block-header-negative.arrow": with_block("i", 8, -8),
    "block-body-huge.arrow": with_block("q", 16, 1 << 62),
    "block-body-negative.arrow": with_block("q", 16, -8),
    "blocks-shared.arrow": shared_blocks(),
    "buffer-offset-beyond.arrow": with_number("q", 0, 1 << 40),
    "buffer-offset-negative.arrow": with_number("q", 0, -8),
    "buffer-length-huge.arrow": with_number("q", 8, 1 << 62),
    "buffer-length-negative.arrow": with_number("q", 8, -1),
    "buffer-length-short.arrow": with_number("q", 8, 8),
    "rows-negative.arrow": with_node(0, -1),
    "rows-huge.arrow": with_node(0, 1 << 61),
    "nulls-more-than-rows.arrow": with_node(8, ROWS + 1),
    "list-offset-beyond.arrow": with_offset(LISTS, ROWS, 1 << 30),
    "list-offset-negative.arrow": with_offset(LISTS, 0, -4),
    "list-offsets-fall.arrow": with_offset(LISTS, 5, 2),
    "text-offset-beyond.arrow": with_offset(IDS, ROWS, 1 << 30),
    "text-not-utf8.arrow": bytes(file(table())).replace(b"path-4", b"path\xFF4"),
    "lz4-declares-exabytes.arrow": compressed("lz4", "q", 1 << 60),
    "lz4-declares-less-than-nothing.arrow": compressed("lz4", "q", -7),
    "lz4-declares-too-little.arrow": compressed("lz4", "q", 8),
    "lz4-garbled.arrow": garbled("lz4"),
    "zstd-declares-exabytes.arrow": compressed("zstd", "q", 1 << 60),
    "zstd-garbled.arrow": garbled("zstd"),
    "stream-ends-early.arrow": stream(table())[:-40],
    "stream-without-schema.arrow": stream(table())[batch(stream(table()), 0)[0] :],
    "stream-header-huge.arrow": put(stream(table()), 4, "i", 0x7FFFFFF0),
    "stream-header-negative.arrow": put(stream(table()), 4, "i", -8),
    "dictionary-key-beyond.arrow": dictionary_out_of_range(),
    "no-control-points.arrow": file(table().drop_columns(["control_points"])),
    "control-points-text.arrow": file(table(polygons=pa.array(["M0 0"] * ROWS))),
    "control-points-3d.arrow": file(
        table(polygons=pa.array([[[0.0, 0.0, 0.0]] * 4] * ROWS, pa.list_(pa.list_(pa.float32(), 3))))
    ),
    "control-points-half.arrow": file(
        table(polygons=pa.array([[[0.0, 0.0]] * 4] * ROWS, pa.list_(pa.list_(pa.float16(), 2))))
    ),
    "two-ids.arrow": file(
        pa.Table.from_arrays([*table().columns, table()["id"]], names=["id", "control_points", "id"])
    ),
    "version-2.arrow": file(table(metadata={"guideway.version": "2"})),
    "version-words.arrow": file(table(metadata={"guideway.version": "latest"})),
    "no-version.arrow": file(table(metadata=None)),
    "refused-rows.arrow": file(table(polygons=sloppy())),
    "views-of-the-same-points.arrow": file(
        table({"id": ["x"] * 60_000}, polygons=views(60_000, 1_200)), "zstd"
    ),
    "laughs.arrow": file(table({"joke": laughs(6, 40)})),
    "long-texts.arrow": file(table({"note": ["x" * (1 << 21)] * ROWS}), "zstd"),
    "parts-without-a-path.arrow": file(
        table({"guideway.part": pa.array([1] + [0] * 5 + [1] * 7, pa.uint32())})
    ),
    "styles-out-of-range.arrow": file(
        table(
            {
                "width_m": pa.array([-1.0, float("inf")] + [0.5] * 11, pa.float32()),
                "color": pa.array([-1] + [0xFF0000FF] * 12, pa.int64()),
                "rank": pa.array([1 << 40] + [3] * 12, pa.int64()),
                "level": pa.array([1] * ROWS, pa.int64()),
            }
        )
    ),
    "nothing-but-refused.arrow": file(table(polygons=pa.array([None] * ROWS, POLYGON))),
    "no-rows.arrow": file(table(polygons=pa.array([], POLYGON))),
    "null-ids.arrow": file(table({"id": pa.array([None] * ROWS, pa.string())})),
}

for name, data in FILES.items():
    (HERE / name).write_bytes(bytes(data))
    print(f"{len(data):8} {name}")
