"""Gains on the serial line: `t`, `T` for two axes, `g`, `G` for three (docs/protocols.md 2.3)."""

from collections.abc import Iterator
from struct import Struct, error

from up.commands.gains import MAX_GAIN, Gains, GainSet, LoopGains

_F32 = Struct(">f")
_TWO_AXES = Struct(">12f")
_THREE_AXES = Struct(">18f")
TWO_AXES_SIZE = _TWO_AXES.size
THREE_AXES_SIZE = _THREE_AXES.size
_DIGITS_OF_F32 = 9


def pack_gains(gains: GainSet) -> bytes:
    """Encode a set: 72 bytes with a rudder, 48 without.

    Raises ValueError when a gain is not finite or not within 0 to 50; then nothing is sent.
    """
    values = list(_values(gains))
    if not all(0 <= value <= MAX_GAIN for value in values):
        raise ValueError(f"a gain is not within 0 to {MAX_GAIN:g}")
    form = _THREE_AXES if gains.has_rudder else _TWO_AXES
    try:
        return form.pack(*values)
    except error as problem:
        raise ValueError(f"the set of gains is not complete: {problem}") from None


def read_gains(payload: bytes) -> GainSet:
    """Return the set in 48 or 72 bytes, each gain with the fewest digits that identify it.

    Raises ValueError when a gain is not finite or not within 0 to 50.
    """
    form = _THREE_AXES if len(payload) == THREE_AXES_SIZE else _TWO_AXES
    values = form.unpack(payload)
    if not all(0 <= value <= MAX_GAIN for value in values):
        raise ValueError(f"a gain is not within 0 to {MAX_GAIN:g}")
    exact = [_shortest(value) for value in values]
    half = len(exact) // 2
    return GainSet(_loop(exact[:half]), _loop(exact[half:]))


def without_rudder(gains: GainSet) -> GainSet:
    """Return the two-axis form of a set."""
    return GainSet(
        LoopGains(gains.rate.ailerons, gains.rate.elevator),
        LoopGains(gains.stabilize.ailerons, gains.stabilize.elevator),
    )


def _values(gains: GainSet) -> Iterator[float]:
    for loop in (gains.rate, gains.stabilize):
        for axis in loop.axes:
            yield from axis


def _loop(values: list[float]) -> LoopGains:
    axes = [Gains(*values[at : at + 3]) for at in range(0, len(values), 3)]
    return LoopGains(*axes)


def _shortest(value: float) -> float:
    """Return the number with the fewest digits that equals this one in single precision.

    The wire turns 0.7 into 0.699999988: the same gain with digits that the user did not set.
    """
    wire = _F32.pack(value)
    for digits in range(1, _DIGITS_OF_F32):
        short = float(f"{value:.{digits}g}")
        if _F32.pack(short) == wire:
            return short
    return float(f"{value:.{_DIGITS_OF_F32}g}")
