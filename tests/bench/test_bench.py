"""Rows come out of every benchmark, whatever their figures are."""

import subprocess
import sys

import pytest

from bench import __main__ as program
from bench import (
    bus,
    cascade,
    codecs,
    firmware,
    flight_log,
    latency,
    load,
    page,
    recorder,
    simulator,
    startup,
)
from bench.board import Board, terminal
from bench.processes import running
from bench.table import Row
from bench.timing import percentile
from tests.support.firmware import build_firmware
from tests.support.tools import need_tool

SUBJECTS = {
    "bus": (bus, 9),
    "codecs": (codecs, 4),
    "cascade": (cascade, 3),
    "latency": (latency, 5),
    "startup": (startup, 2),
    "load": (load, 2),
    "recorder": (recorder, 5),
    "flight_log": (flight_log, 4),
}


SIZES = {"firmware, flash", "firmware, static RAM, no heap"}


def check(rows, least):
    assert len(rows) >= least
    assert all(isinstance(row, Row) and row.what and row.ours for row in rows)
    assert all(row.target for row in rows if row.met is not None)


def test_every_subject_is_tested():
    assert set(program.SUBJECTS) == {*SUBJECTS, "relay", "firmware", "simulator", "page"}


@pytest.mark.parametrize("name", SUBJECTS)
def test_rows_of(name):
    subject, least = SUBJECTS[name]
    check(list(subject.rows(quick=True)), least)


@pytest.mark.slow
def test_rows_of_the_relay():
    """In a process of its own: it raises the limit of open files."""
    need_tool("taskset", "util-linux")
    command = [sys.executable, "-m", "bench", "relay", "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=True)
    rows = [line for line in done.stdout.splitlines() if line.startswith("relay, ")]
    assert len(rows) >= 5, done.stdout


def test_rows_of_the_firmware():
    """Simulated time: its figures are the same on every machine, and met or not."""
    build_firmware()
    rows = list(firmware.rows(quick=True))
    check(rows, 10)
    missed = {each.what for each in rows if each.met is False}
    assert missed <= SIZES


def test_rows_of_the_simulator():
    build_firmware()
    need_tool("g++")
    check(list(simulator.rows(quick=True)), 3)


def test_rows_of_the_page():
    """The first half alone: without the link of 100 ms it is the same again."""
    build_firmware()
    for program_needed in ("node", "npm", "chromium"):
        need_tool(program_needed)
    page.set_up()
    paints = page.measure(2.0)
    assert len(paints.to_pixel) > 2
    # Sent before it was painted, by two clocks of one machine.
    assert paints.to_pixel[0] > 0
    assert paints.to_pixel[0] >= paints.in_page[0] > 0
    assert all(way <= whole for way, whole in zip(paints.to_pixel, paints.attitude, strict=True))


def test_no_output_is_lost_and_the_figures_are_ordered():
    figures = latency.measure_daemon(0.5)
    assert figures.lost == 0
    assert 0 < figures.p50_us <= figures.p99_us <= figures.p999_us


def test_answers_that_do_not_come_are_counted():
    with terminal() as (board_end, _):
        figures = Board(board_end).measure(100, 0.1)
    assert figures.lost == figures.sent == 10


def test_the_floor_answers_every_frame():
    need_tool("gcc")
    with latency.floor_program() as path, terminal() as (board_end, port), running((path, port)):
        board = Board(board_end)
        board.greet(30.0)
        assert board.measure(100, 0.2).lost == 0


@pytest.mark.parametrize("name", ["pluggy", "blinker"])
def test_a_missing_peer_is_said(name, monkeypatch):
    monkeypatch.setitem(sys.modules, name, None)
    found = [row for row in bus.rows(quick=True) if row.peer == name]
    assert [row.peer_figure for row in found] == ["not installed"] * 3


def test_missing_pymavlink_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.common", None)
    rows = codecs.rows(quick=True)
    assert "not installed" in [row.peer_figure for row in rows if row.peer == "pymavlink"]


def test_without_a_compiler_the_daemon_is_measured_all_the_same(monkeypatch):
    monkeypatch.setattr(latency.shutil, "which", lambda _: None)
    mine = latency.Latency(1, 0, 1.0, 2.0, 3.0)
    with latency.floor_program() as path:
        assert path is None
    assert [row.peer_figure for row in latency.floor_rows(mine, None)] == ["no C compiler"] * 2


def test_one_subject_that_fails_costs_no_other(monkeypatch, capsys):
    def broken(quick):
        yield Row("before", "1")
        raise RuntimeError("there is no daemon")

    monkeypatch.setattr(bus, "rows", broken)
    assert program.main(["bus", "cascade", "--quick"]) == 1
    said = capsys.readouterr()
    assert "there is no daemon" in said.out
    assert "cascade of 6 PIDs" in said.out
    assert "cascade of 6 PIDs" in said.err


def test_the_command_prints_one_table():
    command = [sys.executable, "-m", "bench", "cascade", "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    heading = done.stdout.splitlines()[0].split()
    assert heading == ["what", "ours", "peer", "peer's", "ratio", "target", "met"]
    assert "cascade:" in done.stderr


def test_an_unknown_name_is_one_sentence():
    command = [sys.executable, "-m", "bench", "speed"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 2
    assert "there is no speed; there are bus, codecs" in done.stderr
    assert "Traceback" not in done.stderr


def test_percentiles():
    assert percentile([1, 2, 3, 4], 0.5) == 3
    assert percentile([1], 0.999) == 1
    assert percentile([], 0.5) != percentile([], 0.5)
