"""Files that the rig loads, and files that it refuses in one sentence."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.arduino.rig.firmware import build, make_rig
from tests.support.tools import unavailable
from up_rig import FirmwareError, RigUnavailableError, library
from up_rig.elf import read_firmware, read_hex


def test_an_elf_file_has_flash_and_symbols(tmp_path):
    firmware = read_firmware(build("resets", tmp_path, "-DCASE=5"))
    assert 200 < firmware.size < 2000
    assert firmware.symbols["counter"].is_data
    assert firmware.symbols["counter"].size == 1
    assert not firmware.symbols["main"].is_data


def test_initial_values_of_the_eeprom_are_loaded(tmp_path):
    rig = make_rig(build("eeprom", tmp_path))
    assert rig.eeprom.read(0, 3) == b"\x12\x34\xff"


def test_hex_lines_are_checked():
    firmware = read_hex(":0400100001020304E2\n:00000001FF\n")
    assert firmware.flash == [(0x10, bytes([1, 2, 3, 4]))]
    with pytest.raises(ValueError, match="the check of"):
        read_hex(":0400100001020304E3\n")


@pytest.mark.parametrize(
    "content, sentence",
    [
        (b"", "is empty"),
        (b"hello", "neither ELF nor Intel HEX"),
        (b"\xff\xfe", "is not a firmware"),
        (b"\x7fELF", "is not a firmware"),
        (b":02800000010279\n".replace(b"79", b"7B"), "does not fit into 32768 bytes"),
    ],
)
def test_a_file_that_is_no_firmware_is_refused(tmp_path, content, sentence):
    path = tmp_path / "broken.elf"
    path.write_bytes(content)
    with pytest.raises(FirmwareError, match=sentence) as caught:
        read_firmware(path)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_is_said(tmp_path):
    with pytest.raises(FirmwareError, match="cannot read"):
        read_firmware(tmp_path / "missing.elf")


def test_a_program_of_this_machine_is_refused(tmp_path):
    path = tmp_path / "host"
    path.write_bytes(b"\x7fELF\x02" + bytes(100))
    with pytest.raises(FirmwareError, match="not for an AVR"):
        read_firmware(path)


@given(st.binary(max_size=200))
def test_any_bytes_are_firmware_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "any.bin"
    for start in (b"", b"\x7fELF\x01\x01\x01" + bytes(11) + b"\x53\x00", b":"):
        path.write_bytes(start + content)
        try:
            read_firmware(path)
        except FirmwareError as error:
            assert str(path) in str(error)


def test_without_simavr_the_rig_says_what_it_needs(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "library_path", lambda: tmp_path / "librig.so")
    monkeypatch.setattr(library, "HEADER", tmp_path / "missing.h")
    with pytest.raises(RigUnavailableError, match="Debian packages gcc, libsimavr-dev"):
        library.build_library()


def test_the_library_is_built_when_a_source_is_newer(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "library_path", lambda: tmp_path / "build" / "librig.so")
    if not library.HEADER.exists():
        unavailable(library.NEEDS)
    path = library.build_library()
    built = path.stat().st_mtime_ns
    assert library.build_library().stat().st_mtime_ns == built
    os.utime(path, (0, 0))
    assert library.build_library().stat().st_mtime_ns >= built
