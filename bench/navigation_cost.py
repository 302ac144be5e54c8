"""What navigation costs: the estimator and the path controller, fed with a recorded flight."""

from __future__ import annotations

import statistics
from collections.abc import Iterable
from time import thread_time_ns
from typing import Any

from bench.navigation_flight import fly, mode_at, scenario_of
from bench.table import Row, figure
from raspilot.modules.navigation_estimator import NavigationEstimator
from raspilot.navigation.estimator import Estimator
from raspilot.navigation.path_controller import PathController
from up.flight_modes.demand import Circle, PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import Point
from up_simulator.aircraft import Weather
from up_simulator.in_process.raspilot import InProcessRaspilot

FLIGHT_S = 60.0
DT_S = 0.02
ROUNDS = 5
SLOWER = {"Raspberry Pi 3": 25.0, "Raspberry Pi Zero": 55.0}
"""How much longer the same Python takes there, estimated; docs/performance.md has the sources."""
TARGETS_US = {"step": 25.0, "fix": 60.0}
_STEP, _FIX = "orientation", "fix"


def cost_rows() -> Iterable[Row]:
    calls = _recorded()
    rounds = [_replayed(calls) for _ in range(ROUNDS)]
    for what in rounds[0]:
        # Other programs only add: the quietest round counts.
        median = min(statistics.median(each[what]) for each in rounds)
        each = ", ".join(f"{pi} {median * slower / 1e3:.2g} ms" for pi, slower in SLOWER.items())
        yield Row(
            f"navigation, CPU of a {what} (estimator and path control)",
            f"{figure(median, 'us')}; estimated for {each}",
            target=f"<= {TARGETS_US[what]:g} us",
            met=median <= TARGETS_US[what],
        )


def _recorded() -> list[tuple[str, tuple[Any, ...]]]:
    """Return the calls of the estimator in a flight."""
    calls: list[tuple[str, tuple[Any, ...]]] = []

    def record(daemon: InProcessRaspilot) -> None:
        module = daemon.module("NavigationEstimator")
        assert isinstance(module, NavigationEstimator)
        for name in ("orientation", "fix", "throttle", "barometer", "compass"):
            setattr(module.estimator, name, _recording(module.estimator, name, calls))

    weather = Weather(wind_m_s=6.0, wind_from_deg=0.0, turbulence="moderate")
    scenario = scenario_of(1, "arduino", weather, FLIGHT_S, mode_at(5.0, "LOITER"))
    fly(scenario, begun=record)
    return calls


def _recording(estimator: Estimator, name: str, calls: list[tuple[str, tuple[Any, ...]]]) -> Any:
    method = getattr(estimator, name)

    def call(*arguments: Any) -> Any:
        calls.append((name, arguments))
        return method(*arguments)

    return call


def _replayed(calls: list[tuple[str, tuple[Any, ...]]]) -> dict[str, list[float]]:
    """Return the CPU times, us: of a frame with its state and its attitude, and of a fix."""
    estimator, controller = Estimator(), PathController(NavigationConfig())
    demand = PathDemand(Circle(Point(0.0, 0.0), 50.0), 120.0)
    steps: list[float] = []
    fixes: list[float] = []
    for name, arguments in calls:
        method = getattr(estimator, name)
        began_ns = thread_time_ns()
        method(*arguments)
        if name == _STEP:
            state = estimator.state()
            if state is not None:
                controller.step(demand, state, DT_S)
                steps.append((thread_time_ns() - began_ns) / 1e3)
        elif name == _FIX:
            fixes.append((thread_time_ns() - began_ns) / 1e3)
    return {"step": steps, "fix": fixes}
