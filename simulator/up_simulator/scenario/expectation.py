"""A scenario's expectations of a signal in a part of the flight."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.config import items, key, section
from up.fields import Constraint
from up_simulator.scenario.signals import Kind, signal_of, value_problem

_NUMBER = Constraint(float)


@dataclass(frozen=True, slots=True)
class StepLimits:
    """Limits of a step response, in the terms of control engineering."""

    start: float | None = key(None, "Value before the step; null: the demand just before it.")
    end: float | None = key(None, "Demanded value; null: the demand just after the step.")
    demand: str = key(
        "", "Signal of the demand; empty: the demand.* of the signal.", max_length=100
    )
    rise_time_s: float | None = key(
        None, "Maximum time from 10 to 90 % of the step.", unit="s", minimum=0
    )
    overshoot_percent: float | None = key(
        None, "Maximum overshoot, of the height of the step.", unit="%", minimum=0
    )
    settling_time_s: float | None = key(
        None,
        "Maximum time until it stays within 5 % of the height of the step.",
        unit="s",
        minimum=0,
    )
    steady_error: float | None = key(
        None, "Maximum error at the end of the window, in the unit of the signal.", minimum=0
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if not self.limits:
            yield "rise_time_s", "sets no limit: set one of " + ", ".join(STEP_FIGURES)
        if self.demand:
            yield from _signal_problems("demand", self.demand)

    @property
    def limits(self) -> dict[str, float]:
        found = {name: getattr(self, name) for name in STEP_FIGURES}
        return {name: limit for name, limit in found.items() if limit is not None}


STEP_FIGURES = ("rise_time_s", "overshoot_percent", "settling_time_s", "steady_error")


@dataclass(frozen=True, slots=True)
class Expectation:
    """One condition of the flight, with its figure.

    The window is from ``from_s`` to ``to_s``; with ``after`` both count from that event.
    """

    name: str = key("", "A sentence: 'The bank stays within 5 degrees'.", max_length=120)
    signal: str = key("", "The signal (docs/scenarios.md lists them).", max_length=100)
    after: str = key("", "Name of an event: the window counts from it.", max_length=80)
    from_s: float = key(0.0, "Start of the window.", unit="s", minimum=0, maximum=3600)
    to_s: float | None = key(
        None, "End of the window; null: the end of the flight.", unit="s", minimum=0, maximum=3600
    )
    between: tuple[float, ...] = items(
        _NUMBER, "[lowest, highest]: it stays between them.", max_length=2
    )
    below: float | None = key(None, "Maximum. The figure is the greatest value.")
    above: float | None = key(None, "Minimum. The figure is the least value.")
    is_: str | None = key(
        None,
        "It always has this value: a text, a number, true or false.",
        name="is",
        max_length=100,
    )
    is_not: str | None = key(None, "It never has this value.", max_length=100)
    becomes: str | None = key(
        None,
        "It reaches this value within 'within_s'. The figure is the time that it took.",
        max_length=100,
    )
    becomes_below: float | None = key(None, "It falls to this value within 'within_s'.")
    becomes_above: float | None = key(None, "It rises to this value within 'within_s'.")
    settles_between: tuple[float, ...] = items(
        _NUMBER,
        "[lowest, highest]: within 'within_s' it is between them and stays there until the end of"
        " the window. The figure is the time that it took.",
        max_length=2,
    )
    within_s: float | None = key(
        None, "Maximum time of 'becomes...' and 'settles...'.", unit="s", minimum=0, maximum=3600
    )
    rms_below: float | None = key(None, "Maximum root mean square.", minimum=0)
    mean_between: tuple[float, ...] = items(
        _NUMBER, "[lowest, highest]: the mean is between them.", max_length=2
    )
    max_step: float | None = key(
        None, "Maximum change from one row (20 ms) to the next.", minimum=0
    )
    stays: float | None = key(
        None, "Maximum deviation from the value at the start of the window.", minimum=0
    )
    grows_below: float | None = key(
        None, "Maximum growth over the window (of a counter, a height)."
    )
    grows_above: float | None = key(None, "Minimum growth over the window.")
    changes_below: int | None = key(None, "Maximum number of changes.", minimum=0)
    changes_above: int | None = key(None, "Minimum number of changes.", minimum=0)
    step: StepLimits | None = section(
        StepLimits, "Limits of the response to a step at the start of the window.", optional=True
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if not self.name:
            yield "name", "must be a sentence that states the expectation"
        if self.signal:
            yield from _signal_problems("signal", self.signal)
        else:
            yield "signal", "must be the name of a signal"
        if self.to_s is not None and self.to_s <= self.from_s:
            yield "to_s", f"must be after from_s, which is {self.from_s:g}"
        kinds = self.kinds
        if not kinds:
            yield "name", "expects nothing: set one of " + ", ".join(_FILE_KINDS)
        for kind in kinds[1:]:
            other, this = _FILE_NAMES.get(kinds[0], kinds[0]), _FILE_NAMES.get(kind, kind)
            yield kind, f"'{other}' is already expected: move '{this}' to a separate expectation"
        if len(kinds) == 1:
            yield from self._kind_problems(kinds[0])

    def _kind_problems(self, kind: str) -> Iterator[tuple[str, str]]:
        if kind in PAIRS:
            pair = getattr(self, kind)
            if len(pair) != 2 or pair[0] > pair[1]:
                yield kind, "must be two numbers, the lower one first"
        if kind in TIMED and self.within_s is None:
            yield kind, "needs 'within_s': how long it may take"
        if kind not in TIMED and self.within_s is not None:
            yield "within_s", "belongs to 'becomes...' and 'settles...' only"
        try:
            signal = signal_of(self.signal)
        except KeyError:
            return
        if kind in VALUED:
            try:
                value = value_of(getattr(self, kind), signal.kind)
            except ValueError as error:
                yield kind, str(error)
                return
            if isinstance(value, str) and value and (what := value_problem(signal.name, value)):
                yield kind, what
        elif kind not in COUNTED and signal.kind is not Kind.NUMBER:
            yield kind, f"needs a number, and {signal.name} is a {signal.kind.value}: use 'is' ..."

    @property
    def kinds(self) -> list[str]:
        """Return the keys of the expectation: one, after a successful read."""
        return [kind for kind in KINDS if getattr(self, kind) not in (None, ())]

    @property
    def kind(self) -> str:
        return self.kinds[0]


PAIRS = ("between", "settles_between", "mean_between")
TIMED = ("becomes", "becomes_below", "becomes_above", "settles_between")
VALUED = ("is_", "is_not", "becomes")
COUNTED = ("changes_below", "changes_above")
_FILE_NAMES = {"is_": "is"}
_WINDOW = ("name", "signal", "after", "from_s", "to_s", "within_s")
KINDS = tuple(name for name in Expectation.__slots__ if name not in _WINDOW)
_FILE_KINDS = tuple(_FILE_NAMES.get(kind, kind) for kind in KINDS)
_TRUE, _FALSE = ("true", "yes", "on"), ("false", "no", "off")
NULLS = ("null", "~", "")


def value_of(text: str, kind: Kind) -> float | str:
    """Return the value of a text for a signal of that kind; a flag is 1.0 or 0.0.

    Raises ValueError with a sentence.
    """
    if kind is Kind.TEXT:
        return "" if text in NULLS else text
    if kind is Kind.FLAG:
        if text.lower() in _TRUE + _FALSE:
            return float(text.lower() in _TRUE)
        raise ValueError("must be true or false for this signal")
    try:
        return _NUMBER.check(float(text))  # type: ignore[no-any-return]
    except ValueError:
        raise ValueError("must be a number for this signal") from None


def _signal_problems(attribute: str, name: str) -> Iterator[tuple[str, str]]:
    try:
        signal_of(name)
    except KeyError as error:
        yield attribute, f'"{name[:60]}": {error.args[0]}'


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether an expectation held, with its figure beside the limit.

    ``code`` is the reason why it did not hold, empty if it did; ``why`` is the sentence with place
    and time. ``has_figure`` is False without a measurement, which does not count as a visible
    failure.
    """

    name: str
    is_held: bool
    figure: str
    limit: str
    why: str = ""
    has_figure: bool = True
    code: str = ""


def number_text(number: float) -> str:
    """Return a figure with its significant digits."""
    if abs(number) >= 1000 or number == int(number):
        return f"{number:.0f}"
    return f"{number:.3g}" if abs(number) < 10 else f"{number:.1f}"
