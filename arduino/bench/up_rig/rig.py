"""The chip on its bench: load, run to a time, reset."""

from __future__ import annotations

import ctypes
import enum
import random
from pathlib import Path

from up_rig.eeprom import Eeprom
from up_rig.elf import Firmware, Symbol, read_firmware
from up_rig.errors import CrashError, FirmwareError
from up_rig.imu import Imu
from up_rig.library import Handle, load_library
from up_rig.meter import Measures, read_measures
from up_rig.pins import DEFAULT, PinMap
from up_rig.receiver import Receiver
from up_rig.serial import Serial
from up_rig.servo import Servo

CYCLES_PER_US = 16
RAM_START, RAM_SIZE = 0x100, 2048
STACK_PATTERN = 0xC5


class Reset(enum.IntFlag):
    """Causes of a reset, with the bits of MCUSR (data sheet 10.9.1)."""

    POWER_ON = 1
    EXTERNAL = 2
    BROWN_OUT = 4
    WATCHDOG = 8


class Rig:
    """One chip with a program, its receiver, servos, IMU, serial line and EEPROM.

    ``bootloader`` (HEX or ELF, see ``build_optiboot``) lies above the program and runs first, as
    with the BOOTRST fuse. ``eeprom`` is the initial content of the EEPROM, by default all 0xFF.
    ``seed`` decides every noise and the RAM's contents at power-on. ``start_up_us`` is the length
    of each reset, 66 ms with the fuses of the Nano. Without ``is_measuring`` it runs faster and
    measures neither the stack's depth nor the longest time with interrupts off. Time counts from
    the power-on, in cycles of 62.5 ns, and never stops. Raises ``FirmwareError`` and
    ``RigUnavailableError``.
    """

    def __init__(
        self,
        elf: str | Path,
        *,
        bootloader: str | Path | None = None,
        eeprom: bytes = b"",
        pins: PinMap = DEFAULT,
        seed: int = 1,
        start_up_us: float = 66_000,
        is_measuring: bool = True,
    ) -> None:
        self._library = load_library()
        self.firmware = read_firmware(Path(elf))
        boot = None if bootloader is None else read_firmware(Path(bootloader))
        self._handle = Handle(self._library, seed)
        self._random = random.Random(seed)
        self._library.rig_measure(self._handle, is_measuring)
        self._load(self.firmware)
        if boot is not None:
            self._load(boot)
            self._library.rig_reset_pc(self._handle, min(address for address, _ in boot.flash))
        self.receiver = Receiver(self._library, self._handle, pins.receiver, seed)
        self.servo = Servo(self._library, self._handle, pins.servos)
        self.imu = Imu(self._library, self._handle, seed)
        self.serial = Serial(self._library, self._handle)
        self.eeprom = Eeprom(self._library, self._handle)
        for address, part in self.firmware.eeprom:
            self.eeprom.write(address, part)
        self.eeprom.write(0, eeprom)
        self._library.rig_start_up(self._handle, round(start_up_us * CYCLES_PER_US))
        self.power_on()

    @property
    def cycle(self) -> int:
        """Return the cycles since the rig was made; resets do not touch it."""
        return int(self._library.rig_cycle(self._handle))

    @property
    def now_us(self) -> float:
        return self.cycle / CYCLES_PER_US

    def run_until_us(self, time_us: float) -> None:
        """Run to a time: to the end of the instruction that reaches it. Raises ``CrashError``."""
        self.run_until_cycle(round(time_us * CYCLES_PER_US))

    def run_us(self, duration_us: float) -> None:
        self.run_until_cycle(self.cycle + round(duration_us * CYCLES_PER_US))

    def run_until_cycle(self, cycle: int) -> None:
        """Run to a cycle. Raises ``CrashError``."""
        self.receiver.feed(cycle)
        crash = self._library.rig_run(self._handle, max(cycle, 0))
        self.imu.raise_failure()
        if crash:
            code = self._library.rig_crash_code(self._handle).decode()
            raise CrashError(f"{crash.decode()} at {self.now_us:.1f} us", code)

    def power_on(self, *, ram: bytes | None = None) -> None:
        """Switch power on: random RAM (or ``ram`` repeated), the IMU asleep, MCUSR PORF."""
        contents = self._random.randbytes(RAM_SIZE) if ram is None else ram * RAM_SIZE
        self._fill_ram(contents[:RAM_SIZE])
        self._library.rig_reset(self._handle, int(Reset.POWER_ON))

    def ram(self) -> bytes:
        """Return the content of the RAM, for a power failure that is too short to lose it."""
        data = self._library.rig_data(self._handle)
        return bytes(data[RAM_START : RAM_START + RAM_SIZE])

    def brown_out(self, *, keeps_ram: bool = True) -> None:
        """Cause a brown-out: BORF, an EEPROM write is cut, the IMU restarts."""
        if not keeps_ram:
            self._fill_ram(self._random.randbytes(RAM_SIZE))
        self._library.rig_reset(self._handle, int(Reset.BROWN_OUT))

    def press_reset(self) -> None:
        """Pull the reset pin, as the USB adapter does when its port is opened."""
        self._library.rig_reset(self._handle, int(Reset.EXTERNAL))

    def force_watchdog_reset(self) -> None:
        """Reset as the watchdog does, at this cycle."""
        self._library.rig_reset(self._handle, int(Reset.WATCHDOG))

    def set_analog(self, pin: int, volts: float) -> None:
        """Set the voltage at pin A0 to A7, 0 to 5 V, from now on."""
        self._library.rig_analog(self._handle, pin, round(volts * 1e6))

    def set_watchdog_factor(self, factor: float) -> None:
        """Make the watchdog's own oscillator ``factor`` times slower than 128 kHz."""
        self._library.rig_watchdog_factor(self._handle, factor)

    def preload(self, symbol: str, value: bytes, *, at: str = "main") -> None:
        """Write a variable once, when the program reaches the function ``at``.

        It is for states that would take too long to reach, such as a clock before its wrap.
        Raises ``FirmwareError`` for a name that the ELF file does not have.
        """
        place, start = self._symbol(symbol), self._symbol(at)
        is_inside = place.address + len(value) <= RAM_START + RAM_SIZE
        if not (place.is_data and is_inside and 0 < len(value) <= max(place.size, 1)):
            text = f"{symbol} is not a variable of {len(value)} bytes"
            raise FirmwareError(text, "not_a_variable")
        self._library.rig_preload(self._handle, start.address, place.address, value, len(value))

    def write_flash(self, address: int, code: bytes) -> None:
        """Change the program while it runs, as a cell of the flash that fails does."""
        self._library.rig_load(self._handle, code, len(code), address)

    def measures(self) -> Measures:
        """Return the measurements since the last ``clear_measures``."""
        return read_measures(self._library, self._handle)

    def clear_measures(self) -> None:
        self._library.rig_clear_measures(self._handle)

    def mark_stack(self) -> None:
        """Fill the RAM with a pattern, so that ``untouched_ram`` finds unused bytes."""
        self._fill_ram(bytes([STACK_PATTERN]) * RAM_SIZE)

    def untouched_ram(self) -> int:
        """Return the bytes between the variables and the lowest place the stack ever wrote."""
        has_heap = "__heap_start" in self.firmware.symbols
        start = self._symbol("__heap_start" if has_heap else "_end").address
        data = self._library.rig_data(self._handle)
        end = start
        while end < RAM_START + RAM_SIZE and data[end] == STACK_PATTERN:
            end += 1
        return end - start

    def _symbol(self, name: str) -> Symbol:
        try:
            return self.firmware.symbols[name]
        except KeyError:
            raise FirmwareError(f"the firmware has no symbol {name}", "no_symbol") from None

    def _load(self, firmware: Firmware) -> None:
        for address, part in firmware.flash:
            self._library.rig_load(self._handle, part, len(part), address)

    def _fill_ram(self, contents: bytes) -> None:
        data = self._library.rig_data(self._handle)
        ctypes.memmove(ctypes.byref(data.contents, RAM_START), contents, RAM_SIZE)
