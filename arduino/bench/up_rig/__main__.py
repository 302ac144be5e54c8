"""The program: ``python -m up_rig FIRMWARE``."""

from __future__ import annotations

import argparse
import signal
import sys
from contextlib import suppress
from pathlib import Path

from up_rig.bootloader import build_optiboot
from up_rig.eeprom import SIZE
from up_rig.errors import FirmwareError, RigError
from up_rig.library import build_library
from up_rig.pins import DEFAULT, PROTOTYPE
from up_rig.pty_line import PtyLine
from up_rig.real_time import RealTime, rocking
from up_rig.rig import Rig
from up_rig.sticks import BEFORE, StickMove, SticksError, read_sticks

DESCRIPTION = """\
The compiled firmware of the Arduino, on a simulated ATmega328P in real time, with its serial
line on a pty: for Raspilot (arduino.yml: port) and for trying Commands by hand."""

EPILOG = """\
The pilot's sticks follow a script. By default AUX1 is high (AUTO), and AUX2 goes high after 1 s
(which arms). --sticks adds to this:
  t=SECONDS            when, since the start; holds for the words after it
  aileron=1600         also elevator, throttle, rudder, aux1, aux2: a pulse in us
  receiver=off         the receiver is lost (receiver=on: it is back)

examples:
  python -m up_rig arduino/build/raspilot.elf --pty --pty-link /tmp/board
  python -m up_rig arduino/build/raspilot.elf --pty --imu rocking --sticks "t=10 aux1=1000"
  python -m up_rig --build
      compile the rig's C part alone

Ctrl-C stops it."""


def main(arguments: list[str] | None = None) -> int:
    """Run until SIGINT or SIGTERM and return the exit status."""
    options = _read_options(arguments)
    line: PtyLine | None = None
    try:
        if options.build:
            _echo(str(build_library()))
            return 0
        rig = _make_rig(options)
        line = PtyLine(options.pty_link)
        _echo(f"board on {line.path}")
        real_time = RealTime(rig, line, [*read_sticks(BEFORE), *options.sticks], _echo)

        def end(_number: int, _frame: object) -> None:
            real_time.is_ending = True

        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, end)
        real_time.run()
        if options.eeprom is not None:
            _save(options.eeprom, rig.eeprom.read())
    except (RigError, OSError) as error:
        sys.stderr.write(f"up_rig: {error}\n")
        return 1
    finally:
        if line is not None:
            line.close()
    return 0


def _load(path: Path) -> bytes:
    """Return the content of an EEPROM file; only such a file, or a new one, is ever written."""
    if not path.exists():
        if not path.parent.is_dir():
            raise FirmwareError(f"no folder {path.parent} for the EEPROM file", "no_folder")
        return b""
    if not path.is_file() or path.stat().st_size != SIZE:
        text = f"{path} is not an EEPROM file: these have {SIZE} bytes"
        raise FirmwareError(text, "not_eeprom")
    return path.read_bytes()


def _save(path: Path, contents: bytes) -> None:
    fresh = path.with_name(path.name + ".new")
    fresh.write_bytes(contents)
    fresh.replace(path)


def _make_rig(options: argparse.Namespace) -> Rig:
    eeprom = b"" if options.eeprom is None else _load(options.eeprom)
    rig = Rig(
        options.firmware,
        bootloader=build_optiboot() if options.optiboot else None,
        eeprom=eeprom,
        pins=PROTOTYPE if options.board == "prototype" else DEFAULT,
        seed=options.seed,
        is_measuring=False,
    )
    rig.serial.set_baud(options.baud)
    if options.imu == "rocking":
        rig.imu.motion = rocking
    elif options.imu == "none":
        rig.imu.unplug()
    return rig


def _read_options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m up_rig",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("firmware", type=Path, nargs="?", metavar="FIRMWARE", help="ELF or HEX")
    parser.add_argument("--pty", action="store_true", help="put the serial line on a pty")
    parser.add_argument("--pty-link", type=Path, metavar="PATH", help="symbolic link to the pty")
    parser.add_argument("--sticks", type=_sticks, default=[], metavar="SCRIPT", help="see below")
    parser.add_argument(
        "--imu", choices=("still", "rocking", "none"), default="still", help="default %(default)s"
    )
    parser.add_argument("--eeprom", type=Path, metavar="FILE", help="kept there between runs")
    parser.add_argument("--optiboot", action="store_true", help="start through the bootloader")
    parser.add_argument(
        "--board", choices=("default", "prototype"), default="default", help="which pins"
    )
    parser.add_argument("--baud", type=_baud, default=115200, metavar="N", help="115200")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of all noise")
    parser.add_argument("--build", action="store_true", help="compile the C part and say where")
    options = parser.parse_args(arguments)
    if not options.build and options.firmware is None:
        parser.error("which FIRMWARE? (make -C arduino builds arduino/build/raspilot.elf)")
    if not options.build and not (options.pty or options.pty_link):
        parser.error("say --pty: there is nothing else to run it for from here")
    return options


def _sticks(text: str) -> list[StickMove]:
    try:
        return read_sticks(text)
    except SticksError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _baud(text: str) -> int:
    if not (text.isascii() and text.isdigit()) or not 300 <= int(text[:9]) <= 1_000_000:
        raise argparse.ArgumentTypeError(f"{text!r}: a rate is 300 to 1000000")
    return int(text)


def _echo(text: str) -> None:
    """Write one line for the user; a closed standard output is ignored."""
    with suppress(BrokenPipeError):
        sys.stdout.write(f"{text}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
