"""How each kind of expectation measures a window of the log.

Codes of limits that are not held: ``out_of_limits``, ``too_late``, ``never``, ``not_known``.
"""

from __future__ import annotations

import itertools
import math
import operator
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from statistics import fmean

from up_simulator.scenario.expectation import Expectation, Verdict, number_text, value_of
from up_simulator.scenario.log import Value
from up_simulator.scenario.signals import Kind, signal_of
from up_simulator.scenario.step import step_limit_text
from up_simulator.scenario.window import Window

Numbers = Sequence[float]
Found = tuple[float, int | None]
"""A figure, and the row in which it was reached, if it is that of a row."""


def _maximum(values: Numbers) -> Found:
    return max(values), values.index(max(values))


def _minimum(values: Numbers) -> Found:
    return min(values), values.index(min(values))


def _rms(values: Numbers) -> Found:
    return math.sqrt(fmean(value * value for value in values)), None


def _max_step(values: Numbers) -> Found:
    steps = [0.0, *(abs(after - before) for before, after in itertools.pairwise(values))]
    return _maximum(steps)


def _max_deviation(values: Numbers) -> Found:
    return _maximum([abs(value - values[0]) for value in values])


def _growth(values: Numbers) -> Found:
    return values[-1] - values[0], None


_AT_MOST: dict[str, Callable[[Numbers], Found]] = {
    "below": _maximum,
    "rms_below": _rms,
    "max_step": _max_step,
    "stays": _max_deviation,
    "grows_below": _growth,
}
_AT_LEAST: dict[str, Callable[[Numbers], Found]] = {"above": _minimum, "grows_above": _growth}


def _limited(expectation: Expectation, window: Window) -> Verdict:
    kind = expectation.kind
    limit = float(getattr(expectation, kind))
    value, row = (_AT_MOST.get(kind) or _AT_LEAST[kind])(window.numbers)
    is_held = value <= limit if kind in _AT_MOST else value >= limit
    return _verdict(expectation, is_held, number_text(value), _at(window, row))


def _between(expectation: Expectation, window: Window) -> Verdict:
    low, high = expectation.between
    values = window.numbers
    figure = f"{number_text(min(values))} to {number_text(max(values))}"
    worst = max(values, key=lambda value: max(low - value, value - high))
    is_held = low <= min(values) and max(values) <= high
    return _verdict(expectation, is_held, figure, _at(window, values.index(worst)))


def _mean(expectation: Expectation, window: Window) -> Verdict:
    low, high = expectation.mean_between
    mean = fmean(window.numbers)
    return _verdict(expectation, low <= mean <= high, number_text(mean))


def _changes(expectation: Expectation, window: Window) -> Verdict:
    known = [value for value in window.values if value != "" and value == value]
    count = sum(before != after for before, after in itertools.pairwise(known))
    limit = _float(getattr(expectation, expectation.kind))
    is_held = count <= limit if expectation.kind == "changes_below" else count >= limit
    return _verdict(expectation, is_held, _times(count))


def _is(expectation: Expectation, window: Window) -> Verdict:
    """Judge ``is`` and ``is_not``; the figure of a failure is the most frequent wrong value."""
    is_wanted = expectation.kind == "is_"
    value = _wanted(expectation)
    wrong = [at for at, each in enumerate(window.values) if (each == value) is not is_wanted]
    if not wrong:
        shown = _shown(expectation, window.values[0])
        return _verdict(expectation, True, f"{shown} all the time")
    share = 100 / len(window.values)
    # nan is not equal to itself; its text is.
    (shown, count), *others = Counter(
        _shown(expectation, window.values[at]) for at in wrong
    ).most_common()
    figure = f"{shown} for {share * count:.0f} % of the time"
    if others:
        figure += f", others for {share * (len(wrong) - count):.0f} %"
    first = window.values[wrong[0]]
    is_known = first != "" and first == first
    why = f"first at {window.times_s[wrong[0]]:.2f} s"
    verdict = _verdict(expectation, False, figure, why)
    return verdict if is_known else replace(verdict, has_figure=False, code="not_known")


def _becomes(expectation: Expectation, window: Window) -> Verdict:
    wanted = _wanted(expectation)
    row = window.values.index(wanted) if wanted in window.values else None
    return _timed(expectation, window, row)


def _reaches(expectation: Expectation, window: Window) -> Verdict:
    limit = _float(getattr(expectation, expectation.kind))
    is_reached = operator.le if expectation.kind == "becomes_below" else operator.ge
    rows = (
        row
        for row, value in enumerate(window.values)
        if isinstance(value, float) and is_reached(value, limit)
    )
    return _timed(expectation, window, next(rows, None))


def _settles(expectation: Expectation, window: Window) -> Verdict:
    low, high = expectation.settles_between
    outside = [at for at, value in enumerate(window.numbers) if not low <= value <= high]
    settled = outside[-1] + 1 if outside else 0
    return _timed(expectation, window, settled if settled < len(window.values) else None)


def _timed(expectation: Expectation, window: Window, row: int | None) -> Verdict:
    """Return the verdict on the time until a row; None: it was never reached."""
    if row is None:
        figure = f"never ({_shown(expectation, window.values[-1])} at the end)"
        return _verdict(expectation, False, figure, code="never")
    took_s = max(0.0, window.times_s[row] - window.begin_s)
    is_soon = took_s <= _float(expectation.within_s) + 1e-6
    return _verdict(expectation, is_soon, f"{took_s:.2f} s", code="too_late")


_Measure = Callable[[Expectation, Window], Verdict]


def _known(measure: _Measure) -> _Measure:
    def measure_known(expectation: Expectation, window: Window) -> Verdict:
        unknown_s = window.unknown_s()
        if unknown_s is None:
            return measure(expectation, window)
        return _no_figure(expectation, f"{expectation.signal} was not known at {unknown_s:.2f} s")

    return measure_known


def _known_once(measure: _Measure) -> _Measure:
    """Restrict a measure to windows in which at least one value is known."""

    def measure_known_once(expectation: Expectation, window: Window) -> Verdict:
        if any(value != "" and value == value for value in window.values):
            return measure(expectation, window)
        return _no_figure(expectation, f"{expectation.signal} was never known")

    return measure_known_once


def _no_figure(expectation: Expectation, why: str) -> Verdict:
    limit = limit_text(expectation)
    return Verdict(expectation.name, False, "none", limit, why, False, "not_known")


MEASURES: dict[str, _Measure] = {
    **dict.fromkeys((*_AT_MOST, *_AT_LEAST), _known(_limited)),
    "between": _known(_between),
    "mean_between": _known(_mean),
    "is_": _is,
    "is_not": _known(_is),
    "becomes": _becomes,
    "becomes_below": _reaches,
    "becomes_above": _reaches,
    "settles_between": _settles,
    "changes_below": _known_once(_changes),
    "changes_above": _known_once(_changes),
}


def _verdict(
    expectation: Expectation, is_held: bool, figure: str, why: str = "", code: str = "out_of_limits"
) -> Verdict:
    unit = signal_of(expectation.signal).unit if figure[-1:].isdigit() else ""
    shown, limit = f"{figure} {unit}".rstrip(), limit_text(expectation)
    if is_held:
        return Verdict(expectation.name, True, shown, limit)
    return Verdict(expectation.name, False, shown, limit, why, code=code)


def limit_text(expectation: Expectation) -> str:
    """Return the limit as shown beside the figure."""
    kind = expectation.kind
    unit = signal_of(expectation.signal).unit
    limit = getattr(expectation, kind)
    if kind in ("between", "mean_between"):
        return f"{number_text(limit[0])} to {number_text(limit[1])} {unit}".rstrip()
    if kind == "settles_between" or kind.startswith("becomes"):
        return f"within {number_text(_float(expectation.within_s))} s"
    if kind in _AT_MOST or kind in _AT_LEAST:
        bound = "at most" if kind in _AT_MOST else "at least"
        return f"{bound} {number_text(limit)} {unit}".rstrip()
    if kind.startswith("changes"):
        return f"at {'most' if kind == 'changes_below' else 'least'} {_times(limit)}"
    if kind == "step":
        return step_limit_text(limit, unit)
    return f"{'is not' if kind == 'is_not' else 'is'} {limit}"


def _at(window: Window, row: int | None) -> str:
    return "" if row is None else f"at {window.times_s[row]:.2f} s"


def _wanted(expectation: Expectation) -> Value:
    text = getattr(expectation, expectation.kind)
    return value_of(text or "", signal_of(expectation.signal).kind)


def _shown(expectation: Expectation, value: Value) -> str:
    if isinstance(value, str):
        return value or "not known"
    if math.isnan(value):
        return "not known"
    if signal_of(expectation.signal).kind is Kind.FLAG:
        return "true" if value else "false"
    return number_text(value)


def _float(value: float | None) -> float:
    assert value is not None
    return float(value)


def _times(count: float) -> str:
    return "once" if count == 1 else f"{count:g} times"
