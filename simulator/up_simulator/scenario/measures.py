"""How each kind of expectation measures a window of the log."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from statistics import fmean

from up_simulator.scenario.expectation import Expectation, Verdict, number_text, value_of
from up_simulator.scenario.log import Value
from up_simulator.scenario.signals import Kind, signal_of
from up_simulator.scenario.step import step_limit_text
from up_simulator.scenario.window import Window


def _between(expectation: Expectation, window: Window) -> Verdict:
    low, high = expectation.between
    values = window.numbers
    least, most = min(values), max(values)
    figure = f"{number_text(least)} to {number_text(most)}"
    worst = max(values, key=lambda value: max(low - value, value - high))
    return _verdict(expectation, low <= least and most <= high, figure, window, worst)


def _below(expectation: Expectation, window: Window) -> Verdict:
    most = max(window.numbers)
    return _verdict(expectation, most <= _float(expectation.below), _n(most), window, most)


def _above(expectation: Expectation, window: Window) -> Verdict:
    least = min(window.numbers)
    return _verdict(expectation, least >= _float(expectation.above), _n(least), window, least)


def _is(expectation: Expectation, window: Window) -> Verdict:
    wanted = _wanted(expectation, expectation.is_)
    return _first_other(expectation, window, lambda value: value == wanted)


def _is_not(expectation: Expectation, window: Window) -> Verdict:
    unwanted = _wanted(expectation, expectation.is_not)
    return _first_other(expectation, window, lambda value: value != unwanted)


def _first_other(
    expectation: Expectation, window: Window, is_right: Callable[[Value], bool]
) -> Verdict:
    wrong = [at for at, value in enumerate(window.values) if not is_right(value)]
    if not wrong:
        shown = _shown(expectation, window.values[0])
        return _verdict(expectation, True, f"{shown} all the time", window)
    share = 100 / len(window.values)
    # nan is not equal to itself; its text is.
    (shown, count), *others = Counter(
        _shown(expectation, window.values[at]) for at in wrong
    ).most_common()
    figure = f"{shown} for {share * count:.0f} % of the time"
    if others:
        figure += f", others for {share * (len(wrong) - count):.0f} %"
    verdict = _verdict(expectation, False, figure, window)
    at = wrong[0]
    is_known = window.values[at] != "" and window.values[at] == window.values[at]
    return replace(verdict, why=f"first at {window.times_s[at]:.2f} s", has_figure=is_known)


def _becomes(expectation: Expectation, window: Window) -> Verdict:
    wanted = _wanted(expectation, expectation.becomes)
    return _first_time(expectation, window, lambda value: value == wanted)


def _becomes_below(expectation: Expectation, window: Window) -> Verdict:
    limit = _float(expectation.becomes_below)
    return _first_time(
        expectation, window, lambda value: isinstance(value, float) and value <= limit
    )


def _becomes_above(expectation: Expectation, window: Window) -> Verdict:
    limit = _float(expectation.becomes_above)
    return _first_time(
        expectation, window, lambda value: isinstance(value, float) and value >= limit
    )


def _first_time(
    expectation: Expectation, window: Window, is_there: Callable[[Value], bool]
) -> Verdict:
    for time_s, value in zip(window.times_s, window.values, strict=True):
        if is_there(value):
            took_s = max(0.0, time_s - window.begin_s)
            is_soon = took_s <= _float(expectation.within_s) + 1e-6
            return _verdict(expectation, is_soon, f"{took_s:.2f} s", window)
    shown = _shown(expectation, window.values[-1])
    return _verdict(expectation, False, f"never ({shown} at the end)", window)


def _settles(expectation: Expectation, window: Window) -> Verdict:
    low, high = expectation.settles_between
    outside = [at for at, value in enumerate(window.numbers) if not low <= value <= high]
    if outside and outside[-1] == len(window.values) - 1:
        figure = f"never ({_n(window.numbers[-1])} at the end)"
        return _verdict(expectation, False, figure, window)
    took_s = window.times_s[outside[-1] + 1] - window.begin_s if outside else 0.0
    is_soon = took_s <= _float(expectation.within_s) + 1e-6
    return _verdict(expectation, is_soon, f"{took_s:.2f} s", window)


def _rms(expectation: Expectation, window: Window) -> Verdict:
    rms = math.sqrt(fmean(value * value for value in window.numbers))
    return _verdict(expectation, rms <= _float(expectation.rms_below), _n(rms), window)


def _mean(expectation: Expectation, window: Window) -> Verdict:
    low, high = expectation.mean_between
    mean = fmean(window.numbers)
    return _verdict(expectation, low <= mean <= high, _n(mean), window)


def _max_step(expectation: Expectation, window: Window) -> Verdict:
    steps = [abs(b - a) for a, b in itertools.pairwise(window.numbers)]
    most = max(steps, default=0.0)
    verdict = _verdict(expectation, most <= _float(expectation.max_step), _n(most), window)
    if verdict.is_held:
        return verdict
    return replace(verdict, why=f"at {window.times_s[steps.index(most) + 1]:.2f} s")


def _stays(expectation: Expectation, window: Window) -> Verdict:
    values = window.numbers
    away = [abs(value - values[0]) for value in values]
    most = max(away)
    verdict = _verdict(expectation, most <= _float(expectation.stays), _n(most), window)
    if verdict.is_held:
        return verdict
    return replace(verdict, why=f"at {window.times_s[away.index(most)]:.2f} s")


def _grows_below(expectation: Expectation, window: Window) -> Verdict:
    grown = window.numbers[-1] - window.numbers[0]
    return _verdict(expectation, grown <= _float(expectation.grows_below), _n(grown), window)


def _grows_above(expectation: Expectation, window: Window) -> Verdict:
    grown = window.numbers[-1] - window.numbers[0]
    return _verdict(expectation, grown >= _float(expectation.grows_above), _n(grown), window)


def _changes_below(expectation: Expectation, window: Window) -> Verdict:
    changes = _changes(window.values)
    return _verdict(
        expectation, changes <= _float(expectation.changes_below), _times(changes), window
    )


def _changes_above(expectation: Expectation, window: Window) -> Verdict:
    changes = _changes(window.values)
    return _verdict(
        expectation, changes >= _float(expectation.changes_above), _times(changes), window
    )


_Measure = Callable[[Expectation, Window], Verdict]


def _known(measure: _Measure) -> _Measure:
    """Restrict a measure to windows in which every value is known."""

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
    return Verdict(expectation.name, False, "none", limit_text(expectation), why, False)


MEASURES: dict[str, _Measure] = {
    "between": _known(_between),
    "below": _known(_below),
    "above": _known(_above),
    "is_": _is,
    "is_not": _known(_is_not),
    "becomes": _becomes,
    "becomes_below": _becomes_below,
    "becomes_above": _becomes_above,
    "settles_between": _settles,
    "rms_below": _known(_rms),
    "mean_between": _known(_mean),
    "max_step": _known(_max_step),
    "stays": _known(_stays),
    "grows_below": _known(_grows_below),
    "grows_above": _known(_grows_above),
    "changes_below": _known_once(_changes_below),
    "changes_above": _known_once(_changes_above),
}
_AT_MOST = {"below", "rms_below", "max_step", "stays", "grows_below"}
_AT_LEAST = {"above", "grows_above"}


def _verdict(
    expectation: Expectation,
    is_held: bool,
    figure: str,
    window: Window,
    worst: float | None = None,
) -> Verdict:
    why = ""
    if not is_held and worst is not None:
        why = f"at {window.times_s[window.numbers.index(worst)]:.2f} s"
    has_unit = figure[-1:].isdigit()
    unit = signal_of(expectation.signal).unit
    shown = f"{figure} {unit}".rstrip() if has_unit else figure
    return Verdict(expectation.name, is_held, shown, limit_text(expectation), why)


def limit_text(expectation: Expectation) -> str:
    """Return the limit as it reads behind the figure."""
    kind = expectation.kind
    unit = signal_of(expectation.signal).unit
    limit = getattr(expectation, kind)
    if kind in ("between", "mean_between"):
        return f"{_n(limit[0])} to {_n(limit[1])} {unit}".rstrip()
    if kind == "settles_between" or kind.startswith("becomes"):
        return f"within {_n(_float(expectation.within_s))} s"
    if kind in _AT_MOST or kind in _AT_LEAST:
        word = "at most" if kind in _AT_MOST else "at least"
        return f"{word} {_n(limit)} {unit}".rstrip()
    if kind.startswith("changes"):
        return f"at {'most' if kind == 'changes_below' else 'least'} {_times(limit)}"
    if kind == "step":
        return step_limit_text(limit, unit)
    return f"{'is not' if kind == 'is_not' else 'is'} {limit}"


def _changes(values: Sequence[Value]) -> int:
    known = [value for value in values if value not in ("",) and value == value]
    return sum(before != after for before, after in itertools.pairwise(known))


def _wanted(expectation: Expectation, text: str | None) -> Value:
    return value_of(text or "", signal_of(expectation.signal).kind)


def _shown(expectation: Expectation, value: Value) -> str:
    if isinstance(value, str):
        return value or "not known"
    if math.isnan(value):
        return "not known"
    if signal_of(expectation.signal).kind is Kind.FLAG:
        return "true" if value else "false"
    return _n(value)


def _float(value: float | None) -> float:
    assert value is not None
    return float(value)


def _times(count: float) -> str:
    return "once" if count == 1 else f"{count:g} times"


_n = number_text
