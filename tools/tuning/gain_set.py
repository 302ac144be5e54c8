"""Gains as the tuning aid turns them: one axis of a set exchanged, shown as pids.yml has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

from up.commands.gains import AXES, Gains, GainSet, LoopGains

Axis = Literal["roll", "pitch", "yaw"]
CHANNELS: dict[Axis, str] = {"roll": "ailerons", "pitch": "elevator", "yaw": "rudder"}
LOOPS = ("rate", "stabilize")
_UNITS = {"rate": "1.25 us per deg/s", "stabilize": "deg/s per deg"}
ZERO = Gains(0.0)


@dataclass(frozen=True, slots=True)
class AxisGains:
    """Both loops of one axis."""

    rate: Gains
    stabilize: Gains

    def __str__(self) -> str:
        return f"rate {_short(self.rate)} stabilize {_short(self.stabilize)}"


def axis_gains(gains: GainSet, axis: Axis) -> AxisGains:
    channel = CHANNELS[axis]
    return AxisGains(
        getattr(gains.rate, channel) or ZERO, getattr(gains.stabilize, channel) or ZERO
    )


def with_axis(gains: GainSet, axis: Axis, new: AxisGains) -> GainSet:
    channel = CHANNELS[axis]
    return GainSet(
        replace(gains.rate, **{channel: new.rate}),
        replace(gains.stabilize, **{channel: new.stabilize}),
    )


def gains_of(mapping: Mapping[str, Any]) -> GainSet:
    """Return the set in a map shaped like pids.yml; missing gains are zero."""
    loops = []
    for loop in LOOPS:
        axes = mapping.get(loop, {})
        controllers = []
        for channel in AXES:
            terms = axes.get(channel, {})
            controllers.append(Gains(*(float(terms.get(term, 0.0)) for term in "pid")))
        loops.append(LoopGains(*controllers))
    return GainSet(*loops)


def mapping_of(gains: GainSet) -> dict[str, Any]:
    """Return rate and stabilize in a map shaped like pids.yml."""
    return {
        loop: {
            channel: dict(zip("pid", getattr(getattr(gains, loop), channel) or ZERO, strict=True))
            for channel in AXES
        }
        for loop in LOOPS
    }


def pids_block(gains: GainSet) -> str:
    """Return the lines of pids.yml that hold this set."""
    lines = ["units: degrees per second"]
    for loop, axes in mapping_of(gains).items():
        lines.append(f"{loop}:  # P in {_UNITS[loop]}")
        for channel, terms in axes.items():
            if (loop, channel) == ("stabilize", "rudder"):
                continue
            values = ", ".join(f"{term}: {value:g}" for term, value in terms.items())
            lines.append(f"  {channel}: {{{values}}}")
    return "\n".join(lines) + "\n"


def _short(gains: Gains) -> str:
    return "/".join(f"{value:g}" for value in ((gains.p,) if gains.i == gains.d == 0 else gains))
