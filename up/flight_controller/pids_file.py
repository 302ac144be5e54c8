"""pids.yml: the last saved gains, in physical units."""

from pathlib import Path

from up.commands.gains import MAX_GAIN, Gains, GainSet, LoopGains
from up.config import ConfigFile, PersistedFile, key, section
from up.errors import UserError
from up.quick_dataclass import dataclass

_RATE_UNIT = "1.25 us per deg/s"
_STABILIZE_UNIT = "deg/s per deg"


@dataclass(frozen=True, slots=True)
class Controller:
    """The gains of one PID controller."""

    p: float = key(0.0, "Proportional gain.", minimum=0, maximum=MAX_GAIN)
    i: float = key(0.0, "Integral gain.", minimum=0, maximum=MAX_GAIN)
    d: float = key(0.0, "Derivative gain.", minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class AileronsRate(Controller):
    """Roll rate."""

    p: float = key(2.0, "Proportional gain.", unit=_RATE_UNIT, minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class ElevatorRate(Controller):
    """Pitch rate."""

    p: float = key(1.5, "Proportional gain.", unit=_RATE_UNIT, minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class RudderRate(Controller):
    """Yaw rate, washed out: a damper."""

    p: float = key(1.0, "Proportional gain.", unit=_RATE_UNIT, minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class AileronsStabilize(Controller):
    """Roll angle."""

    p: float = key(8.0, "Proportional gain.", unit=_STABILIZE_UNIT, minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class ElevatorStabilize(Controller):
    """Pitch angle."""

    p: float = key(8.0, "Proportional gain.", unit=_STABILIZE_UNIT, minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class Rate:
    """The rate loop: rotation rate to servo."""

    ailerons: AileronsRate = section(AileronsRate)
    elevator: ElevatorRate = section(ElevatorRate)
    rudder: RudderRate = section(RudderRate)


@dataclass(frozen=True, slots=True)
class Stabilize:
    """The stabilize loop: angle to rotation rate."""

    ailerons: AileronsStabilize = section(AileronsStabilize)
    elevator: ElevatorStabilize = section(ElevatorStabilize)


@dataclass(frozen=True, slots=True)
class PidsConfig:
    """The gains of the flight controller, saved when the ground sets them.

    The prototype's gains counted the gyro in other units; a file without "units" is not used.
    """

    units: str = key(
        "degrees per second",
        "The units of the gains, as in these comments.",
        choices=("degrees per second",),
    )
    rate: Rate = section(Rate)
    stabilize: Stabilize = section(Stabilize)


PIDS = ConfigFile(
    "pids.yml",
    PidsConfig,
    ignored={
        "stabilize.rudder": "no controller holds a yaw angle",
        "navigation": "the numbers of the path controller are in navigation.yml",
    },
)


class PidsFile:
    """Loads and saves a GainSet; a corrupt file never stops a flight."""

    def __init__(self, folder: Path) -> None:
        self._file = PersistedFile(folder / PIDS.filename, PIDS)

    def load(self) -> tuple[GainSet, UserError | None]:
        """Return the saved set, or the last good one, or the defaults, and the reason."""
        values, problem = self._file.load()
        return gain_set_of(values), problem

    def save(self, gains: GainSet) -> None:
        """Save a set atomically; a set without a rudder keeps the saved rudder.

        Raises OSError for a failed write.
        """
        whole = gains.completed(self.load()[0])
        self._file.save(_config_of(whole))


def gain_set_of(values: PidsConfig) -> GainSet:
    """Return the gains in a configuration."""
    rate, stabilize = values.rate, values.stabilize
    return GainSet(
        LoopGains(_gains(rate.ailerons), _gains(rate.elevator), _gains(rate.rudder)),
        LoopGains(_gains(stabilize.ailerons), _gains(stabilize.elevator), Gains(0.0)),
    )


def _gains(controller: Controller) -> Gains:
    return Gains(controller.p, controller.i, controller.d)


def _config_of(gains: GainSet) -> PidsConfig:
    rate, stabilize = gains.rate, gains.stabilize
    return PidsConfig(
        rate=Rate(
            AileronsRate(*rate.ailerons),
            ElevatorRate(*rate.elevator),
            RudderRate(*(rate.rudder or Gains(0.0))),
        ),
        stabilize=Stabilize(
            AileronsStabilize(*stabilize.ailerons),
            ElevatorStabilize(*stabilize.elevator),
        ),
    )
