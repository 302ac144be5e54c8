"""General Messages as the phone writes and reads them (protocols 4), and orientation frames."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from typing import Any

from up_simulator.aircraft.flight import FlightState

LONGEST_LINE = 16384


class MalformedError(ValueError):
    """A line that is not a General Message."""


@dataclass(frozen=True, slots=True)
class GeneralMessage:
    """A Command of the General Message protocol."""

    name: str
    data: dict[str, Any]
    id: str | None = None


def write_message(message: GeneralMessage) -> bytes:
    """Return the line of a message with its LF; raises ``ValueError`` for NaN and infinity."""
    fields = {"name": message.name, "data": message.data, "id": message.id}
    return json.dumps(fields, allow_nan=False).encode("ascii") + b"\n"


def read_message(line: bytes) -> GeneralMessage:
    """Return the message of a line without its LF; raises ``MalformedError``."""
    try:
        fields = json.loads(line.decode("utf-8"), parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise MalformedError(f"no JSON: {error}") from error
    if not isinstance(fields, dict) or not isinstance(fields.get("name"), str):
        raise MalformedError("no object with a name")
    data, identity = fields.get("data"), fields.get("id")
    if data is not None and not isinstance(data, dict):
        raise MalformedError("data is no object")
    if isinstance(identity, int) and not isinstance(identity, bool):
        identity = str(identity)
    if identity is not None and not isinstance(identity, str):
        raise MalformedError("id is no text")
    return GeneralMessage(fields["name"], data or {}, identity)


def write_orientation(state: FlightState) -> bytes:
    """Return the 24 bytes of an Orientation Forward frame (protocols 3)."""
    angles = (state.roll_deg, state.pitch_deg, state.yaw_deg)
    rates = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
    return struct.pack(">6f", *angles, *rates)


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")
