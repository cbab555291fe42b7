"""Files that Guideway writes from every source format, against the schemas of the formats."""

import json
import tempfile
from pathlib import Path

import ezdxf
import jsonschema
from lxml import etree

from guideway import Refused

# Target, ending of the file, schema.
TARGETS = (
    ("lif", ".lif.json", "LIF-1.0.schema.json"),
    ("vda5050", ".json", "VDA5050-2.0-order.schema.json"),
    ("vda5050-3", ".json", "VDA5050-3.0-order.schema.json"),
    ("opentcs6", ".xml", "opentcs-model-6.0.0.xsd"),
    ("opentcs", ".xml", "opentcs-model-7.0.0.xsd"),
    ("dxf", ".dxf", None),
)


def checkers(folder):
    """A function per target that returns the errors of a written file."""
    found = {}
    for target, _, schema in TARGETS:
        if schema is None:
            found[target] = audit
        elif schema.endswith(".xsd"):
            found[target] = _xml(etree.XMLSchema(etree.parse(folder / schema)))
        else:
            text = json.loads((folder / schema).read_text("utf-8-sig"))
            found[target] = _json(jsonschema.validators.validator_for(text)(text))
    return found


def _json(validator):
    def errors(path):
        found = validator.iter_errors(json.loads(path.read_text()))
        return [f"{list(e.absolute_path)}: {e.message[:150]}" for e, _ in zip(found, range(3))]

    return errors


def _xml(schema):
    def errors(path):
        schema.validate(etree.parse(path))
        return [str(e)[:200] for e, _ in zip(schema.error_log, range(3))]

    return errors


def audit(path):
    auditor = ezdxf.readfile(path).audit()
    return [str(e.message)[:150] for e in (auditor.errors + auditor.fixes)[:3]]


def check(command, source, checks):
    """Writes a file to every target.

    Yields the target and the errors of the written file, or `None` where it is not written. LIF is
    saved in place: errors that it had before are its own.
    """
    for target, ending, _ in TARGETS:
        with tempfile.TemporaryDirectory() as folder:
            written = Path(folder) / ("written" + ending)
            try:
                command.convert(source, written, "--to", target)
            except Refused:
                yield target, None
                continue
            errors = checks[target](written)
            if target == "lif" and errors and written.read_bytes() == source.read_bytes():
                errors = None
            yield target, errors
