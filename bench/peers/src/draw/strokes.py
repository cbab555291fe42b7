"""Strokes curves with a renderer that has a Python package: skia-python, or blend2d-python.

Arguments: the renderer, the width and the height of the picture, the stroke's width, the number of frames, the file of the
curves, and that for the pixels (rows of RGBA bytes). The curves are 32-bit words: for each path its number of Bezier curves,
then its points as pairs of floats, one and three a curve. Prints the milliseconds of each frame as a JSON list; paths are made
before.
"""

import json
import sys
import time

NAME, CURVES, PIXELS = sys.argv[1], sys.argv[6], sys.argv[7]
WIDTH, HEIGHT, FRAMES = int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[5])
STROKE_PX = float(sys.argv[4])


def paths():
    with open(CURVES, "rb") as file:
        words = file.read()
    counts, numbers = memoryview(words).cast("I"), memoryview(words).cast("f")
    at = 0
    while at < len(counts):
        end = at + 3 + 6 * counts[at]
        yield numbers[at + 1 : end].tolist()
        at = end


def made(new, move_to, cubic_to):
    """All paths, as a renderer has them: made, begun and continued by its functions."""
    all_made = []
    for points in paths():
        path = new()
        move_to(path, *points[:2])
        for i in range(2, len(points), 6):
            cubic_to(path, *points[i : i + 6])
        all_made.append(path)
    return all_made


def skia_frame():
    import skia

    surface = skia.Surface.MakeRaster(
        skia.ImageInfo.Make(WIDTH, HEIGHT, skia.kRGBA_8888_ColorType, skia.kPremul_AlphaType)
    )
    paint = skia.Paint(
        AntiAlias=True,
        Style=skia.Paint.kStroke_Style,
        StrokeWidth=STROKE_PX,
        StrokeCap=skia.Paint.kRound_Cap,
        StrokeJoin=skia.Paint.kRound_Join,
        Color=skia.ColorBLACK,
    )
    strokes = made(skia.Path, skia.Path.moveTo, skia.Path.cubicTo)

    def frame():
        with surface as canvas:
            canvas.clear(skia.ColorWHITE)
            for path in strokes:
                canvas.drawPath(path, paint)

    return frame, lambda: surface.makeImageSnapshot().tobytes()


def blend2d_frame():
    import blend2d

    image = blend2d.BLImage(WIDTH, HEIGHT, blend2d.BLFormat.PRGB32)
    strokes = made(blend2d.BLPath, blend2d.BLPath.move_to, blend2d.BLPath.cubic_to)

    def frame():
        context = blend2d.BLContext(image)
        context.set_fill_style((1.0, 1.0, 1.0))
        context.fill_all()
        context.set_stroke_style((0.0, 0.0, 0.0))
        context.stroke_width = STROKE_PX
        context.set_stroke_caps(blend2d.BLStrokeCap.CAP_ROUND)
        context.stroke_join = blend2d.BLStrokeJoin.JOIN_ROUND
        for path in strokes:
            context.stroke_path(path)
        context.flush()

    return frame, lambda: image.getDataAsNumPy().tobytes()


FRAME, RESULT = {"skia": skia_frame, "blend2d": blend2d_frame}[NAME]()
TIMES_MS = []
for _ in range(FRAMES):
    start = time.perf_counter()
    FRAME()
    TIMES_MS.append(1000 * (time.perf_counter() - start))
with open(PIXELS, "wb") as file:
    file.write(RESULT())
print(json.dumps(TIMES_MS))
