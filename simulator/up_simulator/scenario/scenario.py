"""A scenario: everything in the file of one flight."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from up.config import items, key, mapping, section
from up.fields import Constraint
from up_simulator.scenario.event import Event
from up_simulator.scenario.expectation import Expectation
from up_simulator.scenario.initial_conditions import (
    ImuPart,
    LinkPart,
    ReceiverPart,
    StartPart,
    WeatherPart,
)
from up_simulator.scenario.sticks import StickPoint

_NAME = Constraint(str, max_length=128)
_TEXT = Constraint(str, max_length=4096)
BOARDS = ("auto", "firmware", "host", "direct")


@dataclass(frozen=True, slots=True)
class RaspilotPart:
    """The daemon on the Raspberry Pi."""

    runs: Literal["no", "in process", "real"] = key(
        "no",
        "no: the Arduino flies alone. in process: the whole daemon inside the simulator, as fast"
        " as it goes and repeatable. real: its own process on a pty, in real time.",
    )
    config: dict[str, dict[str, Any]] = mapping(
        _NAME, _TEXT, "Configuration by file: what differs from the defaults (config/*.yml)."
    )


@dataclass(frozen=True, slots=True)
class PhonePart:
    """The airborne phone: GPS, barometer, battery, and the orientation for Black Box."""

    plugged: bool = key(True, "Whether it is there when the flight begins.")
    orientation: Literal["off", "tcp", "udp"] = key(
        "off", "Whether it sends its own orientation, 50 times a second."
    )
    battery_percent: float = key(100.0, "Its battery.", unit="%", minimum=0, maximum=100)


@dataclass(frozen=True, slots=True)
class GroundPart:
    """The ground station."""

    role: Literal["observer", "operator", "pilot", "admin"] = key(
        "pilot", "What its link may do (mission_control.yml)."
    )
    period_ms: int | None = key(
        None, "The telemetry period that it asks for.", unit="ms", minimum=20, maximum=10_000
    )
    through: Literal["listener", "proxy", "runner"] = key(
        "listener",
        "listener: Raspilot's own port. proxy: the relay between the two. runner: the proxy, and"
        " the phone asks the runner to start Raspilot. The last two are real programs.",
    )


@dataclass(frozen=True, slots=True)
class SwitchPart:
    """Which modes the positions of AUX1 select."""

    low: Literal["ACRO", "RATE", "FBW", "AUTO"] = key("ACRO", "Below 1300 us.", ignore_case=True)
    middle: Literal["ACRO", "RATE", "FBW", "AUTO"] = key("FBW", "Between.", ignore_case=True)
    high: Literal["ACRO", "RATE", "FBW", "AUTO"] = key("AUTO", "Above 1700 us.", ignore_case=True)

    def positions(self) -> dict[str, str]:
        """Return the mode of each position."""
        return {"low": self.low, "middle": self.middle, "high": self.high}


@dataclass(frozen=True, slots=True)
class ControlPart:
    """The same flight without what makes it succeed: it must visibly fail."""

    about: str = key(
        "", "What is taken away, as a report says it: 'nobody stabilises'.", max_length=200
    )
    mode: Literal["ACRO", "RATE", "FBW", "AUTO"] | None = key(
        None, "The mode switch stays here for the whole flight.", ignore_case=True
    )
    board: Literal["auto", "firmware", "host", "direct"] | None = key(
        None, "Another board; direct wires the receiver straight to the servos."
    )
    fails: tuple[str, ...] = items(
        _TEXT, "The names of the expectations that must not hold then.", max_length=100
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield the missing keys."""
        if self.mode is None and self.board is None:
            yield "about", "takes nothing away: name 'mode' or 'board'"
        if not self.fails:
            yield "fails", "must name the expectations that fail without it"


@dataclass(frozen=True, slots=True)
class Scenario:
    """One flight: its start, its events, its expectations."""

    title: str = key("", "A few words, for lists and pictures.", max_length=100)
    about: str = key("", "What it shows, in a sentence or two.", max_length=2000)
    guards: str = key("", "The rule without which it fails.", max_length=200)
    tags: tuple[str, ...] = items(
        Constraint(str, max_length=40), "Words to choose scenarios by.", max_length=20
    )
    airframe: str = key(
        "glider",
        "Which aircraft: glider, wing, or an airframe.yml or its folder, from here or beside the"
        " scenario.",
        max_length=4096,
    )
    seed: int = key(1, "Of turbulence and all noise.", minimum=0, maximum=2**31 - 1)
    duration_s: float = key(30.0, "How long it flies.", unit="s", minimum=0.1, maximum=3600)
    board: Literal["auto", "firmware", "host", "direct"] = key(
        "auto",
        "What flies it. firmware: the compiled firmware on a simulated ATmega328P. host: the same"
        " source compiled for this machine. auto: firmware where it can be built, else host."
        " direct: no flight computer, the receiver is wired to the servos.",
    )
    eeprom: Literal["prepared", "blank", "spoiled"] = key(
        "prepared",
        "What the Arduino finds at power-on. prepared: the airframe's profile and gains. blank: a"
        " new chip. spoiled: wrong bits everywhere.",
    )
    may_crash: bool = key(False, "Whether hitting the ground is no failure.")
    start: StartPart = section(StartPart)
    weather: WeatherPart = section(WeatherPart)
    imu: ImuPart = section(ImuPart)
    receiver: ReceiverPart = section(ReceiverPart)
    switch: SwitchPart = section(SwitchPart)
    profile: dict[str, Any] = mapping(
        _NAME, _TEXT, "What differs from the airframe's own profile, as in config/airframe.yml."
    )
    gains: dict[str, Any] = mapping(
        _NAME, _TEXT, "What differs from the airframe's own gains, as in config/pids.yml."
    )
    raspilot: RaspilotPart = section(RaspilotPart)
    phone: PhonePart | None = section(PhonePart, optional=True)
    ground: GroundPart | None = section(GroundPart, optional=True)
    link: LinkPart = section(LinkPart)
    sticks: tuple[StickPoint, ...] = items(
        StickPoint,
        "What the pilot does. Before the first point the sticks are centred, the throttle low,"
        " the mode switch low and the arming switch down.",
    )
    events: tuple[Event, ...] = items(Event, "What happens to the aircraft and its parts.")
    expect: tuple[Expectation, ...] = items(Expectation, "What must be true of the flight.")
    control: ControlPart | None = section(ControlPart, optional=True)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield the missing keys."""
        if not self.title:
            yield "title", "must say in a few words what this flight is"
        if not self.expect:
            yield "expect", "must hold at least one expectation: what is this flight to show?"

    @property
    def is_real(self) -> bool:
        """Return whether real processes and sockets fly: in real time, not repeatable."""
        return self.raspilot.runs == "real"

    @property
    def has_raspilot(self) -> bool:
        """Return whether there is a Raspberry Pi aboard."""
        return self.raspilot.runs != "no"
