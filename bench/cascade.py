"""How long the flight controller on the Raspberry Pi computes one frame."""

from collections.abc import Iterable

from bench.codecs import Work, cpu_us
from bench.table import Row, print_table
from raspilot.flight_controller.cascade import Cascade, limited_pid
from up.flight_controller.gains import Gains

FRAMES = 2000
TARGET_US = 5.0
DT_S = 0.02
GAINS = Gains(2.0, 0.5, 0.01)


def cascade_work() -> Work:
    """Return three axes of two controllers each, as many as a flight can have."""
    axes = [Cascade(GAINS, GAINS, 120.0) for _ in range(3)]

    def work() -> int:
        for number in range(FRAMES):
            angle = float(number % 40 - 20)
            for axis in axes:
                axis.hold_angle(10.0, angle, 5.0, DT_S)
        return FRAMES

    return work


def pid_work() -> Work:
    """Return six bare updates of simple-pid."""
    controllers = [limited_pid(GAINS, 400.0) for _ in range(6)]

    def work() -> int:
        for number in range(FRAMES):
            angle = float(number % 40 - 20)
            for controller in controllers:
                controller(angle, dt=DT_S)
        return FRAMES

    return work


def rows() -> Iterable[Row]:
    """Measure and return the table's rows."""
    ours, six = cpu_us(cascade_work(), pid_work())
    yield Row(
        "cascade of 6 PIDs, a frame", f"{ours:.2f} us", "simple-pid, 6 updates", f"{six:.2f} us",
        f"{ours / six:.2f}x", f"<= {TARGET_US:g} us", ours <= TARGET_US,
    )  # fmt: skip


if __name__ == "__main__":
    print_table(rows())
