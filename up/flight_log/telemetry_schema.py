"""The schema of telemetry (docs/protocols.md 6): its tree is known, though no class declares it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from up.commands.board_datum import Datum
from up.commands.board_schema import DATA

READINGS = (
    *("orientation", "rx", "servo", "flight"),
    *("location", "altitude", "heading", "battery"),
)
_STICKS = ("ailerons", "elevator", "throttle", "rudder")
_ANGLES = ("roll", "pitch", "yaw")
_FLAG: dict[str, Any] = {"type": "boolean", "nullable": True}
_TEXT: dict[str, Any] = {"type": "string", "nullable": True}
_TEXTS: dict[str, Any] = {"type": "array", "items": {"type": "string"}, "nullable": True}
_ANYTHING: dict[str, Any] = {"type": "object", "properties": {}}


def _number(unit: str = "") -> dict[str, Any]:
    number = {"type": "number", "nullable": True}
    return {**number, "x-unit": unit, "description": unit} if unit else number


def _numbers(names: Iterable[str], unit: str = "") -> dict[str, Any]:
    return _object(dict.fromkeys(names, _number(unit)))


def _type(datum: Datum) -> dict[str, Any]:
    return {"flag": _FLAG, "text": _TEXT, "number": _number(datum.unit)}[datum.kind]


def _object(properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "nullable": True}


PROPERTIES: dict[str, Any] = {
    "orientation": _numbers(_ANGLES, "deg"),
    "rates": _numbers(_ANGLES, "deg/s"),
    "rx": _numbers((*_STICKS, "aux1", "aux2"), "us"),
    "servo": _numbers(_STICKS, "us"),
    "location": _object(
        {"latitude": _number("deg"), "longitude": _number("deg"), "altitude": _number("m")}
    ),
    "home": _object({"distance": _number("m"), "bearing": _number("deg")}),
    "altitude": _number("m"),
    "altitude_required": _number("m"),
    "heading": _numbers(("actual", "required"), "deg"),
    "android": _object(
        {"connected": _FLAG, "batteryLevel": _number("percent"), "competitor": _TEXT}
    ),
    "arduino": _object(
        {
            **{"connected": _FLAG, "framing": _TEXT},
            **{each.name: _type(each) for each in DATA if each.in_telemetry},
        }
    ),
    "load": _object(
        {
            "cpu": _number("percent"),
            "ram": _number("percent"),
            "panic": _FLAG,
            "delay_ms": _number("ms"),
        }
    ),
    "mode": _TEXT,
    "flight_mode": _TEXT,
    "flight_controller": _TEXT,
    "flight_control": _object({"mode": _TEXT, "offered": _TEXTS, "missing": _TEXTS}),
    "control": _object({"publisher": _TEXT}),
    "armed": _FLAG,
    "in_flight": _FLAG,
    "vetoes": _TEXTS,
    "age_ms": _numbers(READINGS, "ms"),
    "source": _object(dict.fromkeys(READINGS, _TEXT)),
    "ground": _object({"role": _TEXT, "tune_in_flight": _FLAG}),
    "black_box": _object(
        {
            "recording": _FLAG,
            "file": _TEXT,
            "megabytes": _number("MB"),
            "dropped": _number(),
            "problem": _TEXT,
        }
    ),
    "counters": _ANYTHING,
    "system": _object(
        {
            "providers": _TEXTS,
            "uptime_s": _number("s"),
            "clock_ms": _number("ms"),
            "period_ms": _number("ms"),
        }
    ),
}
"""Additional content of modules is in the messages and not in the schema."""
