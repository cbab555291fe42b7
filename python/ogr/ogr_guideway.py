# gdal: DRIVER_NAME = "GUIDEWAY"
# gdal: DRIVER_SUPPORTED_API_VERSION = [1]
# gdal: DRIVER_DCAP_VECTOR = "YES"
# gdal: DRIVER_DCAP_OPEN = "YES"
# gdal: DRIVER_DMD_LONGNAME = "Path layouts of automated guided vehicles (Guideway)"
# gdal: DRIVER_DMD_EXTENSIONS = "json xml yaml dxf arrow"
# gdal: DRIVER_DMD_CONNECTION_PREFIX = "GUIDEWAY:"
"""Layers `edges`, `nodes` and `stations` of a layout for GDAL and QGIS (GDAL RFC 76).

GDAL finds this file by `GDAL_PYTHON_DRIVER_PATH`. Its Python needs guideway and pyarrow.
"""

from gdal_python_driver import BaseDataset, BaseDriver, BaseLayer

PREFIX = "GUIDEWAY:"
# Texts at the begin of files that no driver of GDAL reads; the prefix opens any file.
MARKS = [b'"metaInformation"', b'"layoutName"', b"<model", b'"orderId"', b"vertices:", b"crowd_sim:"]
TYPES = {"bool": "Boolean", "int64": "Integer64", "uint32": "Integer64", "double": "Real"}


class Layer(BaseLayer):
    """Elements of a kind."""

    def __init__(self, name, table, is_on_earth):
        self.name = name
        self.table = table
        self.is_line = name == "edges"
        columns = [field for field in table.schema if field.name != "geometry"]
        self.fields = [
            {"name": field.name, "type": TYPES.get(str(field.type), "String")} for field in columns
        ]
        kind = "LineString" if self.is_line else "Point"
        srs = "EPSG:4326" if is_on_earth else None
        self.geometry_fields = [{"name": "geometry", "type": kind, "srs": srs}]
        self.fid_name = "row"

    def feature_count(self, force_computation):
        return len(self.table)

    def __iter__(self):
        row = 0
        for batch in self.table.to_batches(1024):
            for values in batch.to_pylist():
                geometry = values.pop("geometry")
                fields = {
                    name: ", ".join(value) if isinstance(value, list) else value
                    for name, value in values.items()
                }
                yield {
                    "type": "OGRFeature",
                    "id": row,
                    "fields": fields,
                    "geometry_fields": {"geometry": self.text(geometry)},
                }
                row += 1

    def text(self, geometry):
        """Well-known text of a line or point; `None` without one."""
        if geometry is None:
            return None
        points = geometry if self.is_line else [geometry]
        numbers = ", ".join(f"{point['x']!r} {point['y']!r}" for point in points)
        return f"LINESTRING ({numbers})" if self.is_line else f"POINT ({numbers})"


class Dataset(BaseDataset):
    """The layers of a layout."""

    def __init__(self, layout):
        import pyarrow

        self.metadata = {"FORMAT": layout.format}
        kinds = {"edges": len(layout), "nodes": len(layout.nodes), "stations": len(layout.stations)}
        on_earth = layout.on_earth
        self.layers = []
        for kind, count in kinds.items():
            if count > 0:
                table = pyarrow.table(layout.features(kind, on_earth=on_earth))
                self.layers.append(Layer(kind, table, on_earth))

    def layer_count(self):
        return len(self.layers)

    def layer(self, index):
        return self.layers[index]


class Driver(BaseDriver):
    """Opens files that Guideway reads."""

    def identify(self, filename, first_bytes, open_flags, open_options={}):
        return filename.startswith(PREFIX) or any(mark in first_bytes for mark in MARKS)

    def open(self, filename, first_bytes, open_flags, open_options={}):
        if not self.identify(filename, first_bytes, open_flags):
            return None
        import guideway

        return Dataset(guideway.open(filename.removeprefix(PREFIX)))
