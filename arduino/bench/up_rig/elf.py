"""Reads the output of avr-gcc: ELF files with their symbols, and Intel HEX."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from pathlib import Path

from up_rig.errors import FirmwareError

FLASH_SIZE = 32768
_DATA_SPACE = 0x800000
_EEPROM_SPACE = 0x810000
_AVR = 83
_LOAD, _SYMBOLS = 1, 2


@dataclass(frozen=True, slots=True)
class Symbol:
    """A name of the program: its address in its own space, and its size in bytes."""

    address: int
    size: int
    is_data: bool


@dataclass(frozen=True, slots=True)
class Firmware:
    """A program: (address, bytes) for the flash and for the EEPROM, and its symbols."""

    flash: list[tuple[int, bytes]]
    eeprom: list[tuple[int, bytes]] = field(default_factory=list)
    symbols: dict[str, Symbol] = field(default_factory=dict)

    @property
    def size(self) -> int:
        """Return the bytes of flash that it takes."""
        return sum(len(part) for _address, part in self.flash)


def read_firmware(path: Path) -> Firmware:
    """Return the program of a file; raises ``FirmwareError``."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FirmwareError(f"cannot read {path}: {error.strerror}", "unreadable") from error
    try:
        firmware = _read_elf(data) if data[:4] == b"\x7fELF" else read_hex(data.decode("ascii"))
    except (struct.error, ValueError, IndexError) as error:
        raise FirmwareError(f"{path} is not a firmware: {error}", "not_firmware") from error
    for address, part in firmware.flash:
        if not 0 <= address <= FLASH_SIZE - len(part):
            text = f"{path} does not fit into {FLASH_SIZE} bytes of flash"
            raise FirmwareError(text, "too_large")
    return firmware


def read_hex(text: str) -> Firmware:
    """Return the program of an Intel HEX file; raises ``ValueError``."""
    parts: list[tuple[int, bytes]] = []
    base = 0
    for line in text.split():
        if not line.startswith(":"):
            raise ValueError(f"{line[:20]!r} is neither ELF nor Intel HEX")
        record = bytes.fromhex(line[1:])
        size, address, kind = struct.unpack(">BHB", record[:4])
        if len(record) != size + 5 or sum(record) % 256:
            raise ValueError(f"the checksum of {line!r} is wrong")
        if kind == 0:
            parts.append((base + address, record[4:-1]))
        elif kind == 2:
            base = int.from_bytes(record[4:-1], "big") << 4
        elif kind == 4:
            base = int.from_bytes(record[4:-1], "big") << 16
    if not parts:
        raise ValueError("it is empty")
    return Firmware(parts)


def _read_elf(data: bytes) -> Firmware:
    machine = struct.unpack_from("<H", data, 18)[0]
    if data[4] != 1 or machine != _AVR:
        raise ValueError("it is not for an AVR")
    programs, sections = struct.unpack_from("<II", data, 28)
    program_size, program_count = struct.unpack_from("<HH", data, 42)
    section_size, section_count = struct.unpack_from("<HH", data, 46)
    firmware = Firmware([])
    for index in range(program_count):
        kind, offset, _virtual, physical, size = struct.unpack_from(
            "<5I", data, programs + index * program_size
        )
        if kind != _LOAD or not size:
            continue
        part = data[offset : offset + size]
        if physical < _DATA_SPACE:
            firmware.flash.append((physical, part))
        elif _EEPROM_SPACE <= physical < _EEPROM_SPACE + 1024:
            firmware.eeprom.append((physical - _EEPROM_SPACE, part))
    for index in range(section_count):
        header = struct.unpack_from("<10I", data, sections + index * section_size)
        if header[1] == _SYMBOLS:
            names = struct.unpack_from("<10I", data, sections + header[6] * section_size)[4]
            _read_symbols(data, header[4], header[5], names, firmware.symbols)
    return firmware


def _read_symbols(data: bytes, start: int, size: int, names: int, into: dict[str, Symbol]) -> None:
    for at in range(start, start + size, 16):
        name, value, length = struct.unpack_from("<III", data, at)
        end = data.index(b"\0", names + name)
        text = data[names + name : end].decode("utf-8", "replace")
        if text:
            is_data = _DATA_SPACE <= value < _EEPROM_SPACE
            into[text] = Symbol(value - _DATA_SPACE if is_data else value, length, is_data)
