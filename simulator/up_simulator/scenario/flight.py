"""One flight of a scenario, step by step."""

from __future__ import annotations

import struct
import time
from collections.abc import Callable
from typing import cast

from up.commands.board_schema import FLIGHT_MODES
from up_flightlog.read.demand import Demand, DemandModel
from up_rig.imu import motion_at
from up_simulator.aircraft.airframe_file import ImuConfig
from up_simulator.aircraft.flight import FlightState
from up_simulator.firmware.board import BoardCrashedError, Channel, ResetCause
from up_simulator.firmware.imu_errors import ImuFault
from up_simulator.firmware.wire import Command
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.world import STEP_S, World
from up_simulator.scenario.event import Event
from up_simulator.scenario.flight_record import FlightRecord, PendingCommand
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.log import EVENT_SEPARATOR, FlightLog
from up_simulator.scenario.participants import Participants
from up_simulator.scenario.sampler import Sampler, columns_of
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import EVENT_COLUMN
from up_simulator.scenario.sticks import CHANNELS, INITIAL_US, StickTimeline

STEPS_PER_ROW = 10
READY_S = 15.0
READY_STEP_US = 20_000.0
LOG_TAIL = 20
LEAST_SPEED = 0.9
"""Times real time, below which the figures of real programs are not valid."""
_HALF_STEP_S = STEP_S / 2

_SETPOINT = struct.Struct(">hhhHH")


def setpoint_of(payload: bytes) -> Demand:
    """Return the demand in a Setpoint of the Raspberry Pi (``S`` of protocols 2.3)."""
    roll_cdeg, pitch_cdeg, *_ = _SETPOINT.unpack(payload)
    return Demand(roll_cdeg / 100, pitch_cdeg / 100)


class ScenarioFlight:
    """Boots the board, then flies: sticks, events, rows of the log.

    ``imu`` is the mounting of the airframe's IMU.
    """

    def __init__(
        self,
        scenario: Scenario,
        world: World,
        board: LineBoard,
        participants: Participants,
        demand: DemandModel,
        imu: ImuConfig,
    ) -> None:
        self._scenario = scenario
        self._world = world
        self._board = board
        self.participants = participants
        self._demand = demand
        self._imu = imu
        self._timeline = StickTimeline(scenario.sticks, scenario.switch.positions())
        self._events = sorted(scenario.events, key=lambda event: event.at_s)
        self._event_titles: list[str] = []
        self._sticks_us = dict(INITIAL_US)
        self._sticks_still_until_s = 0.0
        self._steps = 0
        self._total_steps = round(scenario.duration_s / STEP_S)
        self.record = FlightRecord(scenario, FlightLog(columns_of(scenario)))
        self.record.board_title = board.title
        self._sampler = Sampler(
            world, board, demand, participants, has_flight_computer=scenario.has_arduino
        )
        board.after_slice = participants.exchange
        board.on_command = self._on_command

    @property
    def time_s(self) -> float:
        return self._steps * STEP_S

    @property
    def state(self) -> FlightState:
        return self._world.state

    @property
    def board_mode(self) -> str:
        """Return the mode that the board reports; empty before its first report."""
        status = self._board.tap.status
        return "" if status is None else FLIGHT_MODES.get(status.mode_letter, "")

    @property
    def is_over(self) -> bool:
        record = self.record
        ended = record.crash is not None or record.failure is not None
        return ended or self._steps >= self._total_steps

    def fly(self, progress: Callable[[float], None] = lambda _time_s: None) -> FlightRecord:
        """Boot and fly to the end at full speed; Ctrl-C ends it with a partial result."""
        began_s = time.perf_counter()
        try:
            self.boot(progress)
            began_s = time.perf_counter()
            while not self.is_over:
                self.step()
                if self._steps % STEPS_PER_ROW == 0:
                    progress(self.time_s)
        except KeyboardInterrupt:
            self.record.is_interrupted = True
        finally:
            self.record.flown_s = self.time_s
            self.record.took_s = time.perf_counter() - began_s
            self._note_if_too_slow()
            self.participants.stop()
            self._world.close()
            self.record.black_boxes = self.participants.black_boxes
        return self.record

    def boot(self, progress: Callable[[float], None] = lambda _time_s: None) -> None:
        """Switch everything on, on the ground; arm if the sticks do; begin in the air."""
        wanted_us = self._timeline.pulses_us(0.0)
        is_armed = wanted_us["aux2"] > INITIAL_US["ailerons"]
        for channel in CHANNELS:
            at_rest = channel in ("throttle", "aux2")
            self._set_stick(channel, INITIAL_US[channel] if at_rest else wanted_us[channel])
        try:
            self.participants.start()
            self._wait_until_ready(progress)
            self._world.boot(arms=is_armed)
        except (BoardCrashedError, ParticipantError) as error:
            self._fail(error)
            return
        self._sticks_us["aux2"] = wanted_us["aux2"]
        self._note_if_not_armed(is_armed)
        self._move_sticks(0.0)
        self._board.take_max_pulse_age_us()
        self._dispatch_until(0.0)
        self._append_row()

    def step(self) -> None:
        """Fly for 2 ms; a row is logged every 20 ms."""
        try:
            self._world.step()
        except (BoardCrashedError, ParticipantError) as error:
            self._fail(error)
            return
        self._steps += 1
        time_s = self.time_s
        self._check_crash(time_s)
        self._poll_answers(time_s)
        self._move_sticks(time_s)
        self._dispatch_until(time_s)
        if self._steps % STEPS_PER_ROW == 0 or self.is_over:
            self._append_row()

    def _wait_until_ready(self, progress: Callable[[float], None]) -> None:
        participants, board = self.participants, self._board
        board.set_motion(motion_at(0.0, 0.0))
        waited_s = 0.0
        while not participants.is_ready():
            if waited_s >= READY_S:
                self.record.note(
                    "not_connected", f"a participant had not connected after {READY_S:g} s"
                )
                return
            board.run_us(READY_STEP_US)
            progress(0.0)
            waited_s += READY_STEP_US / 1e6

    def _note_if_not_armed(self, is_armed: bool) -> None:
        status = self._board.tap.status
        if is_armed and status is not None and not status.is_armed:
            vetoes = f"0x{status.vetoes:02X}"
            self.record.note(
                "not_armed", f"the board was not armed when the flight began (vetoes {vetoes})"
            )

    def _note_if_too_slow(self) -> None:
        record = self.record
        if record.scenario.is_real and not record.is_cut_short and record.speed < LEAST_SPEED:
            record.note(
                "not_real_time",
                "this computer was too slow to fly in real time: times and counts of the real"
                " programs are not valid",
            )

    def _on_command(self, command: Command) -> None:
        if command.type in "SR" and len(command.payload) == _SETPOINT.size:
            self._demand.setpoint = setpoint_of(command.payload)

    def _move_sticks(self, time_s: float) -> None:
        if time_s < self._sticks_still_until_s:
            return
        self._sticks_still_until_s = self._timeline.still_until_s(time_s)
        for channel in CHANNELS:
            pulse_us = self._timeline.pulse_us(channel, time_s)
            if pulse_us != self._sticks_us[channel]:
                self._set_stick(channel, pulse_us)

    def _set_stick(self, channel: str, pulse_us: float) -> None:
        self._sticks_us[channel] = pulse_us
        self._board.set_stick(channel, pulse_us)  # type: ignore[arg-type]

    def _dispatch_until(self, time_s: float) -> None:
        while self._events and self._events[0].at_s <= time_s + _HALF_STEP_S:
            event = self._events.pop(0)
            self._event_titles.append(event.title)
            self.record.event_times.setdefault(event.title, time_s)
            try:
                self._dispatch(event, time_s)
            except ParticipantError as error:
                self._fail(error)

    def _dispatch(self, event: Event, time_s: float) -> None:
        """Carry out one event: at the board and its wires, or at the participants."""
        board, scenario = self._board, self._scenario
        match event.kinds[0]:
            case "mark":
                return
            case "command":
                self._send_command(event, time_s)
            case "imu":
                board.imu.set_fault(cast(ImuFault, event.imu))
            case "imu_errors":
                assert event.imu_errors is not None
                board.imu.errors = event.imu_errors.errors(self._imu, scenario.seed)
            case "receiver" if event.receiver == "failsafe":
                board.lose_radio(scenario.receiver.failsafe_throttle_us)
            case "receiver":
                board.set_receiver(event.receiver == "back")
                board.restore_radio()
            case "channel_lost":
                board.set_channel(cast(Channel, event.channel_lost), False)
            case "channel_back":
                board.set_channel(cast(Channel, event.channel_back), True)
            case "reset":
                board.reset(cast(ResetCause, event.reset))
            case "motor":
                self._world.dynamics.motor_works = event.motor == "back"
            case "throw":
                self._world.dynamics.is_thrown = True
            case "flight_battery":
                assert event.flight_battery is not None
                self._world.dynamics.set_charge(event.flight_battery)
            case "serial_noise":
                assert event.serial_noise is not None
                board.wires.set_noise(event.serial_noise, board.now_s)
            case kind:
                if kind == "serial":
                    board.wires.is_plugged = event.serial == "back"
                self.participants.dispatch(event)

    def _send_command(self, event: Event, time_s: float) -> None:
        ground, command = self.participants.ground, event.command
        assert ground is not None and command is not None
        command_id = ground.send(command.name, **command.data)
        self.record.pending_commands.append(PendingCommand(event, command, command_id, time_s))

    def _poll_answers(self, time_s: float) -> None:
        if self.record.pending_commands and self.participants.ground is not None:
            for pending in self.record.pending_commands:
                pending.poll(self.participants.ground, time_s)

    def _check_crash(self, time_s: float) -> None:
        crash = self._world.dynamics.crash
        if crash is not None and self.record.crash is None:
            self.record.crash = crash
            self.record.crash_s = time_s
            self._event_titles.append("crash")

    def _fail(self, error: BoardCrashedError | ParticipantError) -> None:
        is_board = isinstance(error, BoardCrashedError)
        code = "board_crashed" if is_board else getattr(error, "code", "participant_failed")
        self.record.failure, self.record.failure_code = str(error), code
        if self.participants.raspilot is not None:
            self.record.failure_log = list(self.participants.raspilot.log)[-LOG_TAIL:]

    def _append_row(self) -> None:
        row = self._sampler.row(self.time_s, self._sticks_us)
        row[EVENT_COLUMN] = EVENT_SEPARATOR.join(self._event_titles)
        self._event_titles.clear()
        self.record.log.append(row)
