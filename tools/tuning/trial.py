"""A short flight for tuning: the real firmware with gains to try, the airframe, the weather."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from tools.tuning.actuators import DisturbedFlight, Mix
from tools.tuning.gain_set import mapping_of
from up.commands.gains import GainSet
from up_rig.imu import motion_at
from up_simulator.aircraft import Airframe, Start, Weather
from up_simulator.firmware.board import BoardKind, FirmwareBoard
from up_simulator.firmware.build import choose_board
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import cached_eeprom, gains_bytes
from up_simulator.harness.world import STEP_S, World

SAMPLE_S = 0.01
START_HEIGHT_M = 900.0
BOOT_US = 1_600_000.0
ANSWER_US = 10_000.0
ANSWERS = 60
FBW_US = 1500.0
_SWITCH = {"low": "RATE", "middle": "FBW", "high": "AUTO"}
_GAINS_SIZE = 72


class TrialError(Exception):
    """A trial cannot be flown: the message is one sentence."""


@dataclass(frozen=True, slots=True)
class StickMove:
    """A stick or switch moves to a pulse at a time."""

    at_s: float
    channel: str
    pulse_us: float


@dataclass(slots=True)
class Recording:
    """The record of a trial, every 10 ms, in columns named as those of a flight's log."""

    times_s: list[float] = field(default_factory=list)
    columns: dict[str, list[float]] = field(default_factory=dict)
    crash: str | None = None

    def add(self, time_s: float, **values: float) -> None:
        self.times_s.append(time_s)
        for name, value in values.items():
            self.columns.setdefault(name, []).append(value)

    def __getitem__(self, column: str) -> list[float]:
        return self.columns[column]


class Trial:
    """A board in an airframe, in the air, level, with the gains on trial.

    The airframe's own settings are in the EEPROM; the gains go over the serial line while it is
    disarmed, as the Raspberry Pi sends them. The mode switch selects RATE, FBW and AUTO. Raises
    ``TrialError`` and the exceptions of choosing and preparing a board.
    """

    def __init__(
        self,
        airframe: Airframe,
        gains: GainSet,
        *,
        board: BoardKind = "auto",
        weather: Weather | None = None,
        seed: int = 1,
    ) -> None:
        profile = {**airframe.profile, "switch": _SWITCH}
        errors = ImuErrors(
            vibration_deg_s=airframe.imu.vibration_deg_s,
            vibration_m_s2=airframe.imu.vibration_m_s2,
        )
        eeprom = cached_eeprom(board, profile, airframe.gains)
        self.board: FirmwareBoard = choose_board(board, seed=seed, imu_errors=errors, eeprom=eeprom)
        throttle = airframe.launch.level_throttle if airframe.has_motor else 0.0
        start = Start(
            height_m=START_HEIGHT_M,
            throttle=throttle,
            **({"pitch_deg": 0.0, "climb_m_s": 0.0} if airframe.has_motor else {}),
        )
        self.dynamics = DisturbedFlight(airframe, start, weather, seed, Mix(profile))
        self.world = World(self.dynamics, self.board)
        self.board.set_stick("throttle", 1000.0)
        self.board.set_stick("aux1", FBW_US)
        self.board.set_stick("aux2", 1000.0)
        self._send(gains)
        self.world.boot(arms=airframe.has_motor)
        self.board.set_stick("throttle", 1000.0 + 1000.0 * throttle)

    def _send(self, gains: GainSet) -> None:
        tap = LineMonitor()
        self.board.set_motion(motion_at(0.0, 0.0))
        self.board.run_us(BOOT_US)
        payload = gains_bytes(mapping_of(gains), bytes(_GAINS_SIZE))
        self.board.write(tap.command_bytes("g", payload))
        for _ in range(ANSWERS):
            self.board.run_us(ANSWER_US)
            tap.feed(self.board.read(), self.board.now_us / 1e6)
            for answer in tap.take_answers():
                if answer.type == "K":
                    return
                raise TrialError("the board refuses the gains")
        raise TrialError("the board does not answer to the gains")

    def fly(
        self, duration_s: float, moves: Iterable[StickMove] = (), *, sample_s: float = SAMPLE_S
    ) -> Recording:
        """Continue with these stick moves (times of the whole flight) and return the record.

        A crash ends it. Raises ``BoardCrashedError``.
        """
        recording = Recording()
        due = sorted(moves, key=lambda move: move.at_s)
        every = round(sample_s / STEP_S)
        for step in range(round(duration_s / STEP_S)):
            time_s = self.world.time_s
            while due and due[0].at_s <= time_s + 1e-9:
                move = due.pop(0)
                self.board.set_stick(move.channel, move.pulse_us)  # type: ignore[arg-type]
            if step % every == 0:
                self._record(recording, time_s)
            self.world.step()
            if self.dynamics.crash is not None:
                recording.crash = self.dynamics.crash
                break
        return recording

    def _record(self, recording: Recording, time_s: float) -> None:
        state = self.dynamics.state
        recording.add(
            time_s,
            **{
                "truth.roll_deg": state.roll_deg,
                "truth.pitch_deg": state.pitch_deg,
                "truth.roll_rate_deg_s": state.roll_rate_deg_s,
                "truth.pitch_rate_deg_s": state.pitch_rate_deg_s,
                "truth.yaw_rate_deg_s": state.yaw_rate_deg_s,
                "truth.airspeed_m_s": state.airspeed_m_s,
            },
        )
