"""The computation of the control loop for one orientation frame, beside one bare simple-pid."""

from collections.abc import Iterable

from simple_pid import PID

from bench.table import Row, compared
from bench.timing import Limit, rounds_ns
from raspilot.flight_controller.cascade import Cascade, Pid
from up.commands.gains import Gains

AXES = 3
TARGET = 0.7
DT_S = 0.001


def update(cascades: list[Cascade]) -> None:
    for cascade in cascades:
        cascade.hold_angle(10.0, 3.0, -20.0, DT_S)


def rows(quick: bool = False) -> Iterable[Row]:
    cascades = [Cascade(Gains(2.1, 0.5, 0.01), Gains(2.0, 0.5, 0.0), 120.0) for _ in range(AXES)]
    bare = PID(2.1, 0.5, 0.01, sample_time=None, output_limits=(-400.0, 400.0))
    mine = Pid(Gains(2.1, 0.5, 0.01), 400.0)
    rounds, calls = (5, 200) if quick else (30, 5000)
    works = (
        lambda: update(cascades),
        lambda: mine.step(0.0, 3.0, DT_S),
        lambda: bare(3.0, dt=DT_S),
    )
    cascade_ns, one_ns, bare_ns = rounds_ns(works, rounds, calls)
    updates = 2 * AXES
    six_us = [updates * each / 1000 for each in bare_ns]
    yield compared(
        f"cascade of {updates} PIDs (angle and rate, three axes)",
        "us",
        [each / 1000 for each in cascade_ns],
        f"{updates} simple-pid updates",
        six_us,
        Limit(TARGET),
    )
    yield compared("one PID update, limits and anti-windup", "ns", one_ns, "simple-pid", bare_ns)
