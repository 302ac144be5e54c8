"""The tap reads the golden vectors, keeps the newest, counts the rest, and survives any bytes."""

import struct

import pytest

from tests.simulator.pi import vectors
from up_simulator.firmware.line_monitor import SIZES, LineMonitor
from up_simulator.firmware.wire import CheckedReader, Command, checked_frame

FROM_BOARD = [
    each for each in vectors("serial_checked.json") if each["direction"] == "from_arduino"
]


def wire_of(sent):
    return b"".join(
        checked_frame(at % 256, letter, payload) for at, (letter, payload) in enumerate(sent)
    )


def test_there_are_vectors():
    assert {each["type"] for each in FROM_BOARD} >= set(SIZES)


@pytest.mark.parametrize("vector", FROM_BOARD)
def test_it_reads_the_vectors(vector):
    tap = LineMonitor()
    found = tap.feed(bytes.fromhex(vector["wire"]), 1.0)
    payload = bytes.fromhex(vector["payload"])
    assert found == [Command(vector["type"], payload, vector["sequence"])]
    assert tap.bad_frames == 0


def test_status_has_the_fields_of_the_page():
    payload = struct.pack(
        ">BcBBBBHHHHHHHHB", 1, b"f", 2, 0b10001011, 5, 0x88, 2000, 54, 1, 2, 3, 4, 5, 6, 7
    )
    tap = LineMonitor()
    tap.feed(wire_of([("x", payload)]), 7.5)
    status = tap.status
    assert tap.status_s == 7.5
    assert (status.version, status.mode_letter, status.switch, status.vetoes) == (1, "f", 2, 5)
    assert status.is_armed and status.is_at_auto
    assert status.is_imu_valid and status.is_pi_received
    assert not status.is_receiver_valid and not status.is_failsafe
    assert status.is_restored
    assert (status.loop_us, status.late_us) == (2000, 54)
    assert (status.frame_errors, status.frames_lost) == (1, 2)
    assert (status.uptime_s, status.rx_age_ms, status.imu_age_ms) == (3, 4, 5)
    assert (status.battery_mv, status.acceleration) == (6, 7)


def test_orientation_is_kept_by_name():
    tap = LineMonitor()
    tap.feed(
        wire_of(
            [
                ("O", struct.pack(">H6f", 9, 10, 20, 30, 1, 2, 3)),
                ("r", struct.pack(">4H", 1100, 1200, 1300, 1400)),
            ]
        ),
        2.0,
    )
    orientation = tap.orientation
    assert (orientation.yaw_deg, orientation.pitch_deg, orientation.roll_deg) == (10, 20, 30)
    assert (orientation.yaw_rate_deg_s, orientation.roll_rate_deg_s) == (1, 3)


def test_answers_are_taken_once():
    tap = LineMonitor()
    tap.feed(wire_of([("K", b"s\0"), ("!", b"a\1\x08"), ("r", bytes(8))]), 0.0)
    assert [each.type for each in tap.take_answers()] == ["K", "!"]
    assert tap.take_answers() == []


def test_its_commands_are_read_by_a_firmware():
    tap = LineMonitor()
    wire = tap.start_bytes() + tap.command_bytes("M", b"f")
    found = CheckedReader().feed(wire, 0.0)
    assert found == [Command("s", b"", 0), Command("M", b"f", 1)]


def test_invalid_frames_are_counted_and_cost_only_themselves():
    tap = LineMonitor()
    good = checked_frame(0, "m", b"f")
    tap.feed(good[:2] + b"\1" + good[3:] + b"\1" * 1000 + b"\0", 0.0)
    assert (tap.bad_frames, tap.mode) == (2, None)
    tap.feed(good[:3], 1.0)
    assert tap.feed(good, 1.2) == [Command("m", b"f", 0)]
    assert tap.bad_frames == 3
