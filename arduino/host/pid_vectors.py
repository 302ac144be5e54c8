"""Prints pid_vectors.inc: simple-pid's outputs, for the test of the firmware's PID controller.

Run it with the project's Python: python host/pid_vectors.py > host/pid_vectors.inc
"""

from __future__ import annotations

import math
import sys
from dataclasses import astuple, dataclass

from simple_pid import PID

SLOT_S = 0.002
SLOTS = 400
EVERY = 8


@dataclass(frozen=True, slots=True)
class Case:
    """Gains and limit of one controller, the bits of its inputs and how its input moves."""

    p: float
    i: float
    d: float
    limit: float
    bits: int
    wanted: float
    amplitude: float
    period_s: float


CASES = (
    Case(6.0, 0.0, 0.0, 400.0, 4, 30.0, 40.0, 0.7),
    Case(2.1, 3.5, 0.0, 400.0, 4, -20.0, 60.0, 0.4),
    Case(0.7, 0.25, 0.0, 400.0, 4, 5.0, 90.0, 0.9),
    Case(1.0, 50.0, 0.0, 400.0, 4, 3.0, 8.0, 0.3),
    Case(1.5, 0.0, 0.04, 400.0, 4, 0.0, 50.0, 0.6),
    Case(2.0, 1.0, 0.02, 400.0, 4, 10.0, 30.0, 0.8),
    Case(8.0, 0.0, 0.0, 120.0, 7, 20.0, 5.0, 0.5),
    Case(4.1, 1.2, 0.0, 80.0, 7, -4.0, 6.0, 0.7),
    Case(6.0, 0.5, 0.1, 120.0, 7, 2.0, 3.0, 0.8),
    Case(50.0, 0.0, 0.0, 400.0, 4, 100.0, 300.0, 0.5),
)


def moved(case: Case, slot: int) -> float:
    """Return the measurement of a slot as the firmware sees it, a multiple of 2^-bits."""
    one = 1 << case.bits
    now_s = slot * SLOT_S
    return round(case.amplitude * math.sin(2 * math.pi * now_s / case.period_s) * one) / one


def main() -> None:
    """Write one row a case: its values, and simple-pid's answer of every eighth slot."""
    write = sys.stdout.write
    write("// Made by pid_vectors.py: what simple-pid answers.\n")
    for case in CASES:
        pid = PID(case.p, case.i, case.d, case.wanted, None, (-case.limit, case.limit))
        answers = [pid(moved(case, slot), dt=SLOT_S) for slot in range(SLOTS)]
        write("{" + ", ".join(f"{value:g}" for value in astuple(case)) + ", {\n")
        rows = answers[EVERY - 1 :: EVERY]
        for start in range(0, len(rows), 10):
            write("    " + ", ".join(f"{value:.6g}" for value in rows[start : start + 10]) + ",\n")
        write("}},\n")


if __name__ == "__main__":
    main()
