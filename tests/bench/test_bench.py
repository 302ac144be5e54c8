"""The benchmarks' arithmetic: turns, ratios, spread, noise limits, exclusions.

Speed itself is not tested.
"""

import subprocess
import sys
from importlib import import_module

import pytest

from bench import __main__ as program
from bench import bus, codecs, firmware, latency, page, relay
from bench.board import Board, Latency, terminal
from bench.table import Row, compared, figure, format_table
from bench.timing import Limit, Spread, rounds_ns
from tests.support.firmware import build_firmware
from tests.support.tools import need_tool

AT_MOST_2, AT_LEAST_2 = Limit(2.0), Limit(2.0, is_minimum=True)
STEADY = (1.0, 1.0, 1.0, 1.0, 1.0)


def test_the_spread_is_the_median_between_the_quartiles():
    assert Spread.of([5.0, 1.0, 2.0, 4.0, 3.0]) == Spread(3.0, 2.0, 4.0)
    assert Spread.of([1.0, 2.0]) == Spread(1.5, 1.25, 1.75)


@pytest.mark.parametrize(
    ("spread", "limit", "met"),
    [
        (Spread(1.9, 1.85, 1.95), AT_MOST_2, True),
        (Spread(2.1, 2.05, 2.15), AT_MOST_2, False),
        (Spread(2.1, 2.05, 2.15), AT_LEAST_2, True),
        (Spread(1.9, 1.85, 1.95), AT_LEAST_2, False),
        # Narrow around the target: the median decides.
        (Spread(1.99, 1.95, 2.05), AT_MOST_2, True),
        (Spread(2.0, 1.95, 2.05), AT_MOST_2, True),
        # Wide, but on one side of it.
        (Spread(1.2, 0.5, 1.9), AT_MOST_2, True),
        (Spread(4.0, 2.1, 9.0), AT_MOST_2, False),
        # Wide and on both sides.
        (Spread(1.9, 1.7, 2.1), AT_MOST_2, None),
        (Spread(2.1, 1.9, 2.3), AT_LEAST_2, None),
        (Spread(1.0, float("-inf"), float("inf")), AT_MOST_2, None),
        (Spread(float("nan"), float("nan"), float("nan")), AT_MOST_2, None),
    ],
)
def test_a_limit_is_met_missed_or_cannot_be_judged(spread, limit, met):
    assert spread.meets(limit) is met


def test_the_ratio_is_the_median_of_the_rounds_ratios():
    """Not the ratio of the medians: a slow minute slows both sides of its round."""
    ours, theirs = (2.0, 20.0, 4.0), (1.0, 10.0, 4.0)
    row = compared("a", "us", ours, "peer", theirs, AT_MOST_2)
    assert (row.ours, row.peer_figure) == ("4.00 us", "4.00 us")
    assert row.ratio == "2.00x (1.50 to 2.00)"
    assert (row.target, row.met, row.is_noisy) == ("<= 2x", None, True)


def test_a_gain_is_how_many_times_more_the_peer_takes():
    row = compared("a", "us", STEADY, "peer", (3.0,) * 5, AT_LEAST_2)
    assert (row.ratio, row.target) == ("3.00x better (3.00 to 3.00)", ">= 2x better")
    assert row.met is True
    assert compared("a", "us", STEADY, "peer", STEADY, AT_LEAST_2).met is False


def test_a_figure_without_a_peer_is_judged_itself():
    row = compared("a", "MB", (3.0, 1.0, 2.0), limit=Limit(1.0))
    assert (row.ours, row.ratio, row.target) == ("2.00 MB", "1.50 to 2.50", "<= 1 MB")
    assert (row.peer, row.peer_figure, row.met) == ("", "", False)
    assert compared("a", "MB", STEADY).met is None


def test_a_peer_without_time_gives_no_ratio():
    row = compared("a", "us", STEADY, "peer", (0.0, -1.0, 0.0, 0.0, 1.0), AT_MOST_2)
    assert row.is_noisy and row.met is None


def test_a_round_that_a_busy_machine_prevented_is_noise():
    row = compared("a", "us", (1.0, float("nan"), 1.0), "peer", STEADY[:3], AT_MOST_2)
    assert row.is_noisy and row.met is None and format_table([row]).endswith("too noisy")
    assert compared("a", "us", STEADY[:3], "peer", (1.0, float("nan"), 1.0)).is_noisy


def test_a_missing_peer_leaves_the_figure_and_its_reason():
    row = compared("a", "us", STEADY, "HAProxy", (), AT_MOST_2)
    assert (row.ours, row.peer_figure, row.ratio) == ("1.00 us", "-", "")
    assert (row.met, row.is_noisy, row.left_out) == (None, False, "not installed")


@pytest.mark.parametrize(
    ("value", "text"), [(0, "0.00"), (0.01234, "0.0123"), (1.234, "1.23"), (123.4, "123")]
)
def test_three_digits(value, text):
    assert figure(value) == text


def test_the_table_marks_noise_and_lists_what_was_left_out():
    rows = [
        compared("one", "us", STEADY, "peer", STEADY, AT_MOST_2),
        compared("two", "us", (1.0, 2.0, 3.0), limit=AT_MOST_2),
        compared("three", "us", STEADY, "peer", ()),
        Row("four", left_out="no Chromium"),
    ]
    heading, _, one, two, three, *absent = format_table(rows).splitlines()
    assert heading.split() == ["what", "ours", "peer", "peer's", "ratio", "(quartiles)", "target",
                               "met"]  # fmt: skip
    assert one.endswith("yes") and two.endswith("too noisy") and three.endswith("-")
    assert absent == [
        "left out:",
        "    three, beside peer: not installed",
        "    four: no Chromium",
    ]
    assert "left out" not in format_table(rows[:2])
    assert [line.count("|") for line in format_table(rows[:2], True).splitlines()] == [8] * 4


def test_ours_and_the_peer_alternate():
    calls = []
    times = rounds_ns([lambda: calls.append("ours"), lambda: calls.append("peer")], 3, 2)
    assert calls == ["ours", "ours", "peer", "peer"] * 3
    assert [len(each) for each in times] == [3, 3]

    calls.clear()

    def frames(name):
        calls.append(name)
        return 1

    found = codecs.cpu_us(lambda: frames("ours"), lambda: frames("peer"), rounds=2)
    assert calls == ["ours", "peer"] * 2
    assert [len(each) for each in found] == [2, 2]


def test_the_boards_take_turns():
    calls = []

    class Recorded:
        def __init__(self, name):
            self.name = name

        def wait_for_answer(self, _):
            calls.append(f"wait {self.name}")

        def measure(self, rate_hz, seconds):
            calls.append(self.name)
            return Latency(int(rate_hz * seconds), 0, len(calls), 0.0, 0.0)

    ours, theirs = latency.in_turns([Recorded("a"), Recorded("b")], 0.5, 2)
    assert calls == ["wait a", "a", "wait b", "b"] * 2
    assert [each.p50_us for each in ours] == [2, 6] and [each.p50_us for each in theirs] == [4, 8]


def test_a_relay_is_compared_with_the_direct_line_of_its_round():
    direct = [relay.Figures(100, 300, 0), relay.Figures(200, 400, 0)]
    ours = [relay.Figures(150, 500, 1), relay.Figures(260, 700, 1)]
    assert relay.added_us(ours, direct, "p50") == [50, 60]
    assert relay.added_us(ours, direct, "p99") == [200, 300]
    assert relay.added_us([], direct, "p50") == []


def test_a_paint_is_timed_from_the_sending_of_its_frame():
    painted = [
        {"beacon": 2, "unix_ms": 1050.0, "inPage_ms": 7.0},
        {"beacon": 1, "unix_ms": 1010.0, "inPage_ms": 9.0},
        {"beacon": 3, "unix_ms": 2000.0, "inPage_ms": 1.0},
    ]
    measured = {"painted": painted, "seconds": 2.0, "animationFrames": 100, "longTasks_ms": [60]}
    paints = page._paints(measured, {1: (1000.0, 4.0), 2: (1020.0, 5.0)})
    assert paints == page.Paints([10.0, 30.0], [14.0, 35.0], [7.0, 9.0], 1.0, 50.0, [60])
    with pytest.raises(RuntimeError):
        page._paints(measured, {})


@pytest.mark.parametrize("name", program.SUBJECTS)
def test_every_subject_has_rows(name):
    assert callable(import_module(f"bench.{name}").rows)


@pytest.mark.parametrize("name", ["pluggy", "blinker"])
def test_a_missing_peer_is_listed(name, monkeypatch):
    monkeypatch.setitem(sys.modules, name, None)
    found = [row for row in bus.rows(quick=True) if row.peer == name]
    assert [row.left_out for row in found] == ["not installed"] * 3
    assert all(row.ours for row in found)


def test_missing_pymavlink_is_listed(monkeypatch):
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.common", None)
    left_out = {row.peer: row.left_out for row in codecs.rows(quick=True)}
    assert left_out["pymavlink"] == "not installed" and left_out["the prototype's way"] == ""


def test_without_a_compiler_the_daemon_is_still_measured(monkeypatch):
    monkeypatch.setattr(latency.shutil, "which", lambda _: None)
    with latency.floor_board() as board:
        assert board is None
    found = list(latency.floor_rows([Latency(1, 0, 1.0, 2.0, 3.0)] * 3, []))
    assert [(row.ours, row.left_out) for row in found] == [
        ("1.00 us", "no C compiler"),
        ("2.00 us", "no C compiler"),
    ]


def test_without_chromium_its_rows_are_left_out_and_the_others_are_there(monkeypatch, capsys):
    monkeypatch.setattr(
        page.shutil, "which", lambda name: None if name.startswith("chromium") else name
    )
    assert program.main(["page", "cascade", "--quick"]) == 0
    printed = capsys.readouterr().out
    assert "page: chromium-headless-shell " in printed
    assert "cascade of 6 PIDs" in printed and "failed" not in printed


@pytest.mark.parametrize(
    "error",
    [RuntimeError("no daemon"), subprocess.TimeoutExpired("no daemon", 1.0)],
)
def test_a_failed_subject_does_not_affect_others(monkeypatch, capsys, error):
    def broken(quick):
        yield Row("before", "1")
        raise error

    monkeypatch.setattr(bus, "rows", broken)
    assert program.main(["bus", "cascade", "--quick"]) == 1
    printed = capsys.readouterr()
    assert "no daemon" in printed.out
    assert "cascade of 6 PIDs" in printed.out
    assert "cascade of 6 PIDs" in printed.err


def test_missing_answers_are_counted():
    with terminal() as (board_end, _):
        figures = Board(board_end).measure(100, 0.1)
    assert figures.lost == figures.sent == 10


def test_the_floor_and_the_echo_answer_every_frame():
    need_tool("gcc")
    with latency.floor_board() as floor, latency.echo_board() as echo:
        for board in (floor, echo):
            board.wait_for_answer(30.0)
            assert board.measure(100, 0.2).lost == 0


@pytest.mark.parametrize(("frames", "is_left_out"), [(2999, True), (3000, False)])
def test_the_slowest_frame_of_a_short_round_is_not_compared(frames, is_left_out):
    runs = [Latency(frames, 0, 1.0, 2.0, 3.0)] * 3
    row = latency.collector_row(runs, runs, frames)
    assert (row.ours, bool(row.left_out)) == ("" if is_left_out else "3.00 us", is_left_out)


def test_the_line_to_the_board_is_full_and_no_byte_is_lost():
    flight = firmware.Flight(build_firmware(), mix=firmware.FULL, aux1_us=1000)
    flight.run(500_000.0)
    share = flight.bytes_to_board / (firmware.BYTES_A_SECOND * 0.5)
    assert share == pytest.approx(1.0, abs=0.01)
    assert flight.bytes_from_board / (firmware.BYTES_A_SECOND * 0.5) > 0.8
    assert flight.rig.serial.overruns == 0


def test_every_command_is_in_a_mix_of_its_own_and_among_others():
    mixes = firmware.mixes()
    for letter in firmware.COMMAND_SIZES:
        assert letter in mixes
        assert sum(letter in mix for mix in mixes) >= 3


def test_lateness_is_measured_although_requests_crowd_out_the_status():
    row = firmware.lateness_row(build_firmware(), 1, ["G"])
    late_us, _, worst = row.ours.partition(" us by ")
    assert int(late_us) > 0 and worst == "G"
    assert row.met is (int(late_us) <= firmware.LATE_US)


def test_the_command_prints_one_table():
    command = [sys.executable, "-m", "bench", "cascade", "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.startswith("what ")
    assert "cascade:" in done.stderr


def test_an_unknown_name_is_one_sentence():
    command = [sys.executable, "-m", "bench", "speed"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 2
    assert "speed" in done.stderr and "bus, codecs" in done.stderr
    assert "Traceback" not in done.stderr
