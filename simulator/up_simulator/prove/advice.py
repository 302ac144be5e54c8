"""What happened in a flight, in plain words, and which settings to change."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from up_simulator.prove.cases import demands, times_of
from up_simulator.prove.flight import Outcome
from up_simulator.prove.judge import FOLLOWED, STALL_MARGIN
from up_simulator.prove.rows import Row, point_of, row_of
from up_simulator.prove.setup import Setup

RESERVE_M = 10.0


@dataclass(frozen=True, slots=True)
class Setting:
    """A value of the configuration: file, dotted key, present and proposed value (None: none)."""

    file: str
    key: str
    value: Any
    proposed: Any = None

    def __str__(self) -> str:
        value = "not set" if self.value is None else _word(self.value)
        return f"{self.file}: {self.key.replace('.', ': ')}: {value}"


@dataclass(frozen=True, slots=True)
class Advice:
    """Two settings that do not fit together here, and what to do."""

    settings: tuple[Setting, ...]
    text: str

    def __str__(self) -> str:
        return f"{' and '.join(map(str, self.settings))}: {self.text}"


def story(outcome: Outcome, setup: Setup) -> str:
    """Return what happened, in one or two sentences."""
    case, figures = outcome.case, outcome.figures
    words = [f"{_upper(row_of(case.row).about)}, {point_of(case.point).about}"]
    words += list(_wrong(outcome, setup)) or ["held"]
    if outcome.track:
        last = outcome.track[-1]
        words.append(
            f"{figures.height_lost_m:.0f} m of height lost, at most {figures.greatest_m:.0f} m from"
            f" home, {last.away_m:.0f} m away after {figures.flown_s:.0f} s"
        )
    return ". ".join(map(_upper, words)) + "."


def _wrong(outcome: Outcome, setup: Setup) -> Iterator[str]:
    case, figures, track = outcome.case, outcome.figures, outcome.track
    trigger = demands(row_of(case.row), case.point)
    fence = setup.fence
    for code, at_s in outcome.verdict.found:
        when = f"at {at_s:.0f} s"
        if code == "refused":
            yield f"the ground's Command was refused: {outcome.refusal}"
        elif code == "no_reaction":
            action = setup.trigger(trigger)["action"]
            after_s = at_s - times_of(case, setup).fail_s
            what = "did not warn" if action == "warn" else f"did not fly {action}"
            mode = next((each for each in reversed(track) if each.time_s <= at_s), track[-1])
            flew = mode.mode if mode.board_mode in FOLLOWED else f"{mode.board_mode} of the Arduino"
            yield f"the aircraft {what} within {after_s:.0f} s; it flew {flew}"
        elif code == "stall":
            least_m_s = min(each.airspeed_m_s for each in track)
            limit_m_s = setup.stall_m_s * STALL_MARGIN
            yield f"it was slow {when}: {least_m_s:.1f} m/s, the limit is {limit_m_s:.1f} m/s"
        elif code == "outside":
            far_m = figures.greatest_m - fence["radius_m"]
            yield f"it crossed the fence {when}, by {far_m:.0f} m"
        elif code == "above_ceiling":
            high_m = figures.greatest_height_m - fence["ceiling_m"]
            yield f"it crossed the fence's ceiling {when}, by {high_m:.0f} m"
        elif code == "below_floor":
            low_m = fence["floor_m"] - figures.least_height_m
            yield f"it sank below the fence's floor {when}, by {low_m:.0f} m"
        elif code == "fly_away":
            yield f"it flew away {when}: the drift is {figures.drift_m_min:.0f} m/min"
        elif code == "crash":
            yield f"it crashed {when}: {outcome.crash}"
        else:
            yield f"the flight ended early {when}: {outcome.failure}"


def advice_of(outcome: Outcome, setup: Setup) -> Advice | None:
    """Return what to change for the first thing that went wrong; None where nothing is known."""
    codes, row = outcome.verdict.codes, row_of(outcome.case.row)
    if not codes:
        return None
    is_receiver = row.begin.keys() == {"receiver"}
    if is_receiver and (advice := _without_receiver(outcome, setup)):
        return advice
    code = codes[0]
    if code == "no_reaction":
        return _no_reaction(row, setup)
    if code == "stall":
        return _slow(setup)
    if code in ("outside", "above_ceiling", "below_floor"):
        return _border(code, outcome, setup)
    if code == "fly_away":
        return _gone(outcome, setup)
    if code == "crash":
        return _low(row, outcome, setup)
    return None


def _without_receiver(outcome: Outcome, setup: Setup) -> Advice | None:
    action = Setting(
        "failsafe.yml", "receiver_lost.action", setup.trigger("receiver_lost")["action"]
    )
    permission = _setting(setup, "airframe.yml", "receiver_lost.pi_may_fly", True)
    motor = _setting(setup, "airframe.yml", "receiver_lost.return_with_motor", True)
    if not permission.value:
        drift = outcome.figures.drift_m_min
        text = (
            f"the Arduino circles with the motor off, drifts by {drift:.0f} m/min and sinks; set"
            " pi_may_fly (and return_with_motor) to true, or action to warn if you want the circle"
        )
        return Advice((action, permission), text)
    if not motor.value and not {"crash", "below_floor"}.isdisjoint(outcome.verdict.codes):
        text = "the way home is a glide with the motor off; set return_with_motor to true"
        return Advice((permission, motor), text)
    return None


def _no_reaction(row: Row, setup: Setup) -> Advice:
    trigger = row.trigger
    settings = [
        _setting(setup, "failsafe.yml", f"{trigger}.action"),
        _setting(setup, "failsafe.yml", f"{trigger}.delay_s"),
    ]
    if row.needs[:1] == ("flight_battery.yml",):
        settings[1] = _setting(setup, *row.needs)
    text = "the failure was not answered in time; decrease the delay, or select another action"
    return Advice(tuple(settings), text)


def _slow(setup: Setup) -> Advice:
    least = math.ceil(12.0 * setup.stall_m_s) / 10
    stall = _setting(setup, "navigation.yml", "airspeed.stall_m_s", setup.stall_m_s)
    minimum = _setting(setup, "navigation.yml", "airspeed.minimum_m_s")
    if stall.value < setup.stall_m_s or minimum.value < least:
        text = f"the airframe stalls at {setup.stall_m_s:g} m/s; set minimum_m_s to {least:g}"
    else:
        least = minimum.value + 1.0
        text = f"set minimum_m_s to {least:g} and cruise_m_s above it"
    minimum = Setting(minimum.file, minimum.key, minimum.value, least)
    return Advice((stall, minimum), text)


def _border(code: str, outcome: Outcome, setup: Setup) -> Advice:
    figures, fence = outcome.figures, setup.fence
    speed = _setting(setup, "navigation.yml", "airspeed.cruise_m_s")
    height = _setting(setup, "return.yml", "height_m")
    if code == "outside":
        over_m = figures.greatest_m - fence["radius_m"]
        border = _setting(setup, "failsafe.yml", "fence.radius_m")
        text = f"the turn needs {over_m:.0f} m more; set radius_m so much inside the real limit"
        return Advice((border, speed), text)
    if code == "above_ceiling":
        over_m = figures.greatest_height_m - fence["ceiling_m"]
        low_m = math.floor(fence["ceiling_m"] - over_m - RESERVE_M)
        border = _setting(setup, "failsafe.yml", "fence.ceiling_m")
        height = Setting(height.file, height.key, height.value, low_m)
        text = f"it climbs over by {over_m:.0f} m; a return height of at most {low_m} m fits"
        return Advice((height, border), text)
    under_m = fence["floor_m"] - figures.least_height_m
    high_m = math.ceil(max(height.value, fence["floor_m"]) + under_m + RESERVE_M)
    border = _setting(setup, "failsafe.yml", "fence.floor_m")
    height = Setting(height.file, height.key, height.value, high_m)
    text = (
        f"with return height {height.value:g} m and a fence floor of {border.value:g} m the aircraft"
        f" sinks {under_m:.0f} m below the floor; set height_m to {high_m} or decrease floor_m"
    )
    return Advice((height, border), text)


def _gone(outcome: Outcome, setup: Setup) -> Advice:
    case, row = outcome.case, row_of(outcome.case.row)
    speed = _setting(setup, "navigation.yml", "airspeed.maximum_m_s")
    trigger = demands(row, case.point)
    if trigger and setup.trigger(trigger)["action"] != "RETURN":
        action = _setting(setup, "failsafe.yml", f"{trigger}.action", "RETURN")
        delay = _setting(setup, "failsafe.yml", f"{trigger}.delay_s")
        return Advice((action, delay), "nothing turns the aircraft home; set action to RETURN")
    cruise = _setting(setup, "navigation.yml", "airspeed.cruise_m_s")
    wind = f"{case.wind_m_s:g} m/s"
    if case.wind_m_s > 0.7 * speed.value:
        text = f"the wind of {wind} leaves nothing to fly home with; do not fly in it"
    else:
        text = f"it does not come home against {wind}; increase cruise_m_s"
    return Advice((cruise, speed), text)


def _low(row: Row, outcome: Outcome, setup: Setup) -> Advice:
    height = _setting(setup, "return.yml", "height_m")
    lost_m = outcome.figures.height_lost_m
    high_m = math.ceil(max(height.value, lost_m) + 2 * RESERVE_M)
    height = Setting(height.file, height.key, height.value, high_m)
    if row.needs[:1] == ("flight_battery.yml",):
        limit = _setting(setup, *row.needs)
        text = f"the battery is empty before home; increase {row.needs[1]}"
        return Advice((limit, _setting(setup, "failsafe.yml", f"{row.trigger}.delay_s")), text)
    floor = _setting(setup, "failsafe.yml", "fence.floor_m")
    text = f"{lost_m:.0f} m of height were lost; fly, and return, at {high_m} m or higher"
    return Advice((height, floor), text)


def _setting(setup: Setup, file: str, key: str, proposed: Any = None) -> Setting:
    return Setting(file, key, setup.value(file, *key.split(".")), proposed)


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, int | float) else str(value)


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:]
