"""Makes the damaged and odd Arrow files of this folder, with pyarrow.

    python3 tests/bad/arrow/make.py target/arrow
    cargo run -p guideway-bad-files -- pack arrow target/arrow

What is expected of each is in expect.tsv. Most begin as a sound table of 13 rows, of which single numbers
are then changed: 13 rows make lengths that are easy to find.
"""

import io
import pathlib
import struct
import sys

import pyarrow as pa

FOLDER = pathlib.Path(sys.argv[1])
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


NETWORK_FIELDS = [
    ("id", pa.string()),
    ("control_points", POLYGON),
    ("guideway.element", pa.string()),
    ("guideway.part", pa.uint32()),
    ("start_node", pa.uint32()),
    ("end_node", pa.uint32()),
    ("direction", pa.string()),
    ("vehicle_types", pa.list_(pa.dictionary(pa.int32(), pa.string()))),
    ("level", pa.string()),
    ("x_m", pa.float64()),
    ("y_m", pa.float64()),
    ("nodes", pa.list_(pa.uint32())),
    ("of", pa.uint32()),
    ("level_name", pa.string()),
    ("elevation_m", pa.float64()),
    ("members", pa.list_(pa.struct([("element", pa.string()), ("index", pa.uint32())]))),
    ("outline_m", pa.list_(pa.list_(pa.float64(), 2))),
    (
        "curve",
        pa.struct(
            [
                ("degree", pa.uint32()),
                ("knots", pa.list_(pa.float64())),
                ("weights", pa.list_(pa.float64())),
                ("points", pa.list_(pa.list_(pa.float64(), 2))),
            ]
        ),
    ),
    ("refusal_code", pa.string()),
    ("refusal_detail", pa.string()),
    ("maxSpeed", pa.field("maxSpeed", pa.float64(), metadata={"unit": "m/s"})),
    ("attribute.level", pa.string()),
]
VERSION_2 = {"guideway.version": "2"}


def rows(kind, *elements):
    return [{"guideway.element": kind, **element} for element in elements]


def network(*parts, types=None, metadata=VERSION_2):
    """A table of rows of all kinds; `types` replaces the types of columns."""
    data = [row for part in parts for row in part]
    fields = [f if isinstance(f, pa.Field) else pa.field(name, f) for name, f in NETWORK_FIELDS]
    fields = [pa.field(f.name, (types or {}).get(f.name, f.type), metadata=f.metadata) for f in fields]
    columns = []
    for field in fields:
        values = [row.get(field.name) for row in data]
        kinds = field.type == pa.list_(pa.dictionary(pa.int32(), pa.string()))
        columns.append(dictionary_lists(values) if kinds else pa.array(values, field.type))
    return pa.Table.from_arrays(columns, schema=pa.schema(fields, metadata=metadata))


def dictionary_lists(values):
    """pyarrow makes no dictionaries in lists from Python values."""
    items = [text for value in values for text in value or []]
    texts = sorted(set(items) - {None})
    keys = [None if text is None else texts.index(text) for text in items]
    items = pa.DictionaryArray.from_arrays(pa.array(keys, pa.int32()), pa.array(texts, pa.string()))
    offsets, end = [], 0
    for value in values:
        offsets.append(None if value is None else end)
        end += len(value or [])
    return pa.ListArray.from_arrays(pa.array([*offsets, end], pa.int32()), items)


def path(y, **columns):
    return {"id": f"path-{y}", "control_points": line(y), **columns}


NODES = rows("node", *({"id": f"N{x}", "x_m": float(x), "y_m": 0.0} for x in range(3)))
PATHS = rows(
    "path",
    path(0, start_node=0, end_node=1, direction="both", vehicle_types=["tug", "fork"], level="L"),
    path(1, start_node=1, end_node=2, **{"attribute.level": "own"}),
    path(2, curve={"degree": 1, "knots": [], "weights": None, "points": [[0.0, 2.0], [3.0, 2.0]]}),
    {"id": "path-3", "control_points": []},
)
OTHERS = (
    rows("path for type", {"id": "tug", "of": 0, "maxSpeed": 0.5}, {"id": "fork", "of": 0, "maxSpeed": 1.5})
    + rows("station", {"id": "S", "nodes": [2], "x_m": 2.0, "y_m": 1.0}, {"id": "T", "nodes": []})
    + rows("level", {"id": "L", "level_name": "Ground", "elevation_m": 0.0})
    + rows("vehicle type", {"id": "tug", "maxSpeed": 2.0})
    + rows("block", {"id": "B", "members": [{"element": "path", "index": 2}, {"element": "node", "index": 0}]})
    + rows("zone", {"id": "Z", "outline_m": [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], "level": "L"})
    + rows("layout", {"id": "", "maxSpeed": 3.0})
    + rows("refused path", {"id": "R", "refusal_code": "non-finite", "refusal_detail": "NaN"})
)


def references():
    """Every reference of a table, to elements that it does not have."""
    far = (1 << 32) - 1
    paths = rows(
        "path",
        path(0, start_node=3, end_node=far, direction="sideways", vehicle_types=[None, "tug"]),
        path(1, curve={"degree": 0, "knots": [], "weights": None, "points": [[0.0, 0.0]]}),
        path(2, curve={"degree": 1, "knots": [], "weights": [1.0], "points": [[0.0, 0.0], [1.0, 0.0]]}),
        path(3, curve={"degree": 1, "knots": [float("nan")], "weights": None, "points": []}),
    )
    types = rows("path for type", {"id": "tug", "of": far}, {"id": "crane", "of": 0}, {"id": "tug"})
    types += rows("node for type", {"id": "tug", "of": 1})
    stations = rows("station", {"id": "S", "nodes": [0, 3, None, far]})
    members = [{"element": "path", "index": 4}, {"element": "level", "index": 0}, None]
    blocks = rows("block", {"id": "B", "members": members})
    others = rows("refused path", {"id": "R", "refusal_code": "tired"}, {"id": "Q"})
    others += rows("layout", {"id": ""}, {"id": "again"}) + rows("robot", {"id": "X"}, {"id": "Y"})
    return [paths, NODES, types, stations, blocks, others]


def positions():
    """Positions that are none, of nodes to which a path refers."""
    nan = float("nan")
    bad = [(None, 0.0), (nan, 0.0), (0.0, 3e9), (1.0, 2.0)]
    nodes = rows("node", *({"id": f"N{n}", "x_m": x, "y_m": y} for n, (x, y) in enumerate(bad)))
    stations = rows("station", *({"id": "S", "x_m": x, "y_m": y, "nodes": [3]} for x, y in bad))
    zones = rows("zone", {"id": "Z", "outline_m": [[0.0, 0.0], [nan, 1.0]]}, {"id": "Y", "outline_m": None})
    return [rows("path", path(0, start_node=3, end_node=1)), nodes, stations, zones]


def interleaved():
    """Kinds that change with every row, and a path of two rows."""
    paths = [*PATHS, *rows("path", {"id": "p", "control_points": line(7), "guideway.part": 0})]
    mixed = [row for pair in zip(paths, [*NODES, *OTHERS]) for row in pair]
    rest = [*NODES, *OTHERS][len(paths) :]
    parts = [{"id": "p", "control_points": line(8), "guideway.part": part} for part in (0, 1)]
    bad = rows("path", {"id": "bad", "control_points": None}, *parts)
    odd = rows("node", {"id": "N9", "x_m": 1.0, "y_m": 1.0, "control_points": line(9)})
    return [mixed, bad, odd, rest]


def many(count):
    """Rows of nulls, which compress to next to nothing."""
    nulls = {"control_points": pa.nulls(count, POLYGON), "x_m": pa.nulls(count, pa.float64())}
    kinds = pa.DictionaryArray.from_arrays(pa.array([0] * count, pa.int8()), pa.array(["station"]))
    data = {"id": pa.array([""] * count), **nulls, "guideway.element": kinds}
    return pa.table(data).replace_schema_metadata(VERSION_2)


def kinds_out_of_range():
    keys = pa.array([7] * ROWS, pa.int8())
    column = pa.DictionaryArray.from_arrays(keys, pa.array(["path"]), safe=False)
    return file(table({"guideway.element": column}, VERSION_2))


# As a dictionary they compress to next to nothing.
SAME_IDS = pa.array(["x"] * 60_000).dictionary_encode()

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
    "version-2.arrow": file(table(metadata=VERSION_2)),
    "version-3.arrow": file(table(metadata={"guideway.version": "3"})),
    "version-words.arrow": file(table(metadata={"guideway.version": "latest"})),
    "no-version.arrow": file(table(metadata=None)),
    "refused-rows.arrow": file(table(polygons=sloppy())),
    "views-of-the-same-points.arrow": file(
        table({"id": SAME_IDS}, polygons=views(60_000, 1_200)), "zstd"
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
    "network.arrow": file(network(PATHS, NODES, OTHERS)),
    "network-without-version.arrow": file(network(PATHS, NODES, OTHERS, metadata=None)),
    "network-as-version-1.arrow": file(network(PATHS, NODES, OTHERS, metadata=VERSION)),
    "network-interleaved.arrow": file(network(*interleaved())),
    "network-references.arrow": file(network(*references())),
    "network-positions.arrow": file(network(*positions())),
    "network-levels.arrow": file(
        network(
            rows("path", path(0, level=1), path(1, level=7), path(2, level=-1)),
            rows("level", {"id": "L"}, {"id": "L"}),
            types={"level": pa.int64()},
        )
    ),
    "network-wrong-types.arrow": file(
        network(
            rows("path", *(path(y) for y in range(3))),
            rows("node", {"id": "N"}),
            types={
                name: pa.string()
                for name, _ in NETWORK_FIELDS
                if name in ("start_node", "end_node", "vehicle_types", "x_m", "y_m", "nodes", "of")
                or name in ("elevation_m", "members", "outline_m", "curve")
            }
            | {name: pa.int32() for name in ("direction", "level_name", "refusal_code")},
        )
    ),
    "network-origin.arrow": file(
        network(PATHS, metadata=VERSION_2 | {"guideway.longitude_deg": "east"})
    ),
    "network-one-attribute-twice.arrow": file(
        table({"lanes": pa.array([1] * ROWS), "attribute.lanes": pa.array([2] * ROWS)}, VERSION_2)
    ),
    "network-units.arrow": file(
        pa.table(
            table({"speed": pa.array([1.0] * ROWS), "word": pa.array(["x"] * ROWS)}).columns,
            schema=pa.schema(
                [
                    pa.field("id", pa.string()),
                    pa.field("control_points", POLYGON),
                    pa.field("speed", pa.float64(), metadata={"unit": "mm/s"}),
                    pa.field("word", pa.string(), metadata={"unit": "m"}),
                ],
                metadata=VERSION_2,
            ),
        )
    ),
    "network-millions-of-nulls.arrow": file(many(6_000_000), "zstd"),
    "network-kinds-beyond.arrow": kinds_out_of_range(),
}

FOLDER.mkdir(parents=True, exist_ok=True)
for name, data in FILES.items():
    (FOLDER / name).write_bytes(bytes(data))
    print(f"{len(data):8} {name}")
