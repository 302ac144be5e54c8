"""failsafe.yml: which failure in flight makes the aircraft do what."""

from collections.abc import Iterator
from dataclasses import fields

from up.config import ConfigFile, key, mapping, section
from up.fields import Constraint
from up.quick_dataclass import dataclass

WARN = "warn"


def _action(default: str) -> str:
    comment = f"A flight mode of the Raspberry Pi, or {WARN}: an alarm only."
    return key(default, comment, max_length=16)


def _delay(default_s: float) -> float:
    comment = "How long it lasts before it counts."
    return key(default_s, comment, unit="s", minimum=0, maximum=3600)


@dataclass(frozen=True, slots=True)
class ReceiverLost:
    """The receiver is lost and the aircraft was flown by the sticks.

    The board follows only if airframe.yml permits it (receiver_lost: pi_may_fly); otherwise it
    circles. Another mode flies on.
    """

    action: str = _action("RETURN")
    delay_s: float = _delay(1.0)


@dataclass(frozen=True, slots=True)
class UplinkLost:
    """No link to a ground, after there was one, in a mode that the sticks do not fly."""

    action: str = _action("RETURN")
    delay_s: float = _delay(30.0)


@dataclass(frozen=True, slots=True)
class PhoneBattery:
    """The phone's battery is low (android.yml: low battery): with it go position and uplink."""

    action: str = _action(WARN)
    delay_s: float = _delay(20.0)


@dataclass(frozen=True, slots=True)
class FlightBatteryCritical:
    """The flight battery is below critical_v of flight_battery.yml."""

    action: str = _action("RETURN")
    delay_s: float = _delay(10.0)


@dataclass(frozen=True, slots=True)
class FlightBatteryLow:
    """The flight battery is below low_v of flight_battery.yml, not only for a burst of throttle."""

    action: str = _action(WARN)
    delay_s: float = _delay(10.0)


@dataclass(frozen=True, slots=True)
class NoProgress:
    """The aircraft comes no nearer to where it flies: the wind is stronger than its airspeed."""

    action: str = _action(WARN)
    delay_s: float = _delay(30.0)


@dataclass(frozen=True, slots=True)
class Overload:
    """The program is overloaded: its event loop is blocked again and again."""

    action: str = _action(WARN)
    delay_s: float = _delay(5.0)


@dataclass(frozen=True, slots=True)
class Other:
    """A failure that a module of an application or cog reports."""

    action: str = _action(WARN)
    delay_s: float = _delay(5.0)


@dataclass(frozen=True, slots=True)
class Fence:
    """Borders around home, in any flight at AUTO; null: none.

    They act when the present velocity would cross them within 4 s.
    """

    action: str = _action("RETURN")
    delay_s: float = _delay(0.0)
    radius_m: float | None = key(
        None, "Greatest distance from home.", unit="m", minimum=100, maximum=100_000
    )
    ceiling_m: float | None = key(
        None, "Greatest height above home.", unit="m", minimum=20, maximum=10_000
    )
    floor_m: float | None = key(
        None, "Least height above home, once the aircraft was above it.", unit="m", minimum=-1000,
        maximum=1000,
    )  # fmt: skip

    def problems(self) -> Iterator[tuple[str, str]]:
        ceiling_m, floor_m = self.ceiling_m, self.floor_m
        if ceiling_m is not None and floor_m is not None and floor_m >= ceiling_m:
            yield "floor_m", "must be below ceiling_m"


Trigger = (
    ReceiverLost
    | UplinkLost
    | FlightBatteryCritical
    | FlightBatteryLow
    | PhoneBattery
    | NoProgress
    | Overload
    | Fence
    | Other
)


@dataclass(frozen=True, slots=True)
class FailsafeConfig:
    """What the aircraft does by itself in flight at AUTO, or without the receiver.

    The first trigger of this list that holds decides. Its mode flies on when the failure is over:
    the pilot's switch or another flight mode from the ground ends it, and that trigger then waits
    until its failure was over.
    """

    flight_battery_critical: FlightBatteryCritical = section(FlightBatteryCritical)
    fence: Fence = section(Fence)
    receiver_lost: ReceiverLost = section(ReceiverLost)
    uplink_lost: UplinkLost = section(UplinkLost)
    flight_battery_low: FlightBatteryLow = section(FlightBatteryLow)
    phone_battery: PhoneBattery = section(PhoneBattery)
    no_progress: NoProgress = section(NoProgress)
    overload: Overload = section(Overload)
    others: dict[str, Other] = mapping(
        Constraint(str, max_length=32), Other, "Failures of other modules by code.", max_length=32
    )

    @property
    def triggers(self) -> dict[str, Trigger]:
        """Return the triggers by code, the one that decides first first."""
        own = [each.name for each in fields(self) if each.name != "others"]
        return {**{name: getattr(self, name) for name in own}, **self.others}

    def problems(self) -> Iterator[tuple[str, str]]:
        for each in fields(self):
            if each.name in self.others:
                yield "others", f"must not contain {each.name}, which is a key of its own"


FAILSAFE = ConfigFile("failsafe.yml", FailsafeConfig)
