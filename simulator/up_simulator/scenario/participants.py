"""The participants of a flight: daemon, ground station and phone, or none of them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from types import MappingProxyType

from up.commands.board_schema import Veto
from up_simulator.harness.participants import ParticipantError, Raspilot
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.mavlink_ground import MavlinkGround
from up_simulator.in_process.metrics_reader import MetricsReader
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.link.model import LinkModel
from up_simulator.radio.crsf_receiver import CrsfReceiver
from up_simulator.radio.goggles import Goggles
from up_simulator.scenario.event import Event
from up_simulator.scenario.initial_conditions import LinkPart
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.scenario import Scenario
from up_simulator.sensors.ubx_receiver import UbxReceiver

SETTLING_S = 1.0
REQUEST_INTERVAL_S = 0.5


class DaemonEndedError(ParticipantError):
    """The daemon has ended although the scenario did not end it."""

    code = "daemon_ended"


class Participants:
    """The participants as a whole; a missing one stays None.

    Here there is no Raspberry Pi: a listener on the serial line requests the board's streams.
    """

    raspilot: Raspilot | None = None
    ground: InProcessGround | None = None
    phone: InProcessPhone | None = None
    receiver: UbxReceiver | None = None
    crsf: CrsfReceiver | None = None
    goggles: Goggles | None = None
    metrics: MetricsReader | None = None
    mavlink: MavlinkGround | None = None
    black_boxes: Mapping[str, bytes] = MappingProxyType({})
    """The files, by name, that a real daemon has recorded; available after ``stop``."""

    def __init__(self, board: LineBoard) -> None:
        self.board = board
        self._requested_s = -REQUEST_INTERVAL_S

    def start(self) -> None:
        """Start all participants; raises ParticipantError."""

    def is_ready(self) -> bool:
        """Return whether the flight may begin: all expected participants have connected."""
        return True

    def exchange(self) -> None:
        """Pass bytes and advance by a step; raises ParticipantError when one has died.

        Here: listen, and request the streams again after a reset, which ends them.
        """
        board = self.board
        board.read()
        now_s = board.now_s
        is_silent = now_s - board.tap.status_s > REQUEST_INTERVAL_S
        if is_silent and now_s - self._requested_s >= REQUEST_INTERVAL_S:
            self._requested_s = now_s
            board.write(board.tap.start_bytes())

    def seconds(self) -> float:
        return self.board.now_s

    def dispatch(self, event: Event) -> None:
        """Carry out an event that concerns the participants; raises ParticipantError."""

    def stop(self) -> None:
        """Stop all participants."""


class DaemonParticipants(Participants, ABC):
    """Daemon, ground station and phone of a scenario, started, disturbed and stopped.

    Subclasses make them, move their bytes and their time. ``up`` is the link from the aircraft to
    the ground, ``down`` the one back.
    """

    raspilot: Raspilot

    def __init__(self, scenario: Scenario, board: LineBoard) -> None:
        super().__init__(board)
        self.scenario = scenario
        self.up = LinkModel(seed=scenario.seed)
        self.down = LinkModel(seed=scenario.seed + 1)
        part = scenario.gps
        self.receiver = (
            None
            if part is None
            else UbxReceiver(scenario.seed, cold_s=part.cold_s, is_exact=part.is_exact)
        )
        if scenario.goggles is not None:
            self.goggles = Goggles(*map(int, scenario.goggles.split("x")))
        self._ready_s: float | None = None
        self._should_run = False

    @abstractmethod
    def plug_serial(self, is_in: bool) -> None:
        """Attach or remove the serial port."""

    def plug_i2c(self, is_in: bool) -> None:
        """Attach or remove the sensors at the I2C bus; raises ParticipantError if impossible."""
        raise ParticipantError("sensors at the I2C bus fly only in process")

    @abstractmethod
    def plug_receiver(self, is_in: bool) -> None:
        """Attach or remove the serial port of the satellite receiver."""

    @abstractmethod
    def load(self, percent: float) -> None:
        """Simulate this load of the Raspberry Pi; raises ParticipantError if impossible."""

    def start(self) -> None:
        self.raspilot.start()
        self._should_run = True
        if self.ground is not None:
            self.ground.start()
        for each in (self.metrics, self.mavlink):
            if each is not None:
                each.start()
        part = self.scenario.phone
        if self.phone is not None and part is not None:
            self.phone.set_battery(part.battery_percent)
            if part.plugged:
                self.phone.plug()

    def is_ready(self) -> bool:
        """Return whether all have connected, the daemon has no veto, and a second has passed."""
        if not self._has_connected():
            self._ready_s = None
            return False
        if self._ready_s is None:
            self._ready_s = self.seconds()
            self._set_up()
        return self.seconds() - self._ready_s >= SETTLING_S

    def dispatch(self, event: Event) -> None:
        phone = self.phone
        match event.kinds[0]:
            case "serial":
                self.plug_serial(event.serial == "back")
            case "phone" if phone is not None:
                (phone.plug if event.phone == "back" else phone.unplug)()
            case "gps" if phone is not None:
                phone.sensors.gps = event.gps or "back"
            case "gps_receiver" if self.receiver is not None:
                if event.gps_receiver in ("unplugged", "back"):
                    self.plug_receiver(event.gps_receiver == "back")
                if event.gps_receiver != "unplugged":
                    self.receiver.set_state(event.gps_receiver or "back")
            case "crsf" if self.crsf is not None and event.crsf is not None:
                self.crsf.switch(event.crsf)
            case "mavlink" if self.mavlink is not None and event.mavlink is not None:
                self.mavlink.command(event.mavlink)
            case "i2c":
                self.plug_i2c(event.i2c == "back")
            case "phone_battery" if phone is not None and event.phone_battery is not None:
                phone.set_battery(event.phone_battery)
            case "link":
                self._fail_link(event.link or "restore")
            case "link_settings" if event.link_settings is not None:
                self._set_link(event.link_settings)
            case "raspilot":
                self._command_raspilot(event.raspilot or "started")
            case "cpu_load_percent" if event.cpu_load_percent is not None:
                self.load(event.cpu_load_percent)
            case "phone" | "gps" | "gps_receiver" | "phone_battery":
                pass  # Flown without it.
            case kind:
                raise ParticipantError(f"nothing in the simulator carries out '{kind}'")

    def stop(self) -> None:
        self._should_run = False
        if self.ground is not None:
            self.ground.stop()
        for each in (self.metrics, self.mavlink):
            if each is not None:
                each.stop()
        if self.phone is not None:
            self.phone.stop()
        self.kill_raspilot()

    def kill_raspilot(self) -> None:
        self.raspilot.kill()

    def terminate_raspilot(self) -> None:
        self.raspilot.stop()

    def check_raspilot(self) -> None:
        """Raise DaemonEndedError if the daemon should run and does not."""
        if self._should_run and not self.raspilot.is_running:
            self._should_run = False
            raise DaemonEndedError("the daemon ended unexpectedly")

    def _has_connected(self) -> bool:
        if self.ground is not None and not self.ground.frames:
            return False
        if self.mavlink is not None and self.mavlink.newest_s is None:
            return False
        if self.phone is not None and self.phone.is_plugged and not self.phone.handset.is_connected:
            return False
        if self.scenario.board == "direct":
            return True
        if self.scenario.board == "betaflight":
            return self.ground is not None and self.ground.telemetry.get("armed") is not None
        status = self.board.tap.status
        return (
            status is not None and status.is_pi_received and not status.vetoes & Veto.RASPBERRY_PI
        )

    def _set_up(self) -> None:
        """Make the initial requests; a bad link starts only now, with the flight."""
        part = self.scenario.ground
        if self.ground is not None and part is not None and part.period_ms is not None:
            self.ground.send("up.telemetry.frequency", frequency=part.period_ms)
        self._set_link(self.scenario.link)

    def _set_link(self, link: LinkPart) -> None:
        self.up.settings, self.down.settings = link.up, link.down

    def _fail_link(self, kind: str) -> None:
        for model in (self.up, self.down):
            if kind == "blackout":
                model.black_out()
            elif kind == "stall":
                model.stall()
            else:
                model.restore()
                model.resume(self.seconds())

    def _command_raspilot(self, command: str) -> None:
        if command == "hung":
            self.raspilot.freeze()
        elif command == "awake":
            self.raspilot.thaw()
        else:
            self._should_run = command == "started"
            end = self.raspilot.kill if command == "killed" else self.terminate_raspilot
            (self.raspilot.start if command == "started" else end)()
