"""Flights drawn at random: modes, wind, turbulence, faults of the GPS, both control loops."""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from bench.navigation_flight import Flown, fly, least_over_stall, mode_at, scenario_of
from bench.table import Row
from up.flight_modes.navigation_state import LocalFrame, Point
from up_simulator.aircraft import Weather
from up_simulator.aircraft.start import START_LATITUDE_DEG, START_LONGITUDE_DEG
from up_simulator.scenario.event import CommandPart, Event

MODES = ("CRUISE", "LOITER", "GUIDED", "RETURN", "CIRCLE")
FAULTS = ("jumped", "frozen", "lost")
TURBULENCE = ("none", "light", "moderate")
MAX_WIND_M_S = 8.0
FIRST_S, SECOND_S, RETURN_S, AGAIN_S, END_S = 4.0, 30.0, 55.0, 88.0, 130.0
"""Without a fix RETURN is refused, and a jump ends it for a time: it is selected again later."""
FAULT_S, FAULT_FOR_S = (8.0, 65.0), (2.0, 20.0)
NEAR_M = 150.0
STALL, MIN_PROGRESS_M = 1.0, 20.0


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a random flight ended; ``about`` gives the drawn values."""

    seed: int
    about: str
    crash: str | None
    least_over_stall: float
    is_gone: bool
    lost_m: float
    overruns: int


def fly_at_random(seed: int) -> Outcome:
    """Fly two modes through a fault of the GPS, then RETURN."""
    draw = random.Random(f"navigation {seed}")
    controller = ("arduino", "raspberry")[seed % 2]
    wind_m_s = draw.uniform(0.0, MAX_WIND_M_S)
    from_deg, turbulence = draw.uniform(0.0, 360.0), draw.choice(TURBULENCE)
    weather = Weather(wind_m_s=wind_m_s, wind_from_deg=from_deg, turbulence=turbulence)  # type: ignore[arg-type]
    modes = draw.choice(MODES), draw.choice(MODES)
    fault, fault_s = draw.choice(FAULTS), draw.uniform(*FAULT_S)
    for_s = draw.uniform(*FAULT_FOR_S)
    target = CommandPart("up.navigation.target", _beside(draw))
    events = (
        Event(2.0, command=target),
        mode_at(FIRST_S, modes[0]),
        Event(SECOND_S - 0.5, command=target),
        mode_at(SECOND_S, modes[1]),
        Event(fault_s, gps=fault),  # type: ignore[arg-type]
        Event(fault_s + for_s, gps="back"),
        mode_at(RETURN_S, "RETURN"),
        mode_at(AGAIN_S, "RETURN"),
    )
    flown = fly(scenario_of(seed, controller, weather, END_S, *events))
    about = (
        f"{controller}, {' then '.join(modes)}, {wind_m_s:.1f} m/s from {from_deg:.0f},"
        f" {turbulence}, GPS {fault} at {fault_s:.0f} s for {for_s:.0f} s"
    )
    return Outcome(
        seed,
        about,
        flown.crash,
        least_over_stall(flown.between(FIRST_S, END_S)),
        _is_gone(flown),
        max(0.0, flown.samples[0].truth.height_m - min(e.truth.height_m for e in flown.samples)),
        sum(code == "mode_overrun" for _, code in flown.codes),
    )


def _beside(draw: random.Random) -> dict[str, float]:
    """Return a target up to 300 m away, as high as the flight begins."""
    away_m, bearing = draw.uniform(50.0, 300.0), draw.uniform(0.0, 2.0 * math.pi)
    at = Point(away_m * math.cos(bearing), away_m * math.sin(bearing))
    latitude, longitude = LocalFrame(START_LATITUDE_DEG, START_LONGITUDE_DEG).degrees(at)
    return {"latitude": latitude, "longitude": longitude, "height": 0.0}


def _is_gone(flown: Flown) -> bool:
    """Return whether the last RETURN neither arrived nor came nearer."""
    way_m = [
        math.hypot(each.truth.north_m, each.truth.east_m)
        for each in flown.samples
        if each.time_s >= AGAIN_S
    ]
    return not way_m or (way_m[-1] > NEAR_M and way_m[-1] > way_m[0] - MIN_PROGRESS_M)


def random_rows(found: Sequence[Outcome]) -> Iterable[Row]:
    """Return the counts, with the seeds that failed, and the worst of each figure."""
    count = len(found)
    failed = {
        "crashes": [each.seed for each in found if each.crash],
        "stalls": [each.seed for each in found if each.least_over_stall < STALL],
        "fly-aways": [each.seed for each in found if each.is_gone],
        "overruns": [each.seed for each in found if each.overruns],
    }
    for what, seeds in failed.items():
        names = f" (seeds {', '.join(map(str, seeds))})" if seeds else ""
        text = f"{len(seeds)}{names}"
        yield Row(f"{count} random flights, {what}", text, target="0", met=not seeds)
    slowest = min(found, key=lambda each: each.least_over_stall)
    lowest = max(found, key=lambda each: each.lost_m)
    for what, value, worst in (
        ("least airspeed over stall", slowest.least_over_stall, slowest),
        ("greatest loss of height, m", lowest.lost_m, lowest),
    ):
        text = f"{value:.2f} (seed {worst.seed}: {worst.about})"
        yield Row(f"{count} random flights, {what}", text)
