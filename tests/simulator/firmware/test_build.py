"""What is aboard, and what is said where it cannot be had."""

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
