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
    with pytest.raises(ValueError, match="0400100001020304E3"):
        read_hex(":0400100001020304E3\n")


@pytest.mark.parametrize(
    "content, code",
    [
        (None, "unreadable"),
        (b"", "not_firmware"),
        (b"hello", "not_firmware"),
        (b"\xff\xfe", "not_firmware"),
        (b"\x7fELF", "not_firmware"),
        # A program of this machine.
        (b"\x7fELF\x02" + bytes(100), "not_firmware"),
        (b":0280000001027B\n", "too_large"),
    ],
)
def test_other_files_are_refused(tmp_path, content, code):
    path = tmp_path / "broken.elf"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(FirmwareError) as caught:
        read_firmware(path)
    assert caught.value.code == code
    assert str(path) in str(caught.value) and "\n" not in str(caught.value)


@given(st.binary(max_size=200))
def test_any_bytes_are_firmware_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "any.bin"
    for start in (b"", b"\x7fELF\x01\x01\x01" + bytes(11) + b"\x53\x00", b":"):
        path.write_bytes(start + content)
        try:
            read_firmware(path)
        except FirmwareError as error:
            assert str(path) in str(error)


def test_without_simavr_the_error_names_the_packages(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "library_path", lambda: tmp_path / "librig.so")
    monkeypatch.setattr(library, "HEADER", tmp_path / "missing.h")
    with pytest.raises(RigUnavailableError, match="libsimavr-dev") as caught:
        library.build_library()
    assert caught.value.code == "missing_packages"


def test_the_library_is_built_when_a_source_is_newer(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "library_path", lambda: tmp_path / "build" / "librig.so")
    if not library.HEADER.exists():
        unavailable(library.NEEDS)
    path = library.build_library()
    built = path.stat().st_mtime_ns
    assert library.build_library().stat().st_mtime_ns == built
    os.utime(path, (0, 0))
    assert library.build_library().stat().st_mtime_ns >= built
