"""Framing on the compiled firmware, noise, and a full line."""

import json
import random
import struct
from pathlib import Path

import pytest

from tests.arduino.flight import LOW, Flight
from up_simulator.firmware.wire import checked_frame

VECTORS = Path(__file__).parents[1] / "vectors"


def vectors(name):
    return json.loads((VECTORS / f"{name}.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    "vector",
    [each for each in vectors("serial_checked")["vectors"] if each["direction"] == "to_arduino"],
    ids=lambda vector: f"{vector['type']}-{vector['sequence']}",
)
def test_every_golden_frame_is_understood(flight, vector):
    flight.rig.serial.write(bytes.fromhex(vector["wire"]))
    flight.run_ms(60)
    refused = [each.payload[2] for each in flight.messages if each.type == "!"]
    assert not {1, 2, 3} & set(refused), "understood, whatever its authority"
    assert flight.status().frame_errors == 0


def test_every_bad_frame_is_dropped_and_counted_and_the_next_one_accepted(flight):
    bad = vectors("serial_checked_bad")
    flight.send("s")
    flight.run_ms(50)
    before = 0
    for each in bad["vectors"]:
        wire = bytes.fromhex(each["wire"])
        flight.rig.serial.write(wire)
        assert flight.ask("m") == b"a", each["why"]
        dropped = flight.status().frame_errors
        # A flipped bit may have made an end of frame.
        assert dropped - before == wire.count(0), each["why"]
        before = dropped


@pytest.mark.slow
def test_a_hundred_thousand_fuzzed_bytes_change_nothing():
    """Noise, and good frames with flipped, lost and doubled bytes: it flies on and answers."""
    flight = Flight(aux1=1500)
    flight.run_ms(1500)
    assert flight.ask("m") == b"f"
    gains, profile = flight.ask("G"), flight.ask("c")
    noise = random.Random(4)
    flight.rig.servo.clear()
    sent = 0
    while sent < 100_000:
        letter = noise.choice("sdMmpgGuSRAvCce")
        frame = bytearray(checked_frame(noise.randrange(256), letter, noise.randbytes(8)))
        for _ in range(noise.randint(1, 3)):
            at = noise.randrange(len(frame))
            if noise.random() < 0.4:
                frame[at] ^= 1 << noise.randrange(8)
            elif noise.random() < 0.5:
                del frame[at]
            else:
                frame.insert(at, noise.randrange(256))
            frame = frame or bytearray(b"\1")
        piece = bytes(frame) + noise.randbytes(noise.randrange(40))
        flight.rig.serial.write(piece)
        sent += len(piece)
        flight.rig.run_us(len(piece) * 87)
    flight.rig.run_us(150_000)
    flight.rig.serial.read()
    flight._heard = b""
    flight.sequence = noise.randrange(256)
    assert flight.ask("m") == b"f"
    assert flight.ask("G") == gains
    assert flight.ask("c") == profile
    assert not flight.status().is_armed
    for channel, expected_us, most_us in (
        ("throttle", 1000, 0.6),
        ("ailerons", 1500, 20),
        ("elevator", 1500, 20),
        ("rudder", 1500, 20),
    ):
        widths = flight.widths_us(channel)
        assert len(widths) > 300
        assert max(abs(each - expected_us) for each in widths) <= most_us


def test_a_line_that_is_full_both_ways_loses_no_answer():
    flight = Flight()
    flight.send("s")
    flight.run_ms(100)
    del flight.messages[:]
    for _ in range(100):
        flight.send("m")
        flight.run_ms(3)
    flight.run_ms(200)
    assert sum(each.type == "m" for each in flight.messages) == 100
    assert flight.rig.serial.overruns == 0
    status = flight.status()
    assert (status.frame_errors, status.frames_lost) == (0, 0)


def test_at_9600_baud_the_line_is_loaded_to_70_percent_at_most():
    flight = Flight("BAUD=9600", boots=False)
    flight.rig.serial.set_baud(9600)
    flight.run_ms(1400)
    flight.send("s")
    flight.run_ms(500)
    flight.rig.serial.read()
    count = 0
    for _ in range(40):
        flight.rig.run_us(100_000)
        count += len(flight.rig.serial.read())
    longest_frame = 32
    assert 0.3 * 960 * 4 < count <= 0.7 * 960 * 4 + longest_frame


@pytest.mark.parametrize("aux1", [LOW, 1500])
def test_the_two_longest_commands_in_a_row_are_answered(aux1):
    flight = Flight(aux1=aux1)
    flight.send("s")
    flight.run_ms(200)
    profile, gains = flight.ask("c"), struct.pack(">18f", *[1.0] * 18)
    for shift_us in range(0, 2000, 400):
        flight.run(shift_us)
        del flight.messages[:]
        asked = [flight.send("g", gains), flight.send("C", profile)]
        flight.run_ms(120)
        assert [each.payload[1] for each in flight.messages if each.type == "K"] == asked
    assert flight.status().frame_errors == 0
