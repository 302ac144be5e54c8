"""Instructions take the cycles of the instruction set manual (DS40002198)."""

import itertools
import subprocess

from tests.arduino.rig.firmware import FIXTURES, make_rig
from tests.support.tools import need_tool
from up_rig.pins import pin

SBI = 2
TAKEN = [
    0, 1, 1, 2, 2, 1, 2, 2, 2, 2, 2, 2, 2, 3, 1, 2, 7, 8, 2, 3, 3, 2, 2, 2, 3, 2, 4, 9, 2, 1, 1, 2,
]  # fmt: skip


def test_every_kind_of_instruction_takes_its_cycles(tmp_path):
    compiler = need_tool("avr-gcc", "gcc-avr")
    elf = tmp_path / "cycles.elf"
    source = FIXTURES / "cycles.S"
    subprocess.run([compiler, "-mmcu=atmega328p", "-o", str(elf), str(source)], check=True)
    rig = make_rig(elf, start_up_us=100)
    rig.run_us(200)
    marks = [cycle for cycle, _level in rig.servo.pin_edges(pin("D13"))]
    took = [after - before - SBI for before, after in itertools.pairwise(marks)]
    assert took == TAKEN
