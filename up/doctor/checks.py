"""The checks of a machine: what each examines, and what to do about a fault."""

import importlib.metadata
import platform
import re
import sys
from collections.abc import Callable, Iterator
from typing import Literal

from up.cogs.source_tree import normal_name
from up.doctor.machine import Machine
from up.flight_log.flights_folder import default_folder
from up.quick_dataclass import dataclass
from up.version import BUILT_S, VERSION

DISTRIBUTION = "raspilot"
MIN_FREE_BYTES = 200_000_000
LOW_FREE_BYTES = 1_000_000_000
MIN_REALTIME_PRIORITY = 20
"""As docs/install.md recommends for ``realtime priority``."""
_UARTS = ("serial0", "ttyAMA0", "ttyS0")
_PORTS = ("ttyUSB*", "ttyACM*", "ttyAMA*", "serial0")
_THROTTLED = "sys/devices/platform/soc/soc:firmware/get_throttled"
_POWER_NOW, _POWER_BEFORE = 0xF, 0xF0000
"""Bits of the firmware's get_throttled: under-voltage, capped, throttled, soft limit."""


@dataclass(frozen=True, slots=True)
class Row:
    """One finding: its subject, its state, the facts, and what to do."""

    code: str
    state: Literal["ok", "warning", "error", "not applicable"]
    text: str
    remedy: str = ""


def examine(machine: Machine) -> list[Row]:
    """Return the rows of all checks; of a Raspberry Pi's own on other machines: not applicable."""
    rows = [*_packages(), *_serial_ports(machine)]
    for code, check in (("serial_console", _serial_console), ("power", _power)):
        text = "this machine is not a Raspberry Pi"
        applies = machine.is_raspberry_pi
        rows.append(check(machine) if applies else Row(code, "not applicable", text))
    checks: tuple[Callable[[Machine], Row], ...] = (_clock, _disk, _realtime)
    return [*rows, *(check(machine) for check in checks)]


def _packages() -> Iterator[Row]:
    """Check the requirements of this version, and that the cogs have the same version."""
    text = f"Python {platform.python_version()} in {sys.prefix}, Up {VERSION}"
    yield Row("python", "ok", text)
    versions = {normal_name(each.name): each.version for each in importlib.metadata.distributions()}
    faults = []
    for each in importlib.metadata.requires(DISTRIBUTION) or [] if DISTRIBUTION in versions else []:
        found = re.match(r"([\w.-]+)\s*>=\s*([\d.]+)", each)
        if found and "extra ==" not in each:
            version = versions.get(normal_name(found[1]), "")
            if _numbers(version) < _numbers(found[2]):
                faults.append(f"{found[1]} {version or 'missing'}, needed is {found[2]}")
    ours = {name for name in versions if re.fullmatch(r"raspilot-.*cog|up-flightlog", name)}
    others = [f"{name} {versions[name]}" for name in sorted(ours) if versions[name] != VERSION]
    if DISTRIBUTION not in versions:
        text = f"{DISTRIBUTION} is not installed in {sys.prefix}"
        yield Row("packages", "error", text, f"pip install {DISTRIBUTION}")
    elif faults:
        remedy = f"pip install --upgrade {DISTRIBUTION}"
        yield Row("packages", "error", "; ".join(faults), remedy)
    elif others:
        text = f"Up is {VERSION}, but {', '.join(others)}"
        yield Row("packages", "warning", text, "install all of them in one version")
    else:
        yield Row("packages", "ok", "every required package is there")


def _serial_ports(machine: Machine) -> Iterator[Row]:
    ports = machine.devices(*_PORTS)
    if not ports:
        remedy = "plug in the board, with a cable that has data wires"
        yield Row("serial_port", "warning", "no serial port, neither USB nor UART", remedy)
    for port in ports:
        if machine.can_open(port):
            yield Row("serial_port", "ok", f"{port} can be opened")
        else:
            remedy = f"sudo adduser $USER {machine.group_of(port)}, then log out and in"
            yield Row("serial_port", "error", f"this user may not open {port}", remedy)


def _serial_console(machine: Machine) -> Row:
    consoles = re.findall(r"console=(\w+)", machine.read("proc/cmdline"))
    if not set(consoles) & set(_UARTS):
        return Row("serial_console", "ok", "no console uses the UART of the header")
    text = f"the login console uses the UART of the header ({', '.join(consoles)})"
    remedy = "raspi-config, Interface Options, Serial Port: no login shell, hardware enabled"
    return Row("serial_console", "error", text, remedy)


def _power(machine: Machine) -> Row:
    """Check the firmware's record of under-voltage and throttling since power-on."""
    said = machine.read(_THROTTLED) or machine.output(["vcgencmd", "get_throttled"])
    try:
        bits = int(said.rpartition("=")[2].removeprefix("0x"), 16)
    except ValueError:
        remedy = "install vcgencmd (raspi-utils), and add this user to the group video"
        return Row("power", "warning", "under-voltage is unknown: no vcgencmd", remedy)
    if not bits & (_POWER_NOW | _POWER_BEFORE):
        return Row("power", "ok", "neither under-voltage nor throttling since power-on")
    when = "now" if bits & _POWER_NOW else "since power-on"
    remedy = "a supply of 5.1 V and 3 A, short thick wires, and cooling"
    state: Literal["error", "warning"] = "error" if bits & _POWER_NOW else "warning"
    return Row("power", state, f"under-voltage or throttled {when} ({bits:#x})", remedy)


def _clock(machine: Machine) -> Row:
    remedy = "sudo timedatectl set-ntp true, with a network; or a GPS receiver with chrony"
    if machine.wall_clock_s() < BUILT_S:
        text = "the clock is before the day of this version: certificates are refused"
        return Row("clock", "error", text, remedy)
    if not machine.is_clock_synchronised():
        text = "the clock follows no time server: times in flight logs may be wrong"
        return Row("clock", "warning", text, remedy)
    return Row("clock", "ok", "the clock follows a time server")


def _disk(machine: Machine) -> Row:
    folder = default_folder()
    free = machine.free_bytes(folder)
    text = f"{free / 1e6:.0f} MB are free for {folder}"
    if free >= LOW_FREE_BYTES:
        return Row("disk", "ok", text)
    remedy = "delete old flights, or reduce 'total size (MB)' in black_box.yml"
    return Row("disk", "error" if free < MIN_FREE_BYTES else "warning", text, remedy)


def _realtime(machine: Machine) -> Row:
    limit = machine.realtime_limit()
    text = f"this user may set real-time priorities up to {limit}"
    if limit >= MIN_REALTIME_PRIORITY:
        return Row("realtime", "ok", text)
    remedy = "let systemd run it (raspilot.service has LimitRTPRIO=50), or raise 'ulimit -r'"
    return Row("realtime", "warning", text, remedy)


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", version)[:3])
