"""The gains of the PID controllers: per loop, per axis (thesis 3.3.2, 4.4.6)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from up.fields import Constraint
from up.quick_dataclass import dataclass

MAX_GAIN = 50.0
AXES = ("ailerons", "elevator", "rudder")
_GAIN = Constraint(float, minimum=0, maximum=MAX_GAIN)


@dataclass(frozen=True, slots=True)
class Gains:
    """The three gains of one controller: finite, 0 to 50."""

    p: float
    i: float = 0.0
    d: float = 0.0

    def __iter__(self) -> Any:
        """Iterate over P, I, D, the order of the wire."""
        return iter((self.p, self.i, self.d))


@dataclass(frozen=True, slots=True)
class LoopGains:
    """The gains of one loop on every axis; without a rudder the set is the two-axis form."""

    ailerons: Gains
    elevator: Gains
    rudder: Gains | None = None

    @property
    def axes(self) -> tuple[Gains, ...]:
        """Return the gains of the axes that the set has, in the order of the wire."""
        present = (self.ailerons, self.elevator)
        return present if self.rudder is None else (*present, self.rudder)


@dataclass(frozen=True, slots=True)
class GainSet:
    """A complete set: rate (1.25 us per deg/s), stabilize (deg/s per deg).

    No controller uses the rudder's stabilize gains; the wire has them.
    """

    rate: LoopGains
    stabilize: LoopGains

    @property
    def has_rudder(self) -> bool:
        return self.rate.rudder is not None

    def completed(self, other: GainSet) -> GainSet:
        """Return this set with a missing rudder taken from another."""
        if self.has_rudder:
            return self
        return GainSet(
            replace(self.rate, rudder=other.rate.rudder),
            replace(self.stabilize, rudder=other.stabilize.rudder),
        )


def gain_set_from_data(data: Mapping[str, Any]) -> GainSet:
    """Build a set from ``{ratePIDs, stabPIDs, navPIDs?}``; raises ValueError naming the place.

    A set is accepted or refused as a whole: a missing axis or gain, an unknown key, a number that
    is not finite or out of range refuses all of it. The result has no ``navPIDs``: no controller
    uses them.
    """
    _only(data, {"ratePIDs", "stabPIDs"}, {"navPIDs"}, "pids")
    rate = _loop(data["ratePIDs"], "ratePIDs")
    stabilize = _loop(data["stabPIDs"], "stabPIDs")
    if (rate.rudder is None) != (stabilize.rudder is None):
        raise ValueError("pids must have a rudder in both loops or in none")
    navigation_of(data)
    return GainSet(rate, stabilize)


def navigation_of(data: Mapping[str, Any]) -> LoopGains | None:
    """Return the ``navPIDs`` that a ground station of the thesis sends; raises ValueError."""
    navigation = data.get("navPIDs")
    return None if navigation is None else _loop(navigation, "navPIDs")


def gain_set_to_data(gains: GainSet) -> dict[str, Any]:
    """Return a set in the form of a PIDTuningsValuesCommand, without rounding."""
    return {"ratePIDs": _loop_data(gains.rate), "stabPIDs": _loop_data(gains.stabilize)}


def _loop(data: Any, place: str) -> LoopGains:
    _only(data, {"ailerons", "elevator"}, {"rudder"}, place)
    rudder = data.get("rudder")
    return LoopGains(
        _gains(data["ailerons"], f"{place}.ailerons"),
        _gains(data["elevator"], f"{place}.elevator"),
        None if rudder is None else _gains(rudder, f"{place}.rudder"),
    )


def _gains(data: Any, place: str) -> Gains:
    _only(data, {"p", "i", "d"}, set(), place)
    values: dict[str, float] = {}
    for key in ("p", "i", "d"):
        try:
            values[key] = _GAIN.check(data[key])
        except ValueError as error:
            raise ValueError(f"{place}.{key} {error}") from None
    return Gains(**values)


def _only(data: Any, required: set[str], optional: set[str], place: str) -> None:
    if not isinstance(data, Mapping):
        raise ValueError(f"{place} must be an object")
    missing = sorted(required - set(data))
    if missing:
        raise ValueError(f"{place}.{missing[0]} is missing")
    unknown = sorted(str(key) for key in set(data) - required - optional)
    if unknown:
        raise ValueError(f"{place}.{unknown[0]} is not known")


def _loop_data(loop: LoopGains) -> dict[str, dict[str, float]]:
    return {
        axis: {"p": gains.p, "i": gains.i, "d": gains.d}
        for axis, gains in zip(AXES, loop.axes, strict=False)
    }
