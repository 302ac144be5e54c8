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
    """Noise on the serial line for a time."""

    for_s: float = key(1.0, "Duration.", unit="s", minimum=0.02, maximum=3600)
    flipped_percent: float = key(
        0.0, "Share of bytes with one bit flipped.", unit="%", minimum=0, maximum=100
    )
    inserted_percent: float = key(
        0.0, "Share of bytes followed by an inserted byte.", unit="%", minimum=0, maximum=100
    )
    lost_percent: float = key(0.0, "Share of lost bytes.", unit="%", minimum=0, maximum=100)
    direction: Literal["both", "to the board", "from the board"] = key(
        "both", "The wire that picks up the noise."
    )


@dataclass(frozen=True, slots=True)
class CommandPart:
    """A Command that the ground station sends."""

    name: str = key("", "Name of the Command, such as up.flight_mode.set.", max_length=128)
    data: dict[str, Any] = mapping(_NAME, _TEXT, "Fields of the Command (docs/protocols.md 5).")
    answer: Literal["ack", "nack", "none", "any"] = key(
        "any", "Expected answer; any: the answer is not checked."
    )
    within_s: float = key(
        2.0, "Maximum time until the answer.", unit="s", minimum=0.02, maximum=600
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if not self.name:
            yield "name", "must be the name of a Command, such as up.flight_mode.set"


@dataclass(frozen=True, slots=True)
class Event:
    """A timed event: exactly one change, to which its effects can be attributed."""

    at_s: float = key(0.0, "Time; 0 is the start of the flight.", unit="s", minimum=0, maximum=3600)
    name: str = key(
        "", "Name in reports and pictures, and in 'after' of an expectation.", max_length=80
    )
    mark: str | None = key(
        None,
        "No change: only a name for this time, for example for a move of the sticks.",
        max_length=80,
    )
    imu: Literal["well", "frozen", "unplugged", "stuck", "garbage"] | None = key(
        None,
        "frozen repeats the last sample, stuck holds the bus, garbage sends noise, unplugged does"
        " not answer; well: it works again.",
    )
    imu_errors: ImuPart | None = section(
        ImuPart, "Noise, bias and vibration of the IMU from this time.", optional=True
    )
    receiver: Literal["lost", "failsafe", "back"] | None = key(
        None,
        "lost: no pulses on any channel. failsafe: without radio it holds its pulses and sends its"
        " own failsafe on the throttle. back: it works again.",
    )
    channel_lost: _CHANNEL | None = key(None, "The wire of this receiver channel breaks.")
    channel_back: _CHANNEL | None = key(None, "The wire of this receiver channel is repaired.")
    reset: Literal["watchdog", "power", "button", "brown-out"] | None = key(
        None, "The Arduino resets, with this cause."
    )
    serial: Literal["unplugged", "back"] | None = key(
        None, "The serial line between Arduino and Raspberry Pi."
    )
    serial_noise: SerialNoise | None = section(
        SerialNoise, "Noise on the serial line.", optional=True
    )
    phone: Literal["unplugged", "back"] | None = key(None, "The cable of the phone aboard.")
    gps: Literal["lost", "jumped", "frozen", "back"] | None = key(
        None,
        "The GPS of the phone. lost: no fix. jumped: 300 m beside the truth. frozen: the last fix"
        " again and again.",
    )
    gps_receiver: Literal["unplugged", "lost", "jumped", "frozen", "back"] | None = key(
        None, "The receiver beside the phone. unplugged: its port is gone; else as gps."
    )
    crsf: Literal["low", "middle", "high", "lost"] | None = key(
        None,
        "The switch of the transmitter whose CRSF receiver is at the Raspberry Pi. lost: the"
        " receiver reports that it receives nothing.",
    )
    mavlink: Literal["FBWA", "CRUISE", "LOITER", "AUTO", "RTL", "silent", "back"] | None = key(
        None,
        "The MAVLink ground selects a flight mode, by the name of ArduPlane's. silent: it sends"
        " nothing more, not even heartbeats, and stays connected.",
    )
    i2c: Literal["unplugged", "back"] | None = key(
        None, "The wire to all sensors at the I2C bus: every transfer fails."
    )
    motor: Literal["stopped", "back"] | None = key(
        None, "stopped: the motor gives no thrust, whatever the throttle, and nothing reports it."
    )
    throw: float | None = key(
        None, "A hand holds the aircraft until it throws it, so fast over the ground.", unit="m/s",
        minimum=2, maximum=20,
    )  # fmt: skip
    flight_battery: float | None = key(
        None, "Charge of the flight battery from this time.", unit="%", minimum=0, maximum=100
    )
    phone_battery: float | None = key(
        None, "Battery level of the phone from this time.", unit="%", minimum=0, maximum=100
    )
    link: Literal["blackout", "stall", "restore"] | None = key(
        None,
        "The link to the ground. blackout: all data is lost without notification. stall: all data"
        " is held and arrives later in a burst.",
    )
    link_settings: LinkPart | None = section(
        LinkPart, "Settings of the link to the ground from this time.", optional=True
    )
    raspilot: Literal["killed", "stopped", "started", "hung", "awake"] | None = key(
        None,
        "The daemon. killed: as by kill -9. stopped: as by systemd. hung: suspended until awake"
        " (real programs only).",
    )
    path: Literal["cut", "back"] | None = key(
        None, "The preferred one of two paths to the proxy. cut: it carries nothing, and stays up."
    )
    proxy: Literal["killed", "started"] | None = key(None, "The proxy; real programs only.")
    cpu_load_percent: float | None = key(
        None, "Load of the Raspberry Pi from this time.", unit="%", minimum=0, maximum=100
    )
    command: CommandPart | None = section(
        CommandPart, "The ground station sends a Command.", optional=True
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        kinds = self.kinds
        if not kinds:
            yield "at_s", "contains no event: set one of " + ", ".join(EVENT_KINDS)
        if self.mark == "":
            yield "mark", "must be a name"
        if self.mark and self.name:
            yield "name", f"the mark {self.mark!r} is already its name"
        for kind in kinds[1:]:
            yield kind, f"a second event beside '{kinds[0]}': move '{kind}' to a separate event"

    @property
    def kinds(self) -> list[str]:
        """Return the key of the event, the only one after a successful read."""
        return [kind for kind in EVENT_KINDS if getattr(self, kind) is not None]

    @property
    def title(self) -> str:
        if self.name or self.mark:
            return self.name or str(self.mark)
        kind = self.kinds[0]
        value = getattr(self, kind)
        label = kind.replace("_", " ")
        if kind == "command":
            return f"command {value.name}"
        return label if not isinstance(value, str | float) else f"{label} {value}"


EVENT_KINDS = tuple(name for name in Event.__slots__ if name not in _WHEN)
