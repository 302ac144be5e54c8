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


@pytest.fixture
def no_avr(monkeypatch, tmp_path):
    """Take the AVR compiler out of the path."""
    monkeypatch.setattr(rig_build, "AVR_LIBC", tmp_path / "io.h")
    monkeypatch.setattr(build, "FIRMWARE", tmp_path / "raspilot.elf")


def test_with_the_tools_the_firmware_flies(monkeypatch):
    build_firmware()
    said = []
    board = choose_board(say=said.append)
    assert isinstance(board, RigBoard)
    assert said == []


def test_without_the_avr_tools_the_host_build_flies_and_that_is_said(no_avr):
    need_tool("g++")
    said = []
    board = choose_board("auto", say=said.append)
    assert isinstance(board, HostBoard)
    (sentence,) = said
    assert "built for this computer" in sentence
    for package in ("make", "gcc-avr", "avr-libc", "arduino-core-avr"):
        assert package in sentence
    assert "\n" not in sentence


def test_who_asks_for_the_firmware_gets_no_other(no_avr):
    with pytest.raises(BoardUnavailableError, match="Debian packages make gcc-avr avr-libc"):
        choose_board("firmware")


@pytest.fixture
def elf():
    """Return the firmware's bytes, built while the tools are still there."""
    return build_firmware().read_bytes()


def test_without_the_avr_tools_the_firmware_that_is_built_flies(elf, no_avr):
    build.FIRMWARE.write_bytes(elf)
    for kind in ("auto", "firmware"):
        said = []
        assert isinstance(choose_board(kind, say=said.append), RigBoard)
        (sentence,) = said
        assert sentence.startswith("the firmware was built before and is not built anew: ")
        assert "gcc-avr" in sentence


def test_a_firmware_that_is_older_than_its_sources_does_not_fly(elf, no_avr):
    build.FIRMWARE.write_bytes(elf)
    os.utime(build.FIRMWARE, (0, 0))
    with pytest.raises(BoardUnavailableError, match="gcc-avr"):
        choose_board("firmware")


@pytest.fixture
def no_compiler(monkeypatch, tmp_path):
    """Leave no compiler in the path."""
    need_tool("g++")
    rig_build.make("host-library")
    library = tmp_path / "libraspilot.so"
    library.write_bytes(build.HOST_LIBRARY.read_bytes())
    monkeypatch.setattr(build, "HOST_LIBRARY", library)
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("make", "sh", "mkdir", "cmp", "echo"):
        (programs / name).symlink_to(need_tool(name))
    monkeypatch.setenv("PATH", str(programs))


def test_without_a_compiler_the_host_build_that_is_there_flies(no_compiler):
    said = []
    assert isinstance(choose_board("host", say=said.append), HostBoard)
    assert said == [
        "the firmware for this computer was built before and is not built anew: building the"
        " firmware for this computer needs a C++ compiler: apt-get install g++"
    ]


def test_without_a_compiler_and_a_build_one_sentence_says_what_to_install(
    no_compiler, monkeypatch, tmp_path
):
    monkeypatch.setattr(build, "HOST_LIBRARY", tmp_path / "nothing.so")
    with pytest.raises(BoardUnavailableError) as error:
        choose_board("host")
    assert str(error.value) == (
        "building the firmware for this computer needs a C++ compiler: apt-get install g++"
    )


def test_without_simavr_the_host_build_flies(monkeypatch):
    need_tool("g++")

    def missing():
        raise RigUnavailableError("the bench rig needs simavr and gcc (Debian packages ...)")

    monkeypatch.setattr(build, "load_library", missing)
    said = []
    assert isinstance(choose_board(say=said.append), HostBoard)
    assert "needs simavr" in said[0]


def test_sources_that_do_not_compile_are_a_sentence(monkeypatch):
    def broken():
        raise rig_build.BuildError("make: entering\nsrc/a.cpp:3:1: error: expected ';'\nmake: ***")

    monkeypatch.setattr(build, "build_firmware", broken)
    with pytest.raises(BoardUnavailableError) as error:
        choose_board("auto")
    assert str(error.value) == "the firmware does not compile: src/a.cpp:3:1: error: expected ';'"


def test_another_elf_flies_in_the_place_of_the_projects_own(tmp_path):
    build_firmware()
    path = tmp_path / "broken.elf"
    path.write_bytes(b"no ELF")
    with pytest.raises(BoardUnavailableError) as error:
        choose_board(elf=path)
    assert "broken.elf" in str(error.value)


def test_nothing_aboard_needs_no_tools(no_avr):
    assert isinstance(choose_board("direct"), DirectBoard)


def test_an_installed_rig_without_sources_is_a_sentence_and_writes_nothing(monkeypatch, tmp_path):
    monkeypatch.setattr(rig_build, "ARDUINO", tmp_path)
    for kind in ("auto", "firmware", "host"):
        with pytest.raises(BoardUnavailableError, match="the firmware's sources are not here"):
            choose_board(kind)
    assert list(tmp_path.iterdir()) == []
