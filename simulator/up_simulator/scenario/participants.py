"""The aircraft's companions: the daemon, the phone and the ground station, or none."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

from up_simulator.harness.participants import CrewError, Ground, Phone, Raspilot
from up_simulator.harness.participants import Phone as PluggedPhone
from up_simulator.link.model import LinkModel
from up_simulator.phone.sensors import PhoneSensors
from up_simulator.scenario.event import Event
from up_simulator.scenario.initial_conditions import LinkPart
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.scenario import Scenario

AGAIN_S = 0.5


class Companions(Protocol):
    """The crew of a flight as a whole; a missing member stays None."""

    @property
    def raspilot(self) -> Raspilot | None:
        """Return the daemon."""

    @property
    def ground(self) -> Ground | None:
        """Return the ground station."""

    @property
    def phone(self) -> Phone | None:
        """Return the phone aboard."""

    @property
    def black_boxes(self) -> Mapping[str, bytes]:
        """Return the files, by name, that a real daemon has recorded; there once all have ended."""

    def start(self) -> None:
        """Start all members; raises CrewError."""

    def is_ready(self) -> bool:
        """Return whether the flight may begin: all expected members have connected."""

    def exchange(self, step_s: float) -> None:
        """Pass bytes and let this time go by; raises CrewError when a member has died."""

    def seconds(self) -> float:
        """Return the crew's time."""

    def carry_out(self, event: Event) -> None:
        """Carry out an event that concerns the crew; raises CrewError."""

    def stop(self) -> None:
        """End all members."""


class Nobody:
    """No Raspberry Pi: a listener on the serial line requests the board's streams."""

    raspilot: Raspilot | None = None
    ground: Ground | None = None
    phone: Phone | None = None
    black_boxes: Mapping[str, bytes] = MappingProxyType({})

    def __init__(self, board: LineBoard) -> None:
        self._board = board
        self._asked_s = -AGAIN_S

    def start(self) -> None:
        """Do nothing: no member has to start."""

    def is_ready(self) -> bool:
        """Return True: no member has to connect."""
        return True

    def exchange(self, step_s: float) -> None:
        """Listen; request again after a reset, which ends the streams."""
        board = self._board
        board.read()
        now_s = board.now_s
        is_silent = now_s - board.tap.status_s > AGAIN_S
        if is_silent and now_s - self._asked_s >= AGAIN_S:
            self._asked_s = now_s
            board.write(board.tap.start_bytes())

    def seconds(self) -> float:
        """Return the board's time."""
        return self._board.now_s

    def carry_out(self, event: Event) -> None:
        """Do nothing: no member is affected."""

    def stop(self) -> None:
        """Do nothing: no member has to end."""


PI_VETO = 1 << 4
SETTLED_S = 1.0


class Daemon(Raspilot, Protocol):
    """A daemon that can be suspended."""

    def freeze(self) -> None:
        """Stop it in its tracks."""

    def thaw(self) -> None:
        """Resume it."""


class AboardPhone(PluggedPhone, Protocol):
    """A phone whose battery and GPS can be set."""

    sensors: PhoneSensors

    def set_battery(self, percent: float) -> None:
        """Set the level of its battery."""

    def stop(self) -> None:
        """Switch it off."""


class CrewCompanions(ABC):
    """Daemon, ground station and phone of a scenario, started, disturbed and stopped.

    Subclasses make them, move their bytes and their time. ``up`` is the link from the aircraft to
    the ground, ``down`` the one back.
    """

    raspilot: Daemon
    ground: Ground | None = None
    phone: AboardPhone | None = None
    black_boxes: Mapping[str, bytes] = MappingProxyType({})

    def __init__(self, scenario: Scenario, board: LineBoard) -> None:
        self.scenario = scenario
        self.board = board
        self.up = LinkModel(seed=scenario.seed)
        self.down = LinkModel(seed=scenario.seed + 1)
        self._ready_s: float | None = None
        self._is_wanted = False

    @abstractmethod
    def seconds(self) -> float:
        """Return the crew's time."""

    @abstractmethod
    def exchange(self, step_s: float) -> None:
        """Pass bytes and let this time go by; raises CrewError when a member has died."""

    @abstractmethod
    def plug_serial(self, is_in: bool) -> None:
        """Attach or remove the serial port."""

    @abstractmethod
    def load(self, percent: float) -> None:
        """Simulate this load of the Raspberry Pi; raises CrewError where that is impossible."""

    def start(self) -> None:
        """Start the daemon, the ground station and, where it is plugged in, the phone."""
        self.raspilot.start()
        self._is_wanted = True
        self._start_others()

    def is_ready(self) -> bool:
        """Return whether all have connected, the daemon has no veto, and a second has passed."""
        if not self._has_connected():
            self._ready_s = None
            return False
        if self._ready_s is None:
            self._ready_s = self.seconds()
            self._set_up()
        return self.seconds() - self._ready_s >= SETTLED_S

    def carry_out(self, event: Event) -> None:
        """Carry out an event that concerns the crew; raises CrewError."""
        match event.kinds[0]:
            case "serial":
                self.plug_serial(event.serial == "back")
            case "phone" if self.phone is not None:
                move_cable = self.phone.plug if event.phone == "back" else self.phone.unplug
                move_cable()
            case "gps" if self.phone is not None:
                self.phone.sensors.has_gps = event.gps == "back"
            case "phone_battery" if self.phone is not None and event.phone_battery is not None:
                self.phone.set_battery(event.phone_battery)
            case "link":
                self._fail_link(event.link or "restore")
            case "link_settings" if event.link_settings is not None:
                self._set_link(event.link_settings)
            case "raspilot":
                self._command_raspilot(event.raspilot or "started")
            case "cpu_load_percent" if event.cpu_load_percent is not None:
                self.load(event.cpu_load_percent)
            case _:
                pass

    def stop(self) -> None:
        """End all members."""
        self._is_wanted = False
        if self.ground is not None:
            self.ground.stop()
        if self.phone is not None:
            self.phone.stop()
        self.end_raspilot()

    def end_raspilot(self) -> None:
        """Kill the daemon."""
        self.raspilot.kill()

    def ask_raspilot_to_stop(self) -> None:
        """Send the daemon the signal to end, and do not wait for it."""
        self.raspilot.stop()

    def look_after_raspilot(self) -> None:
        """Raise CrewError where the daemon should run and does not."""
        if self._is_wanted and not self.raspilot.is_running:
            self._is_wanted = False
            raise CrewError("the daemon has ended by itself")

    def _start_others(self) -> None:
        if self.ground is not None:
            self.ground.start()
        part = self.scenario.phone
        if self.phone is not None and part is not None:
            self.phone.set_battery(part.battery_percent)
            if part.plugged:
                self.phone.plug()

    def _has_connected(self) -> bool:
        if self.ground is not None and not self.ground.frames:
            return False
        if self.scenario.board == "direct":
            return True
        status = self.board.tap.status
        return status is not None and status.has_heard and not status.vetoes & PI_VETO

    def _set_up(self) -> None:
        """Make the initial requests; a bad link starts only now, with the flight."""
        part = self.scenario.ground
        if self.ground is not None and part is not None and part.period_ms is not None:
            self.ground.send("up.telemetry.frequency", frequency=part.period_ms)
        self._set_link(self.scenario.link)

    def _set_link(self, link: LinkPart) -> None:
        self.up.settings = link.up.settings()
        self.down.settings = link.down.settings()

    def _fail_link(self, what: str) -> None:
        for model in (self.up, self.down):
            if what == "blackout":
                model.black_out()
            elif what == "stall":
                model.stall(self.seconds())
            else:
                model.restore()
                model.resume(self.seconds())

    def _command_raspilot(self, what: str) -> None:
        if what == "hung":
            self.raspilot.freeze()
        elif what == "awake":
            self.raspilot.thaw()
        else:
            self._is_wanted = what == "started"
            end = self.raspilot.kill if what == "killed" else self.ask_raspilot_to_stop
            (self.raspilot.start if what == "started" else end)()
