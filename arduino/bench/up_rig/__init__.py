"""The bench rig: the compiled firmware on a simulated ATmega328P with all its wires.

Construct a ``Rig`` with an ELF file, set the receiver's sticks and the IMU's motion, run to a
time, read the servo pulses and the bytes. Everything is deterministic: the same calls give the
same cycles. The rig never reads the firmware's variables.
"""

from up_rig.bootloader import build_optiboot
from up_rig.errors import CrashError, FirmwareError, RigUnavailableError
from up_rig.imu import Motion
from up_rig.pins import CHANNELS, PROTOTYPE, SERVOS
from up_rig.rig import CYCLES_PER_US, Reset, Rig

__all__ = [
    "CHANNELS",
    "CYCLES_PER_US",
    "PROTOTYPE",
    "SERVOS",
    "CrashError",
    "FirmwareError",
    "Motion",
    "Reset",
    "Rig",
    "RigUnavailableError",
    "build_optiboot",
]
