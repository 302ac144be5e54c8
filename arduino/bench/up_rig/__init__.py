"""The bench rig: the compiled firmware on a simulated ATmega328P with all its wires.

Construct a ``Rig`` with an ELF file, set the receiver's sticks and the IMU's motion, run to a
time, read the servo pulses and the bytes. Everything is deterministic: the same calls give the
same cycles. The rig never reads the firmware's variables.
"""

from up_rig.bootloader import build_optiboot
from up_rig.errors import CrashError, FirmwareError, RigError, RigUnavailableError
from up_rig.imu import Imu, Motion
from up_rig.meter import Measures
from up_rig.pins import CHANNELS, DEFAULT, PROTOTYPE, SERVOS, PinMap
from up_rig.receiver import Receiver
from up_rig.rig import CYCLES_PER_US, Reset, Rig
from up_rig.serial import Serial
from up_rig.servo import Pulse, Servo

__all__ = [
    "CHANNELS",
    "CYCLES_PER_US",
    "DEFAULT",
    "PROTOTYPE",
    "SERVOS",
    "CrashError",
    "FirmwareError",
    "Imu",
    "Measures",
    "Motion",
    "PinMap",
    "Pulse",
    "Receiver",
    "Reset",
    "Rig",
    "RigError",
    "RigUnavailableError",
    "Serial",
    "Servo",
    "build_optiboot",
]
