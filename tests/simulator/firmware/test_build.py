"""The built firmware, and the message if it cannot be built."""

import os

import pytest

from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up_rig import RigUnavailableError
from up_rig import build as rig_build
from up_simulator.firmware import build
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.firmware.host_board import HostBoard
from up_simulator.firmware.rig_board import RigBoard


def recorder(logged):
    return lambda _text, *, code, reason: logged.append((code, reason))


@pytest.fixture(autouse=True)
def built_once():
    """Let each test build for itself: a process builds once."""
    rig_build.build_firmware.cache_clear()
    rig_build.build_host_library.cache_clear()


@pytest.fixture
def no_avr(monkeypatch, tmp_path):
    """Take the AVR compiler out of the path."""
    monkeypatch.setattr(rig_build, "AVR_LIBC", tmp_path / "io.h")
    monkeypatch.setattr(build, "FIRMWARE", tmp_path / "raspilot.elf")


def test_without_the_avr_tools_the_host_build_flies(no_avr):
    need_tool("g++")
    logged = []
    board = choose_board("auto", log=recorder(logged))
    assert isinstance(board, HostBoard)
    ((code, reason),) = logged
    assert code == "board_substituted" and "gcc-avr" in reason


def test_the_firmware_is_not_substituted_on_request(no_avr):
    with pytest.raises(BoardUnavailableError, match="gcc-avr"):
        choose_board("firmware")


@pytest.fixture
def elf():
    """Return the firmware's bytes, built while the tools are still there."""
    content = build_firmware().read_bytes()
    rig_build.build_firmware.cache_clear()
    return content


def test_without_the_avr_tools_an_earlier_firmware_flies(elf, no_avr):
    build.FIRMWARE.write_bytes(elf)
    for kind in ("auto", "firmware"):
        logged = []
        assert isinstance(choose_board(kind, log=recorder(logged)), RigBoard)
        ((code, reason),) = logged
        assert code == "board_outdated" and "gcc-avr" in reason


def test_a_firmware_that_is_older_than_its_sources_does_not_fly(elf, no_avr):
    build.FIRMWARE.write_bytes(elf)
    os.utime(build.FIRMWARE, (0, 0))
    with pytest.raises(BoardUnavailableError, match="gcc-avr"):
        choose_board("firmware")


@pytest.fixture
def no_compiler(monkeypatch, tmp_path):
    """Leave no compiler in the path."""
    need_tool("g++")
    rig_build.build_host_library()
    rig_build.build_host_library.cache_clear()
    library = tmp_path / "libraspilot.so"
    library.write_bytes(build.HOST_LIBRARY.read_bytes())
    monkeypatch.setattr(build, "HOST_LIBRARY", library)
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("make", "sh", "mkdir", "cmp", "echo"):
        (programs / name).symlink_to(need_tool(name))
    monkeypatch.setenv("PATH", str(programs))


def test_without_a_compiler_an_earlier_host_build_flies(no_compiler):
    logged = []
    assert isinstance(choose_board("host", log=recorder(logged)), HostBoard)
    ((code, reason),) = logged
    assert code == "board_outdated" and "apt-get install g++" in reason


def test_without_a_compiler_and_a_build_the_error_names_the_package(
    no_compiler, monkeypatch, tmp_path
):
    monkeypatch.setattr(build, "HOST_LIBRARY", tmp_path / "nothing.so")
    with pytest.raises(BoardUnavailableError) as error:
        choose_board("host")
    assert "apt-get install g++" in str(error.value) and "\n" not in str(error.value)


def test_without_simavr_the_host_build_flies(monkeypatch):
    need_tool("g++")

    def missing():
        raise RigUnavailableError("the bench rig needs simavr and gcc (Debian packages ...)")

    monkeypatch.setattr(build, "load_library", missing)
    logged = []
    assert isinstance(choose_board(log=recorder(logged)), HostBoard)
    ((code, reason),) = logged
    assert code == "board_substituted" and "simavr" in reason


def test_a_compiler_error_is_reported_in_one_line(monkeypatch):
    def broken():
        raise rig_build.BuildError("make: entering\nsrc/a.cpp:3:1: error: expected ';'\nmake: ***")

    monkeypatch.setattr(build, "build_firmware", broken)
    with pytest.raises(BoardUnavailableError) as error:
        choose_board("auto")
    assert "src/a.cpp:3:1: error: expected ';'" in str(error.value)
    assert "\n" not in str(error.value)


def test_another_elf_flies_in_the_place_of_the_projects_own(tmp_path):
    build_firmware()
    path = tmp_path / "broken.elf"
    path.write_bytes(b"no ELF")
    with pytest.raises(BoardUnavailableError) as error:
        choose_board(elf=path)
    assert "broken.elf" in str(error.value)


def test_no_board_needs_no_tools(no_avr):
    assert isinstance(choose_board("direct"), DirectBoard)


def test_a_rig_without_sources_is_refused_and_writes_nothing(monkeypatch, tmp_path):
    monkeypatch.setattr(rig_build, "ARDUINO", tmp_path)
    for kind in ("auto", "firmware", "host"):
        with pytest.raises(BoardUnavailableError):
            choose_board(kind)
    assert list(tmp_path.iterdir()) == []
