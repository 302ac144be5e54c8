"""What happened in a flight, in plain words, and which settings to change."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from up_simulator.prove.cases import demands
from up_simulator.prove.flight import Outcome
from up_simulator.prove.judge import FOLLOWED, STALL_MARGIN, WARN
from up_simulator.prove.rows import point_of, row_of
from up_simulator.prove.setup import Setup

RESERVE_M = 10.0
MAX_WIND_SHARE = 0.7


@dataclass(frozen=True, slots=True)
class Setting:
    """A value of the configuration: file, dotted key, present and proposed value (None: none)."""

    file: str
    key: str
    value: Any
    proposed: Any = None

    def __str__(self) -> str:
        word = {None: "not set", True: "true", False: "false"}.get(self.value, self.value)
        return f"{self.file}: {self.key.replace('.', ': ')}: {word}"


@dataclass(frozen=True, slots=True)
class Advice:
    """The two settings that do not fit together here, and what to do."""

    settings: tuple[Setting, Setting]
    text: str

    def __str__(self) -> str:
        return f"{' and '.join(map(str, self.settings))}: {self.text}"


def story(outcome: Outcome, setup: Setup) -> str:
    """Return what happened."""
    case, figures = outcome.case, outcome.figures
    words = [f"{row_of(case.row).about}, {point_of(case.point).about}", *_wrong(outcome, setup)]
    if outcome.track:
        words.append(
            f"{figures.height_lost_m:.0f} m of height lost, at most {figures.greatest_m:.0f} m from"
            f" home, {outcome.track[-1].away_m:.0f} m away after {figures.flown_s:.0f} s"
        )
    return "".join(f"{each[:1].upper()}{each[1:]}. " for each in words).rstrip()


def _wrong(outcome: Outcome, setup: Setup) -> Iterator[str]:
    figures, track, fence = outcome.figures, outcome.track, setup.fence
    for code, at_s in outcome.found:
        when = f"at {at_s:.0f} s"
        match code:
            case "refused":
                yield f"the ground's Command was refused {when}: {outcome.refusal}"
            case "no_reaction":
                action = setup.trigger(demands(outcome.case))["action"]
                flew = next((each for each in track if each.time_s >= at_s), track[-1])
                mode = flew.mode if flew.board_mode in FOLLOWED else f"{flew.board_mode} (Arduino)"
                yield f"{action} did not act {when}; it flew {mode}"
            case "stall":
                limit_m_s = setup.stall_m_s * STALL_MARGIN
                yield f"it was at {figures.least_m_s:.1f} m/s {when}, below {limit_m_s:.1f} m/s"
            case "outside":
                over_m = figures.greatest_m - fence["radius_m"]
                yield f"it crossed the fence {when}, by {over_m:.0f} m"
            case "above_ceiling":
                over_m = figures.highest_m - fence["ceiling_m"]
                yield f"it crossed the fence's ceiling {when}, by {over_m:.0f} m"
            case "below_floor":
                under_m = fence["floor_m"] - figures.lowest_m
                yield f"it sank below the fence's floor {when}, by {under_m:.0f} m"
            case "fly_away":
                yield f"it flew away {when}, by {figures.drift_m_min:.0f} m/min"
            case "crash":
                yield f"it crashed {when}: {outcome.crash}"
            case _:
                yield f"the flight ended early {when}: {outcome.failure}"


def advice_of(outcome: Outcome, setup: Setup) -> Advice | None:
    """Return what to change for the cause of what went wrong; None where nothing is known."""

    def of(file: str, key: str, proposed: Any = None) -> Setting:
        return Setting(file, key, setup.value(file, *key.split(".")), proposed)

    if outcome.is_held:
        return None
    case, figures, fence = outcome.case, outcome.figures, setup.fence
    row = row_of(case.row)
    code = next((each for each in outcome.codes if each != "refused"), "refused")
    height = of("return.yml", "height_m")
    minimum, cruise, maximum = (
        of("navigation.yml", f"airspeed.{name}_m_s") for name in ("minimum", "cruise", "maximum")
    )
    if "receiver" in row.begin:
        may_fly = of("airframe.yml", "receiver_lost.pi_may_fly", True)
        motor = of("airframe.yml", "receiver_lost.return_with_motor", True)
        action = of("failsafe.yml", "receiver_lost.action", "warn")
        if not may_fly.value:
            text = (
                f"the Arduino circles with the motor off, sinks and drifts by"
                f" {figures.drift_m_min:.0f} m/min; set pi_may_fly (and return_with_motor) to true,"
                " or action to warn if you want the circle"
            )
            return Advice((may_fly, action), text)
        if not motor.value and {"crash", "below_floor"} & set(outcome.codes):
            text = "the way home is a glide without motor; set return_with_motor to true"
            return Advice((may_fly, motor), text)
    if code == "no_reaction":
        delay = of("failsafe.yml", f"{row.trigger}.delay_s")
        text = "the failure is not answered in time: decrease the delay or change the action"
        return Advice((of("failsafe.yml", f"{row.trigger}.action"), delay), text)
    if code == "stall":
        least = max(math.ceil(12.0 * setup.stall_m_s) / 10, minimum.value + 0.5)
        minimum = of("navigation.yml", "airspeed.minimum_m_s", least)
        text = f"this airframe stalls at {setup.stall_m_s:g} m/s; set minimum_m_s to {least:g}"
        return Advice((of("navigation.yml", "airspeed.stall_m_s"), minimum), text)
    if row.border and setup.trigger("fence")["action"] == WARN:
        action = of("failsafe.yml", "fence.action", "RETURN")
        border = of("failsafe.yml", f"fence.{row.border}")
        return Advice((action, border), "nothing turns it round: set action to RETURN")
    if code == "outside":
        over_m = math.ceil(figures.greatest_m - fence["radius_m"])
        text = f"the turn needs {over_m} m more: set radius_m so much inside the real limit"
        return Advice((of("failsafe.yml", "fence.radius_m"), cruise), text)
    if code == "above_ceiling":
        ceiling = of("failsafe.yml", "fence.ceiling_m")
        high_m = math.floor(2 * ceiling.value - figures.highest_m - RESERVE_M)
        text = f"a return height of at most {high_m} m fits below this ceiling"
        return Advice((of("return.yml", "height_m", high_m), ceiling), text)
    if code in ("crash", "below_floor") and row.needs[:1] == ("flight_battery.yml",):
        text = f"the battery is empty before home: increase {row.needs[1]}"
        delay = of("failsafe.yml", f"{row.trigger}.delay_s")
        return Advice((of(*row.needs), delay), text)
    if code == "below_floor":
        floor = of("failsafe.yml", "fence.floor_m")
        under_m = floor.value - figures.lowest_m
        high_m = math.ceil(max(height.value, floor.value) + under_m + RESERVE_M)
        text = (
            f"with a return height of {height.value:g} m and a fence floor of {floor.value:g} m it"
            f" sinks {under_m:.0f} m below the floor: set height_m to {high_m}, or decrease floor_m"
        )
        return Advice((of("return.yml", "height_m", high_m), floor), text)
    if code == "fly_away":
        trigger = demands(case)
        if trigger and setup.trigger(trigger)["action"] != "RETURN":
            action = of("failsafe.yml", f"{trigger}.action", "RETURN")
            delay = of("failsafe.yml", f"{trigger}.delay_s")
            return Advice((action, delay), "nothing turns it home: set action to RETURN")
        text = f"it does not come home against {case.wind_m_s:g} m/s of wind: "
        is_gale = case.wind_m_s > MAX_WIND_SHARE * maximum.value
        text += "do not fly in it" if is_gale else "increase cruise_m_s"
        return Advice((cruise, maximum), text)
    if code == "crash":
        high_m = math.ceil(height.value + figures.height_lost_m + RESERVE_M)
        text = f"{figures.height_lost_m:.0f} m of height were lost: fly at {high_m} m or higher"
        high = of("return.yml", "height_m", high_m)
        return Advice((high, of("failsafe.yml", "fence.floor_m")), text)
    return None
