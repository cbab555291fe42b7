"""Strokes curves with Skia, by the Python package skia-python.

Arguments: width and height of the picture, stroke width, number of frames, input file of the
curves, output file of the pixels (rows of RGBA bytes). The input consists of 32-bit words: per path
the number n of Bezier curves, then 1 + 3 n points as pairs of floats. Prints the milliseconds of
each frame as a JSON list; they exclude the construction of the paths.
"""

import json
import sys
import time

import skia

WIDTH, HEIGHT, FRAMES = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[4])
STROKE_PX = float(sys.argv[3])
CURVES, PIXELS = sys.argv[5:]


def paths():
    with open(CURVES, "rb") as file:
        words = file.read()
    counts, numbers = memoryview(words).cast("I"), memoryview(words).cast("f")
    at = 0
    while at < len(counts):
        end = at + 3 + 6 * counts[at]
        yield numbers[at + 1 : end].tolist()
        at = end


def build_paths():
    """All paths as Skia objects."""
    built = []
    for points in paths():
        path = skia.Path()
        path.moveTo(*points[:2])
        for i in range(2, len(points), 6):
            path.cubicTo(*points[i : i + 6])
        built.append(path)
    return built


SURFACE = skia.Surface.MakeRaster(
    skia.ImageInfo.Make(WIDTH, HEIGHT, skia.kRGBA_8888_ColorType, skia.kPremul_AlphaType)
)
PAINT = skia.Paint(
    AntiAlias=True,
    Style=skia.Paint.kStroke_Style,
    StrokeWidth=STROKE_PX,
    StrokeCap=skia.Paint.kRound_Cap,
    StrokeJoin=skia.Paint.kRound_Join,
    Color=skia.ColorBLACK,
)
STROKES = build_paths()


def draw():
    with SURFACE as canvas:
        canvas.clear(skia.ColorWHITE)
        for path in STROKES:
            canvas.drawPath(path, PAINT)


TIMES_MS = []
for _ in range(FRAMES):
    start = time.perf_counter()
    draw()
    TIMES_MS.append(1000 * (time.perf_counter() - start))
with open(PIXELS, "wb") as file:
    file.write(SURFACE.makeImageSnapshot().tobytes())
print(json.dumps(TIMES_MS))
