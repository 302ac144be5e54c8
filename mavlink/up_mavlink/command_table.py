"""MAVLink's commands as Commands of Up; all others are answered with UNSUPPORTED."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from up.commands.altitude_command import AltitudeCommand
from up.commands.arming_commands import ArmCommand, DisarmCommand
from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightModeCommand
from up.commands.heading_command import HeadingCommand
from up.commands.mission_commands import MissionItemCommand
from up.commands.navigation_commands import HomeCommand, NavigationTargetCommand
from up.commands.refusal import Code
from up.mission.reliable_requests import NO_ANSWER
from up.telemetry_frame import Frame
from up_mavlink.modes import mode_of
from up_mavlink.personas import Persona

ACCEPTED, TEMPORARILY_REJECTED, DENIED, UNSUPPORTED, FAILED, IN_PROGRESS = range(6)
"""Results of COMMAND_ACK."""
DO_SET_MODE, DO_REPOSITION, SET_CURRENT = 176, 192, 224
_LATER = {Code.STALE, Code.NO_BEACON, Code.UNKNOWN_BEACON, Code.OVERLOADED, Code.TAKEN}
_UNSUPPORTED = {Code.UNKNOWN, Code.NOT_SUPPORTED}
_FAILED = {Code.TIMEOUT, Code.FAILED, Code.UNAVAILABLE}
RESULTS = {
    "": ACCEPTED,
    NO_ANSWER: FAILED,
    **{each.value: TEMPORARILY_REJECTED for each in _LATER},
    **{each.value: UNSUPPORTED for each in _UNSUPPORTED},
    **{each.value: FAILED for each in _FAILED},
}
"""The result for a code of up.nack; DENIED for all others."""
_ABOVE_SEA, _ABOVE_HOME = (0, 5), (3, 6)
_FRAMES = "the frame must be 0 or 5 (above sea level), 3 or 6 (above home)"
MIN_RADIUS_M = 10.0


class CommandNotTranslatedError(Exception):
    """A command that leads to no Command; ``result`` is that of its COMMAND_ACK."""

    def __init__(self, result: int, reason: str) -> None:
        super().__init__(reason)
        self.result = result
        self.reason = reason


@dataclass(frozen=True, slots=True)
class Request:
    """A command: its number, 7 parameters (None: not a number), and the frame of its position.

    Parameters 5 and 6 are in degrees if there is a frame.
    """

    command: int
    params: Sequence[float | None]
    frame: int | None = None

    def number(self, place: int, default: float = 0.0) -> float:
        """Return parameter ``place``; the first is 1."""
        given = self.params[place - 1]
        return default if given is None else given


def of_long(message: Any) -> Request:
    """Return the request of a COMMAND_LONG."""
    return Request(message.command, _finite(getattr(message, f"param{n}") for n in range(1, 8)))


def of_int(message: Any) -> Request:
    """Return the request of a COMMAND_INT, or of a MISSION_ITEM_INT that is a target."""
    params = [*(getattr(message, f"param{n}") for n in range(1, 5)), *position_of(message)]
    return Request(message.command, _finite([*params, message.z]), message.frame)


def position_of(message: Any) -> tuple[float, float]:
    """Return x and y of a message in degrees: whole numbers are 1e-7 degrees."""
    if isinstance(message.x, float):
        return message.x, message.y
    return message.x / 1e7, message.y / 1e7


def _finite(given: Any) -> list[float | None]:
    return [each if math.isfinite(each) else None for each in given]


def translate(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    """Return the Commands of a command, in order.

    Raises CommandNotTranslatedError; InvalidCommandError for a value that is out of range.
    """
    handler = _TABLE.get(request.command)
    if handler is None:
        text = f"command {request.command} is not supported"
        raise CommandNotTranslatedError(UNSUPPORTED, text)
    return handler(request, persona, frame)


def target_of(request: Request) -> NavigationTargetCommand:
    """Return the target of a position; raises as ``translate``."""
    latitude, longitude, altitude = request.params[4:7]
    if request.frame not in (*_ABOVE_SEA, *_ABOVE_HOME):
        raise CommandNotTranslatedError(DENIED, _FRAMES)
    kind = "altitude" if request.frame in _ABOVE_SEA else "height"
    radius = abs(request.number(3)) if request.command == DO_REPOSITION else 0.0
    return NavigationTargetCommand.from_data(
        {
            "latitude": latitude,
            "longitude": longitude,
            kind: altitude,
            "radius": radius if radius >= MIN_RADIUS_M else None,
        }
    )


def _arm(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    # Parameter 2 would force it: the aircraft's checks cannot be skipped.
    wanted = request.params[0]
    if wanted not in (0.0, 1.0):
        raise CommandNotTranslatedError(DENIED, "parameter 1 must be 1 (arm) or 0 (disarm)")
    return [ArmCommand() if wanted else DisarmCommand()]


def mode_commands(number: int, persona: Persona, frame: Frame) -> list[BaseCommand]:
    """Return what selects a custom mode; GUIDED circles where the aircraft is, as elsewhere."""
    mode = mode_of(persona, frame, number)
    if mode is None:
        text = f"mode {number} of {persona.name} is not a mode of this aircraft"
        raise CommandNotTranslatedError(DENIED, text)
    if mode == "GUIDED" and frame.mode != mode and (position := frame.position) is not None:
        here = {"latitude": position[0], "longitude": position[1]}
        return [NavigationTargetCommand.from_data(here), FlightModeCommand(mode)]
    return [FlightModeCommand(mode)]


def _set_mode(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    main, sub = int(request.number(2)), int(request.number(3))
    is_px4 = persona.name == "px4"
    return mode_commands(main << 16 | sub << 24 if is_px4 else main, persona, frame)


def _reposition(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    return [target_of(request), FlightModeCommand("GUIDED")]


def _home(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    if request.number(1) == 1:
        return [HomeCommand()]
    latitude, longitude, altitude = request.params[4:7]
    if request.frame not in (None, *_ABOVE_SEA):
        raise CommandNotTranslatedError(DENIED, "the frame must be 0 or 5 (above sea level)")
    home = {"latitude": latitude, "longitude": longitude, "altitude": altitude}
    return [HomeCommand.from_data(home)]


def _land(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    """Return LAND at home, or at the place of the request; without an altitude, that of home."""
    latitude, longitude, altitude = request.params[4:7]
    land = FlightModeCommand("LAND")
    if not latitude and not longitude:
        return [land]
    if altitude is None:
        request = replace(request, params=[*request.params[:6], 0.0], frame=_ABOVE_HOME[0])
    target = target_of(request)
    # No other mode may follow a target on the ground, should LAND refuse it.
    return [target] if frame.mode == land.mode else [FlightModeCommand("LOITER"), target, land]


def _altitude(altitude: float | None, kind: float | None, frame: Frame) -> list[BaseCommand]:
    """Return what changes the altitude in the present mode; ``kind`` is a frame of MAVLink."""
    if kind in _ABOVE_HOME:
        home_m = frame.number("home", "altitude")
        if home_m is None:
            raise CommandNotTranslatedError(DENIED, "home is unknown")
        altitude = None if altitude is None else altitude + home_m
    elif kind not in _ABOVE_SEA:
        raise CommandNotTranslatedError(DENIED, _FRAMES)
    names = ("latitude", "longitude", "radius")
    target = {name: frame.number("navigation", "target", name) for name in names}
    if frame.mode == "GUIDED" and target["latitude"] is not None:
        return [NavigationTargetCommand.from_data({**target, "altitude": altitude})]
    return [AltitudeCommand.from_data({"altitude": altitude, "mode": "required"})]


def _change_altitude(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    return _altitude(request.params[0], request.params[1], frame)


def _guided_altitude(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    return _altitude(request.params[6], request.frame, frame)


def _guided_heading(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    if request.number(1) != 0:
        text = "the course over the ground is held, not the heading: parameter 1 must be 0"
        raise CommandNotTranslatedError(DENIED, text)
    return [HeadingCommand.from_data({"heading": request.params[1], "mode": "required"})]


def _pause(request: Request, persona: Persona, frame: Frame) -> list[BaseCommand]:
    return [FlightModeCommand("MISSION" if request.number(1) == 1 else "LOITER")]


def _mode(name: str) -> Callable[[Request, Persona, Frame], list[BaseCommand]]:
    return lambda request, persona, frame: [FlightModeCommand(name)]


def item_command(item: int) -> MissionItemCommand:
    """Return the selection of an item; raises InvalidCommandError."""
    return MissionItemCommand.from_data({"item": item})


_TABLE: dict[int, Callable[[Request, Persona, Frame], list[BaseCommand]]] = {
    17: _mode("LOITER"),
    20: _mode("RETURN"),
    21: _land,
    22: _mode("TAKEOFF"),
    DO_SET_MODE: _set_mode,
    179: _home,
    186: _change_altitude,
    DO_REPOSITION: _reposition,
    193: _pause,
    300: _mode("MISSION"),
    400: _arm,
    43001: _guided_altitude,
    43002: _guided_heading,
}
