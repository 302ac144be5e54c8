"""Thesis framing: an old firmware, and our own that falls to it."""

import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.simulator.bench import Bench
from tests.simulator.pi import frame, vectors
from up_simulator.board import OldFirmware

ALTITUDE = b"h\x01\x2c"
LOCATION = b"l" + struct.pack(">2f", 50.0, 14.5)
HEADING = b"b\x01\x3b"
GAINS = b"t" + struct.pack(">12f", *range(12))
RUN = HEADING + LOCATION + HEADING


def old(**options):
    return Bench(start=False, old=OldFirmware(**options))


def taken(bench):
    raw, bench.raw = bench.raw, b""
    return raw


def split(stream):
    """Split what an old firmware streams into its messages."""
    messages = []
    while stream:
        size = {ord("r"): 9, ord("o"): 13}[stream[0]]
        messages.append(stream[:size])
        stream = stream[size:]
    return messages


def test_it_streams_outputs_and_orientation_from_boot_at_50_ms():
    bench = old()
    bench.run(1.0)
    messages = split(taken(bench))
    assert [each[:1] for each in messages] == [b"r", b"o"] * 20
    assert struct.unpack(">3f", messages[1][1:]) == (10.5, -5.5, 3.25)
    assert all(abs(pulse - 1500) <= 1 for pulse in struct.unpack(">4H", messages[-2][1:])[:2])


def test_panic_stretches_its_periods_and_never_shortens_them():
    bench = old()
    bench.board.data_received(b"p\x01\x00\x96")
    bench.run(0.5)
    taken(bench)
    bench.run(3.0)
    assert len(split(taken(bench))) == 40
    bench.board.data_received(b"p\x00\x00\x0a")
    bench.run(0.5)
    taken(bench)
    bench.run(1.0)
    assert len(split(taken(bench))) == 40


def test_gains_are_set_and_told():
    bench = old()
    wanted = struct.pack(">12f", *range(12))
    bench.board.data_received(b"t" + wanted + b"T")
    assert taken(bench) == b"T" + wanted


def test_an_unknown_byte_is_answered_with_it_and_dropped_alone():
    bench = old()
    bench.board.data_received(b"\xffT")
    assert taken(bench)[:3] == b"!\xffT"


def test_an_unfinished_command_is_answered_by_a_bare_mark():
    bench = old()
    bench.run(0.06)
    taken(bench)
    bench.board.data_received(b"h\x01")
    bench.run(0.2)
    assert b"!" in taken(bench).replace(b"!\xff", b"")


@pytest.mark.parametrize(
    "vector",
    [each for each in vectors("serial_thesis.json") if each["direction"] == "to_arduino"],
    ids=lambda vector: vector["type"],
)
def test_an_old_firmware_that_confirms_echoes_every_command(vector):
    wire = bytes.fromhex(vector["wire"])
    silent, loud = old(), old(confirms=True)
    for bench in (silent, loud):
        bench.board.data_received(wire)
    if vector["type"] == "T":
        assert taken(silent)[:1] == taken(loud)[:1] == b"T"
    else:
        assert taken(silent) == b""
        assert taken(loud) == wire


def test_its_boot_text_comes_first():
    bench = old(boot_text="IMU connection failed")
    bench.board.opened()
    bench.run(0.01)
    assert taken(bench).startswith(b"IMU connection failed\r\nr")


def test_an_old_firmware_has_no_arming_gate():
    bench = Bench("t=0 throttle=1400", start=False, has_motor=True, old=OldFirmware())
    bench.run(0.1)
    assert abs(bench.flight.servos[2] - 1400) <= 1


@pytest.mark.parametrize(
    "run",
    [
        (GAINS, b"T"),
        (GAINS, ALTITUDE),
        (b"p\x01\x00\x96", b"p\x00\x00\x32"),
        (HEADING, LOCATION, ALTITUDE, b"T", HEADING),
        (LOCATION, LOCATION, LOCATION, LOCATION),
    ],
)
def test_ours_falls_to_thesis_framing_after_a_run_of_thesis_commands(run):
    bench = Bench(start=False)
    for command in run[:-1]:
        bench.board.data_received(command)
        assert not bench.board.is_thesis
    bench.board.data_received(run[-1])
    assert bench.board.is_thesis
    bench.run(0.2)
    assert split(taken(bench))[0][:1] == b"r"


def test_ours_stays_there_and_takes_no_frames_any_more():
    bench = Bench(start=False)
    bench.board.data_received(RUN)
    taken(bench)
    bench.board.data_received(frame(0, "s"))
    assert bench.board.is_thesis
    assert not bench.board.is_started


@pytest.mark.parametrize(
    "stream",
    [
        b"T" * 100,
        ALTITUDE * 100,
        GAINS,
        ALTITUDE + LOCATION,
        LOCATION * 3,
        HEADING * 2 + b"\xff" + LOCATION,
        HEADING * 2 + b"b\x7f\xff" + LOCATION,
        HEADING * 2 + b"p\x05\x00\x96",
    ],
)
def test_ours_does_not_fall_for_less(stream):
    bench = Bench(start=False)
    bench.board.data_received(stream)
    assert not bench.board.is_thesis


def test_an_unfinished_command_breaks_the_run():
    bench = Bench(start=False)
    bench.board.data_received(HEADING * 2 + b"l\x01")
    bench.run(0.2)
    bench.board.data_received(LOCATION)
    assert not bench.board.is_thesis


def test_ours_does_not_fall_after_a_checked_frame():
    bench = Bench()
    bench.board.data_received(RUN)
    assert not bench.board.is_thesis


def test_ours_does_not_fall_while_armed():
    bench = Bench(start=False, has_motor=True)
    bench.run(2.0)
    assert bench.board.authority.is_armed
    bench.board.data_received(RUN)
    assert not bench.board.is_thesis


@given(st.binary(max_size=200))
@settings(deadline=None)
def test_any_bytes_stop_no_old_firmware(garbage):
    bench = old()
    bench.board.data_received(garbage)
    bench.run(0.3)
    taken(bench)
    bench.board.data_received(b"T")
    assert taken(bench)[:1] == b"T"
