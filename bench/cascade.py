"""What the control loop computes for one orientation frame, beside one bare simple-pid."""

from collections.abc import Iterable

from simple_pid import PID

from bench.table import Row
from bench.timing import best_ns
from raspilot.flight_controller.cascade import Cascade, limited_pid
from up.flight_controller.gains import Gains

AXES = 3
TARGET_US = 5.0
# The same on every machine: 5 us where an update of simple-pid takes 632 ns.
TARGET_UPDATES = 7.9
DT_S = 0.001


def update(cascades: list[Cascade]) -> None:
    """Run two PIDs for each axis."""
    for cascade in cascades:
        cascade.hold_angle(10.0, 3.0, -20.0, DT_S)


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the cascade of three axes, and one PID."""
    cascades = [Cascade(Gains(2.1, 0.5, 0.01), Gains(2.0, 0.5, 0.0), 120.0) for _ in range(AXES)]
    bare = PID(2.1, 0.5, 0.01, sample_time=None, output_limits=(-400.0, 400.0))
    mine = limited_pid(Gains(2.1, 0.5, 0.01), 400.0)
    rounds, calls = (3, 200) if quick else (30, 5000)
    works = (
        lambda: update(cascades),
        lambda: mine(3.0, dt=DT_S),
        lambda: bare(3.0, dt=DT_S),
    )
    cascade_ns, one_ns, bare_ns = best_ns(works, rounds, calls)
    yield Row(
        f"cascade of {2 * AXES} PIDs (angle and rate, three axes)",
        f"{cascade_ns / 1000:.2f} us",
        f"{2 * AXES} simple-pid updates",
        f"{2 * AXES * bare_ns / 1000:.2f} us",
        f"{cascade_ns / (2 * AXES * bare_ns):.2f}x",
        f"<= {TARGET_US:g} us",
        cascade_ns / 1000 <= TARGET_US,
    )
    updates = cascade_ns / bare_ns
    yield Row(
        "the same, in updates of simple-pid",
        f"{updates:.1f}",
        "simple-pid",
        "1",
        f"{updates:.1f}x",
        f"<= {TARGET_UPDATES}x",
        updates <= TARGET_UPDATES,
    )
    yield Row(
        "one PID update, limits and anti-windup",
        f"{one_ns:.0f} ns",
        "simple-pid",
        f"{bare_ns:.0f} ns",
        f"{one_ns / bare_ns:.2f}x",
    )
