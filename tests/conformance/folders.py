"""Finds the files to compare below the folder of shared data."""


class Folders:
    """The folders of real files; each is left out, loudly, where it is absent."""

    REAL = ("layouts", "conformance/real")

    def __init__(self, top):
        self.top = top

    def missing(self):
        """The folders that are not there."""
        needed = (*self.REAL, "conformance/resvg", "conformance/schemas", "cases")
        return [name for name in needed if not (self.top / name).is_dir()]

    def find(self, *patterns, below=REAL):
        """The files of some names in these folders and all folders below, in order."""
        found = {f for name in below for p in patterns for f in (self.top / name).rglob(p)}
        return sorted(file for file in found if file.is_file())
