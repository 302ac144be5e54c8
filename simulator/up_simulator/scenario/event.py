"""Timed events at the aircraft, its parts and its links."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from up.config import key, mapping, section
from up.fields import Constraint
from up_simulator.scenario.initial_conditions import ImuPart, LinkPart

_NAME = Constraint(str, max_length=128)
_TEXT = Constraint(str, max_length=4096)
_CHANNEL = Literal["ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"]
_WHEN = ("at_s", "name")


@dataclass(frozen=True, slots=True)
class SerialNoise:
    """Noise on the serial line for a while: how many bytes of a hundred it spoils."""

    for_s: float = key(1.0, "How long.", unit="s", minimum=0.02, maximum=3600)
    flipped_percent: float = key(
        0.0, "Bytes of which one bit is flipped.", unit="%", minimum=0, maximum=100
    )
    inserted_percent: float = key(
        0.0, "Bytes that are followed by one that nobody sent.", unit="%", minimum=0, maximum=100
    )
    lost_percent: float = key(0.0, "Bytes that are lost.", unit="%", minimum=0, maximum=100)
    direction: Literal["both", "to the board", "from the board"] = key(
        "both", "Which of the two wires picks it up."
    )


@dataclass(frozen=True, slots=True)
class CommandPart:
    """A Command that the ground station sends."""

    name: str = key("", "Its name, as up.flight_mode.set.", max_length=128)
    data: dict[str, Any] = mapping(_NAME, _TEXT, "Its fields (docs/protocols.md 5).")
    answer: Literal["ack", "nack", "none", "any"] = key(
        "any", "Which answer is expected; any: it does not matter."
    )
    within_s: float = key(
        2.0, "How soon the answer must come.", unit="s", minimum=0.02, maximum=600
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield the missing keys."""
        if not self.name:
            yield "name", "must be a Command's name, as up.flight_mode.set"


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happens at a time: exactly one thing, so that its time tells what it did."""

    at_s: float = key(0.0, "When; 0 is when the flight begins.", unit="s", minimum=0, maximum=3600)
    name: str = key(
        "", "What reports and pictures call it, and 'after' of an expectation.", max_length=80
    )
    mark: str | None = key(
        None,
        "Nothing happens: only a name for this moment, as of a move of the sticks.",
        max_length=80,
    )
    imu: Literal["well", "frozen", "unplugged", "stuck", "garbage"] | None = key(
        None,
        "frozen repeats its last sample, stuck holds the bus, garbage sends noise, unplugged does"
        " not answer; well: it works again.",
    )
    imu_errors: ImuPart | None = section(
        ImuPart, "The IMU's noise, bias and vibration from now on.", optional=True
    )
    receiver: Literal["lost", "failsafe", "back"] | None = key(
        None,
        "lost: no pulses on any channel. failsafe: it hears no radio, holds its pulses and sends"
        " its own failsafe on the throttle.",
    )
    channel_lost: _CHANNEL | None = key(None, "One wire of the receiver breaks.")
    channel_back: _CHANNEL | None = key(None, "That wire is mended.")
    reset: Literal["watchdog", "power", "button", "brown-out"] | None = key(
        None, "The Arduino resets."
    )
    serial: Literal["unplugged", "back"] | None = key(
        None, "The serial line between Arduino and Raspberry Pi."
    )
    serial_noise: SerialNoise | None = section(
        SerialNoise, "Noise on the serial line.", optional=True
    )
    phone: Literal["unplugged", "back"] | None = key(None, "The cable of the phone aboard.")
    gps: Literal["lost", "back"] | None = key(None, "The fixes of the phone's GPS.")
    phone_battery: float | None = key(
        None, "The phone's battery from now on.", unit="%", minimum=0, maximum=100
    )
    link: Literal["blackout", "stall", "restore"] | None = key(
        None,
        "The link to the ground: in a blackout all vanishes and nobody is told, in a stall all"
        " waits, to come in a burst.",
    )
    link_settings: LinkPart | None = section(
        LinkPart, "The link to the ground from now on.", optional=True
    )
    raspilot: Literal["killed", "stopped", "started", "hung", "awake"] | None = key(
        None,
        "The daemon: killed as kill -9 does, stopped as systemd does; hung: it stands still until"
        " it is awake.",
    )
    proxy: Literal["killed", "started"] | None = key(None, "The proxy; real programs only.")
    cpu_load_percent: float | None = key(
        None, "How busy the Raspberry Pi is from now on.", unit="%", minimum=0, maximum=100
    )
    command: CommandPart | None = section(
        CommandPart, "The ground station sends a Command.", optional=True
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield the missing and the surplus keys."""
        kinds = self.kinds
        if not kinds:
            yield "at_s", "nothing happens: name one of " + ", ".join(EVENT_KINDS)
        if self.mark == "":
            yield "mark", "must be a name"
        if self.mark and self.name:
            yield "name", f"the mark {self.mark!r} is its name already"
        for kind in kinds[1:]:
            yield kind, f"'{kinds[0]}' happens already: give '{kind}' an event of its own"

    @property
    def kinds(self) -> list[str]:
        """Return the key of the event, the only one after a successful read."""
        return [kind for kind in EVENT_KINDS if getattr(self, kind) is not None]

    @property
    def title(self) -> str:
        """Return its name, or a description."""
        if self.name or self.mark:
            return self.name or str(self.mark)
        kind = self.kinds[0]
        value = getattr(self, kind)
        words = kind.replace("_", " ")
        if kind == "command":
            return f"command {value.name}"
        return words if not isinstance(value, str | float) else f"{words} {value}"


EVENT_KINDS = tuple(name for name in Event.__slots__ if name not in _WHEN)
