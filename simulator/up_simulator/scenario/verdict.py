"""Result of one expectation."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether it held, with its figure beside the limit; ``why`` adds where and when it did not.

    ``has_figure`` is False without a measurement, which does not count as a visible failure.
    """

    name: str
    is_held: bool
    figure: str
    limit: str
    why: str = ""
    has_figure: bool = True


def number_text(number: float) -> str:
    """Return a figure with its significant digits."""
    if abs(number) >= 1000 or number == int(number):
        return f"{number:.0f}"
    return f"{number:.3g}" if abs(number) < 10 else f"{number:.1f}"
