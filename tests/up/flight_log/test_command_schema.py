import dataclasses
import json
from typing import ClassVar

import pytest

from tests.flightlog.logs import LogMaker
from tests.up.flight_log.commands import example, installed_commands
from up.commands.command import BaseCommand, value
from up.commands.origin import INTERNAL, Origin
from up.commands.roles import Role
from up.flight_log.command_schema import schema_of
from up.flight_log.foxglove import LOCATION_FIX_SCHEMA, LOG_SCHEMA, timestamp
from up.flight_log.origin_text import KEY, link_and_role, origin_text

COMMANDS = installed_commands()
_TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
}


def fault_of(data, schema, path="data"):
    """Return why data break a schema; empty: they do not. Unknown keywords are refused."""
    known = {"$schema", "title", "description", "type", "properties", "required", "items"}
    known |= {"minimum", "maximum", "enum", "maxLength", "maxItems", "minItems"}
    known |= {"maxProperties", "nullable", "x-unit"}
    if set(schema) - known:
        return f"{path}: unknown keywords {set(schema) - known}"
    if data is None and schema.get("nullable"):
        return ""
    kind = _TYPES[schema["type"]]
    if not isinstance(data, kind) or (isinstance(data, bool) and kind is not bool):
        return f"{path} is no {schema['type']}"
    if "enum" in schema and data not in schema["enum"]:
        return f"{path} is not one of {schema['enum']}"
    if not schema.get("minimum", -1e99) <= (data if "minimum" in schema else 0):
        return f"{path} is out of range"
    if not schema.get("maximum", 1e99) >= (data if "maximum" in schema else 0):
        return f"{path} is out of range"
    if len(str(data)) > schema.get("maxLength", 10**6):
        return f"{path} is too long"
    if isinstance(data, list):
        faults = (fault_of(each, schema["items"], f"{path}[]") for each in data)
        return next(filter(None, faults), "")
    if isinstance(data, dict):
        missing = [key for key in schema.get("required", []) if key not in data]
        if missing:
            return f"{path} has no {missing}"
        faults = (
            fault_of(each, schema["properties"][key], f"{path}.{key}")
            for key, each in data.items()
            if key in schema["properties"]
        )
        return next(filter(None, faults), "")
    return ""


def foxglove_fault(schema, path=""):
    """Return what Foxglove's reader of JSON Schemas refuses: it takes one type a field."""
    if schema.get("type") == "object":
        if "properties" not in schema:
            return f"{path} has no properties"
        faults = (foxglove_fault(each, f"{path}.{k}") for k, each in schema["properties"].items())
        return next(filter(None, faults), "")
    if schema.get("type") == "array":
        return foxglove_fault(schema["items"], f"{path}[]") if "items" in schema else path
    return "" if schema.get("type") in ("string", "number", "integer", "boolean") else path


def test_the_cogs_commands_are_among_them():
    names = {cls.NAME for cls in COMMANDS}
    assert {"up.rx.update", "arduino.status", "android.battery", "arduino.profile.values"} <= names


@pytest.mark.parametrize("cls", COMMANDS, ids=lambda cls: cls.NAME)
def test_every_command_has_a_schema_that_its_data_satisfy(cls):
    schema = schema_of(cls)
    assert schema["title"] == cls.NAME
    assert schema["description"]
    assert json.loads(json.dumps(schema, allow_nan=False)) == schema
    assert foxglove_fault(schema) == ""
    for is_full in (True, False):
        data = json.loads(json.dumps({**example(cls, is_full).data, KEY: "internal"}))
        assert fault_of(data, schema) == ""
    for key in schema["required"]:
        short = {name: each for name, each in data.items() if name != key}
        assert "has no" in fault_of(short, schema)


def test_units_and_bounds():
    @dataclasses.dataclass(frozen=True, slots=True)
    class AirspeedCommand(BaseCommand):
        """How fast the ``air`` passes,
        at the tube.

        Not told.
        """

        NAME: ClassVar[str] = "my.airspeed"
        speed_m_s: float = value(key="speed", minimum=0, maximum=100, unit="m/s")
        tube: str | None = value(None, choices=("left", "right"))

    assert schema_of(AirspeedCommand) == {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "my.airspeed",
        "description": "How fast the air passes, at the tube.",
        "type": "object",
        "properties": {
            "speed": {
                "type": "number",
                "minimum": 0,
                "maximum": 100,
                "x-unit": "m/s",
                "description": "m/s",
            },
            "tube": {"type": "string", "enum": ["left", "right", None], "nullable": True},
            "_origin": {"type": "string", "description": "link and role of the sender"},
        },
        "required": ["speed"],
    }


def test_foxgloves_own_schemas_are_ones_that_it_reads():
    log = {"timestamp": timestamp(1_700_000_000_123_456_789), "level": 3, "message": "x"}
    assert log["timestamp"] == {"sec": 1_700_000_000, "nsec": 123_456_789}
    assert fault_of({**log, "name": "a", "file": "", "line": 0}, LOG_SCHEMA) == ""
    place = {"timestamp": timestamp(0), "latitude": 50.1, "longitude": 14.4, "altitude": 3}
    assert fault_of({**place, "position_covariance": [0.0] * 9}, LOCATION_FIX_SCHEMA) == ""
    assert foxglove_fault(LOG_SCHEMA) == foxglove_fault(LOCATION_FIX_SCHEMA) == ""
    assert fault_of({**log, "level": 6}, LOG_SCHEMA)


def test_the_schema_comes_back_out_of_the_log(tmp_path):
    cls = next(each for each in COMMANDS if each.NAME == "up.rx.update")
    maker = LogMaker()
    maker.channel(cls.NAME, schema_of(cls))
    maker.add(0, cls.NAME, **example(cls, True).data)
    assert maker.log(tmp_path).schema(cls.NAME) == schema_of(cls)


@pytest.mark.parametrize(
    ("origin", "text"),
    [(INTERNAL, "internal"), (Origin("arduino", Role.BOARD, 10), "arduino (board)")],
)
def test_an_origin_is_a_text_and_back(origin, text):
    assert origin_text(origin) == text
    assert link_and_role(text) == (origin.link, origin.role.value)


@pytest.mark.parametrize(
    ("text", "read"), [("x", ("x", "")), ("a (b", ("a (b", "")), (None, ("", "")), (3, ("", ""))]
)
def test_any_other_origin(text, read):
    assert link_and_role(text) == read
