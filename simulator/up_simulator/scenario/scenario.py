"""A scenario: everything in the file of one flight."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from up.config import items, key, mapping, section
from up.fields import Constraint
from up_simulator.aircraft.model import ModelChoice
from up_simulator.aircraft.start import StartPart
from up_simulator.aircraft.weather import Weather
from up_simulator.scenario.event import Event
from up_simulator.scenario.expectation import Expectation
from up_simulator.scenario.initial_conditions import ImuPart, LinkPart, ReceiverPart
from up_simulator.scenario.sticks import StickPoint
from up_simulator.sensors.chips import CHIPS

_NAME = Constraint(str, max_length=128)
_TEXT = Constraint(str, max_length=4096)
BOARDS = ("auto", "firmware", "host", "direct")


@dataclass(frozen=True, slots=True)
class RaspilotPart:
    """The daemon on the Raspberry Pi."""

    runs: Literal["no", "in process", "real"] = key(
        "no",
        "no: the Arduino flies alone. in process: the whole daemon inside the simulator, at full"
        " speed and repeatable. real: a separate process on a pty, in real time.",
    )
    config: dict[str, dict[str, Any]] = mapping(
        _NAME, _TEXT, "Configuration by file: differences from the defaults (config/*.yml)."
    )


@dataclass(frozen=True, slots=True)
class PhonePart:
    """The airborne phone: GPS, barometer, battery, and the orientation for Black Box Mode."""

    plugged: bool = key(True, "Whether it is plugged in at the start of the flight.")
    orientation: Literal["off", "tcp", "udp"] = key(
        "off", "How it sends its own orientation, 50 times a second."
    )
    battery_percent: float = key(100.0, "Battery level.", unit="%", minimum=0, maximum=100)


@dataclass(frozen=True, slots=True)
class GpsPart:
    """A u-blox receiver at a serial port of the Raspberry Pi, which gps.yml then names."""

    rate_hz: int = key(10, "Fixes that it is set to.", unit="Hz", minimum=1, maximum=10)
    cold_s: float = key(0.0, "Time without a fix at first.", unit="s", minimum=0, maximum=600)
    is_exact: bool = key(False, "Whether it has no error.", name="exact")


@dataclass(frozen=True, slots=True)
class GroundPart:
    """The ground station."""

    role: Literal["observer", "operator", "pilot", "admin"] = key(
        "pilot", "Role of its link (mission_control.yml)."
    )
    period_ms: int | None = key(
        None, "Requested telemetry period.", unit="ms", minimum=20, maximum=10_000
    )
    through: Literal["listener", "proxy", "two paths", "runner"] = key(
        "listener",
        "listener: the port of Raspilot. proxy: the relay between the two. two paths: the proxy in"
        " a network that the aircraft reaches by two interfaces, which needs root. runner: the"
        " proxy, and the phone requests Raspilot from the runner. All but the first are real"
        " programs.",
    )


@dataclass(frozen=True, slots=True)
class SwitchPart:
    """Modes that the positions of AUX1 select."""

    low: Literal["ACRO", "RATE", "FBW", "AUTO"] = key("ACRO", "Below 1300 us.", ignore_case=True)
    middle: Literal["ACRO", "RATE", "FBW", "AUTO"] = key("FBW", "Between.", ignore_case=True)
    high: Literal["ACRO", "RATE", "FBW", "AUTO"] = key("AUTO", "Above 1700 us.", ignore_case=True)

    def positions(self) -> dict[str, str]:
        return {"low": self.low, "middle": self.middle, "high": self.high}


@dataclass(frozen=True, slots=True)
class ControlPart:
    """The same flight with the tested behaviour disabled: it must visibly fail."""

    about: str = key(
        "", "The disabled behaviour, for the report: 'no stabilisation'.", max_length=200
    )
    mode: Literal["ACRO", "RATE", "FBW", "AUTO"] | None = key(
        None, "The mode switch keeps this mode for the whole flight.", ignore_case=True
    )
    board: Literal["auto", "firmware", "host", "direct"] | None = key(
        None, "Another board; direct connects the receiver directly to the servos."
    )
    fails: tuple[str, ...] = items(
        _TEXT, "Names of the expectations that must fail then.", max_length=100
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.mode is None and self.board is None:
            yield "about", "disables nothing: set 'mode' or 'board'"
        if not self.fails:
            yield "fails", "must name the expectations that fail in the control run"


_ARDUINOS = frozenset(
    ("imu", "imu_errors", "channel_lost", "channel_back", "reset", "serial", "serial_noise",
     "flight_battery")
)  # fmt: skip
"""Events that nothing of a Betaflight board carries out."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """One flight: its initial state, its events, its expectations."""

    title: str = key("", "Short title, for lists and pictures.", max_length=100)
    about: str = key("", "Purpose, in one or two sentences.", max_length=2000)
    guards: str = key("", "The rule that it guards: without the rule it fails.", max_length=200)
    tags: tuple[str, ...] = items(
        Constraint(str, max_length=40), "Tags, for the selection of scenarios.", max_length=20
    )
    airframe: str = key(
        "glider",
        "The aircraft: glider, wing, or an airframe.yml or its folder, from here or beside the"
        " scenario.",
        max_length=4096,
    )
    seed: int = key(1, "Seed of turbulence and all noise.", minimum=0, maximum=2**31 - 1)
    duration_s: float = key(30.0, "Duration of the flight.", unit="s", minimum=0.1, maximum=3600)
    board: Literal["auto", "firmware", "host", "direct", "betaflight"] = key(
        "auto",
        "The flight computer. firmware: the compiled firmware on a simulated ATmega328P. host: the"
        " same source compiled for this machine. auto: firmware if it can be built, otherwise host."
        " direct: no flight computer, the receiver is connected to the servos. betaflight:"
        " Betaflight's own program, betaflight_SITL on the search path.",
    )
    model: ModelChoice = key(
        "auto",
        "The flight model. auto: JSBSim where it is installed, otherwise the built-in one.",
    )
    eeprom: Literal["prepared", "blank", "spoiled"] = key(
        "prepared",
        "EEPROM at power-on. prepared: the profile and gains of the airframe. blank: a"
        " new chip. spoiled: wrong bits everywhere.",
    )
    may_crash: bool = key(False, "Whether a crash is permitted.")
    may_land: bool = key(
        False,
        "Whether a soft contact with the ground is a landing: at most 3 m/s of sink, 20 degrees of"
        " bank and of pitch. The aircraft then slides and stops.",
    )
    start: StartPart = section(StartPart)
    weather: Weather = section(Weather)
    imu: ImuPart = section(ImuPart)
    receiver: ReceiverPart = section(ReceiverPart)
    switch: SwitchPart = section(SwitchPart)
    profile: dict[str, Any] = mapping(
        _NAME, _TEXT, "Differences from the profile of the airframe, as in config/airframe.yml."
    )
    gains: dict[str, Any] = mapping(
        _NAME, _TEXT, "Differences from the gains of the airframe, as in config/pids.yml."
    )
    raspilot: RaspilotPart = section(RaspilotPart)
    phone: PhonePart | None = section(PhonePart, optional=True)
    gps: GpsPart | None = section(GpsPart, optional=True)
    crsf: tuple[str, ...] = items(
        Constraint(str, max_length=32),
        "A CRSF receiver at the Raspberry Pi, which crsf.yml then names: the flight modes of its"
        " switch at low, middle, high; an empty name selects nothing. In process only.",
        max_length=3,
    )
    sensors: tuple[str, ...] = items(
        Constraint(str, choices=tuple(CHIPS)),
        "Chips at the I2C bus of the Raspberry Pi, which sensors.yml then names; in process only.",
        max_length=8,
    )
    goggles: Literal["30x16", "50x18", "53x20"] | None = key(
        None, "Goggles at a serial port of the Raspberry Pi, which osd.yml then names; their grid."
    )
    metrics: bool = key(
        False, "Whether the metrics of the daemon (metrics.yml) are read every second."
    )
    mavlink: bool = key(
        False, "Whether a ground station that speaks MAVLink is connected by TCP, as an operator."
    )
    ground: GroundPart | None = section(GroundPart, optional=True)
    link: LinkPart = section(LinkPart)
    sticks: tuple[StickPoint, ...] = items(
        StickPoint,
        "The moves of the pilot. Before the first one the sticks are centred, the throttle low,"
        " the mode switch low and the arming switch down.",
    )
    events: tuple[Event, ...] = items(Event, "Events at the aircraft and its parts.")
    expect: tuple[Expectation, ...] = items(Expectation, "Conditions of the flight.")
    control: ControlPart | None = section(ControlPart, optional=True)

    def problems(self) -> Iterator[tuple[str, str]]:
        if not self.title:
            yield "title", "must be a short title of the flight"
        if self.board == "betaflight" and not (self.is_real and self.ground):
            yield "board", "betaflight needs 'raspilot: {runs: real}' and a ground"
        if self.board == "betaflight" and (self.profile or self.gains):
            yield "board", "profile and gains are the Arduino's: betaflight has other settings"
        if self.board == "betaflight":
            for kind in sorted({each.kinds[0] for each in self.events if each.kinds} & _ARDUINOS):
                yield "events", f"betaflight has no {kind}: it is an event of the Arduino alone"
        for name in ("crsf", "sensors"):
            if getattr(self, name) and self.is_real:
                yield name, "fly only with 'runs: in process'"
        for name in ("goggles", "metrics", "mavlink"):
            if getattr(self, name) and not self.has_raspilot:
                yield name, "needs a Raspberry Pi: add 'raspilot: {runs: in process}'"
            if getattr(self, name) and self.through == "runner":
                yield name, "no runner has it: use 'ground: {through: proxy}'"
        if self.through == "two paths" and self.link != LinkPart():
            yield "link", "the two paths are no simulated link: use the event 'path: cut'"
        if not self.expect:
            yield "expect", "must contain at least one expectation"

    @property
    def through(self) -> str:
        """Return what the ground station is connected to; without one the listener."""
        return "listener" if self.ground is None else self.ground.through

    @property
    def has_arduino(self) -> bool:
        """Return whether our firmware flies, with its serial line."""
        return self.board not in ("direct", "betaflight")

    @property
    def is_real(self) -> bool:
        """Return whether real processes and sockets fly: in real time, not repeatable."""
        return self.raspilot.runs == "real"

    @property
    def has_raspilot(self) -> bool:
        return self.raspilot.runs != "no"
