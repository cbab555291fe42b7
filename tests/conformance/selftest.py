"""Every comparator must fail on a changed file: Guideway reads one, the other reader another."""

import json
import tempfile
from pathlib import Path

from PIL import Image, ImageDraw

import comparison
import dxf
import geojson
import lanelets
import nurbs
import opendrive
import opentcs
import pictures
import rmf
import schemas
import svg

# A line or curve with a value @, per reader.
EXAMPLES = (
    (
        dxf,
        "example.dxf",
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
        "0\nARC\n8\n0\n10\n0\n20\n0\n40\n@\n50\n10\n51\n200\n0\nENDSEC\n0\nEOF\n",
    ),
    (
        svg,
        "example.svg",
        '<svg xmlns="http://www.w3.org/2000/svg" width="5000mm" height="5000mm" viewBox="0 0 5 5">'
        '<path d="M 0 0 C 1 0 @ 1 2 2" stroke="black"/></svg>',
    ),
    (
        nurbs,
        "example.lif.json",
        json.dumps(
            {
                "metaInformation": {"lifVersion": "1.0.0"},
                "layouts": [
                    {
                        "layoutId": "L",
                        "nodes": [
                            {
                                "nodeId": "a",
                                "nodePosition": {"x": 0, "y": 0},
                                "vehicleTypeNodeProperties": [],
                            },
                            {
                                "nodeId": "b",
                                "nodePosition": {"x": 2, "y": 0},
                                "vehicleTypeNodeProperties": [],
                            },
                        ],
                        "edges": [
                            {
                                "edgeId": "e",
                                "startNodeId": "a",
                                "endNodeId": "b",
                                "vehicleTypeEdgeProperties": [
                                    {
                                        "vehicleTypeId": "t",
                                        "trajectory": {
                                            "degree": 2,
                                            "knotVector": [0, 0, 0, 1, 1, 1],
                                            "controlPoints": [
                                                {"x": 0, "y": 0},
                                                {"x": 1, "y": "@", "weight": 2},
                                                {"x": 2, "y": 0},
                                            ],
                                        },
                                    }
                                ],
                            }
                        ],
                        "stations": [],
                    }
                ],
            }
        ).replace('"@"', "@"),
    ),
    (
        opentcs,
        "example.xml",
        '<model version="6.0.0" name="m"><point name="a" positionX="0" positionY="0">'
        '<pointLayout positionX="0" positionY="0"/></point><point name="b" positionX="@" '
        'positionY="500"><pointLayout positionX="@" positionY="500"/></point>'
        '<path name="p" sourcePoint="a" destinationPoint="b" maxVelocity="1000" '
        'maxReverseVelocity="0"><pathLayout connectionType="DIRECT"/></path></model>',
    ),
    (
        opendrive,
        "example.xodr",
        '<OpenDRIVE><header revMajor="1" revMinor="4"/><road id="1" length="20" junction="-1">'
        '<planView><geometry s="0" x="0" y="0" hdg="0" length="20"><spiral curvStart="0" '
        'curvEnd="@"/></geometry></planView><lanes><laneSection s="0"><right><lane id="-1" '
        'type="driving"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane></right></laneSection>'
        "</lanes></road></OpenDRIVE>",
    ),
    (
        lanelets,
        "example.osm",
        '<osm version="0.6" generator="g"><node id="1" lat="49" lon="8"><tag k="local_x" v="0"/>'
        '<tag k="local_y" v="0"/></node><node id="2" lat="49.0001" lon="8"><tag k="local_x" v="@"/>'
        '<tag k="local_y" v="9"/></node><way id="3"><nd ref="1"/><nd ref="2"/></way></osm>',
    ),
    (
        rmf,
        "example.building.yaml",
        "coordinate_system: cartesian_meters\nlevels:\n  L1:\n    elevation: 0\n    lanes:\n"
        "      - [0, 1, {graph_idx: [2, 0]}]\n    vertices:\n      - [0, 0, 0, a]\n"
        "      - [@, 2, 0, b]\nname: n\n",
    ),
    (
        geojson,
        "example.geojson",
        '{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": '
        '"EPSG:25832"}}, "features": [{"type": "Feature", "id": "a", "properties": {}, "geometry": '
        '{"type": "LineString", "coordinates": [[0, 0], [@, 3]]}}]}',
    ),
)
# The value for Guideway, and that for the other reader: some millimeters apart.
VALUES = {name: ("1", "1.005") for _, name, _ in EXAMPLES} | {
    "example.xml": ("1000", "1005"),
    "example.xodr": ("0.01", "0.0101"),
}


def run(command):
    """Raises AssertionError where a comparator does not tell a changed file from its like."""
    with tempfile.TemporaryDirectory() as folder:
        for reader, name, text in EXAMPLES:
            same, other = Path(folder) / name, Path(folder) / ("changed-" + name)
            same.write_text(text.replace("@", VALUES[name][0]))
            other.write_text(text.replace("@", VALUES[name][1]))
            answer = command.read(same)
            result = comparison.compare(answer, reader.read(same))
            is_same = result.elements == 1 and result.deviation <= reader.TOLERANCE
            assert is_same and not result.faults, (name, result)
            result = comparison.compare(answer, reader.read(other))
            assert result.deviation > reader.TOLERANCE, f"{name}: the change was not found"
            emptied = reader.read(same)
            emptied.curves.clear()
            assert comparison.compare(answer, emptied).faults, f"{name}: the gap was not found"
        _pictures(command, Path(folder))
        _schemas(Path(folder))


def _pictures(command, folder):
    drawing = folder / "picture.svg"
    drawing.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
        '<path d="M 20 20 L 80 20" stroke="black" stroke-width="4"/></svg>'
    )
    answer = command.read(drawing)
    for moved_px, is_same in ((0, True), (5, False)):
        picture = Image.new("RGBA", (100, 100))
        y = 20 + moved_px
        ImageDraw.Draw(picture).rectangle((20, y - 2, 79, y + 1), "black")
        picture.save(drawing.with_suffix(".png"))
        result = pictures.compare(answer, drawing)
        assert (result.deviation <= pictures.TOLERANCE) == is_same, (moved_px, result)


def _schemas(folder):
    # A drawing without its tables, which the audit of ezdxf repairs.
    broken = folder / "broken.dxf"
    broken.write_text(EXAMPLES[0][2].replace("@", "1").replace("8\n0\n10", "8\na<b\n10"))
    assert schemas.audit(broken), "the audit found nothing"
