"""Every Command of protocols 2.3 and its answer."""

import itertools
import math
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.simulator.bench import Bench
from tests.simulator.pi import frame, vectors
from up_simulator.wire import COMMAND_SIZES

REASONS = range(1, 13)


def floats(*values):
    return struct.pack(f">{len(values)}f", *values)


def profile(**changes):
    """The bytes of a right profile, with bytes at offsets changed."""
    channel = struct.pack(">BhHH", 0, 0, 1000, 2000)
    wire = bytearray(
        channel * 4
        + bytes([0, 1])
        + b"afA"
        + struct.pack(">5h", 5000, 2000, 2500, -300, 2000)
        + struct.pack(">5H", 1000, 900, 1500, 1500, 1500)
        + b"\0"
    )
    assert len(wire) == 54
    for at, data in changes.items():
        offset = int(at.removeprefix("at"))
        wire[offset : offset + len(data)] = data
    return bytes(wire)


@pytest.mark.parametrize(
    "vector",
    [each for each in vectors("serial_checked.json") if each["direction"] == "to_arduino"],
    ids=lambda vector: vector["type"],
)
def test_every_command_of_the_vectors_is_answered_or_is_a_stream(vector):
    bench = Bench("t=0 aux2=1000 t=1 aux2=1000")
    bench.run(0.5)
    bench.listener.take()
    bench.board.data_received(bytes.fromhex(vector["wire"]))
    answers = bench.listener.take()
    kind = vector["type"]
    own = {"m": "m", "T": "T", "G": "G", "c": "C"}.get(kind, "K")
    if kind in "hblBv":
        assert answers == []
    elif kind in "uS":
        assert all(each.type == "!" for each in answers)
    else:
        assert len(answers) == 1
        assert answers[0].type in (own, "!")
        if answers[0].type in ("K", "!"):
            assert answers[0].payload[:2] == bytes([ord(kind), vector["sequence"]])


def test_nothing_is_streamed_before_start_and_all_streams_after_it():
    bench = Bench(start=False)
    bench.run(1.0)
    assert bench.listener.take() == []
    assert bench.confirmed("s")
    bench.run(1.0)
    assert {each.type for each in bench.listener.take()} == {"r", "i", "O", "x"}


def test_opening_sends_one_extra_zero():
    bench = Bench(start=False)
    bench.board.opened()
    assert bench.raw == b"\0"


def test_its_frames_count_up_without_a_gap():
    bench = Bench()
    bench.run(3.0)
    numbers = [each.sequence for each in bench.listener.take()]
    assert len(numbers) > 256
    assert all((b - a) % 256 == 1 for a, b in itertools.pairwise(numbers))


def test_streams_have_their_periods():
    bench = Bench()
    bench.run(2.0)
    counts = {}
    for each in bench.listener.take():
        counts[each.type] = counts.get(each.type, 0) + 1
    assert counts == {"r": 100, "i": 100, "O": 100, "x": 10}


def test_orientation_says_the_state_in_wire_order_with_a_sequence_of_its_own():
    bench = Bench()
    bench.run(0.06)
    payloads = [each.payload for each in bench.listener.take("O")]
    assert [struct.unpack(">H", each[:2])[0] for each in payloads] == [0, 1, 2]
    assert struct.unpack(">6f", payloads[0][2:]) == (10.5, -5.5, 3.25, 1.0, -0.25, 0.5)


def test_inputs_say_the_six_sticks_and_their_validity():
    bench = Bench("t=0 aileron=1601 elevator=1402 t=1 receiver=off")
    bench.run(0.5)
    values = struct.unpack(">6HB", bench.listener.take("i")[-1].payload)
    expected = (1601, 1402, 1000, 1500, 2000, 1000)
    assert all(abs(a - b) <= 1 for a, b in zip(values, expected, strict=False))
    assert values[6] == 0x3F
    bench.run(1.0)
    assert bench.listener.take("i")[-1].payload[12] == 0


def test_a_pulse_outside_885_to_2115_has_no_validity_bit():
    bench = Bench("t=0 rudder=2200")
    bench.run(0.1)
    assert bench.listener.take("i")[-1].payload[12] == 0x3F & ~(1 << 3)


def test_panic_sets_the_period_of_streams():
    bench = Bench()
    bench.run(0.1)
    assert bench.confirmed("p", b"\x01\x00\x96")
    bench.run(0.2)
    bench.listener.take()
    bench.run(3.0)
    taken = [each.type for each in bench.listener.take()]
    assert [taken.count(letter) for letter in "riOx"] == [20, 20, 20, 15]
    assert bench.confirmed("p", b"\x00\x00\x14")
    bench.run(1.0)
    assert len(bench.listener.take("r")) >= 49


@pytest.mark.parametrize(
    "payload", [b"\x02\x00\x96", b"\x01\x00\x09", b"\x01\x03\xe9", b"\x01\xff\xff"]
)
def test_a_panic_out_of_range_is_refused(payload):
    bench = Bench()
    assert bench.refused("p", payload) == 3
    assert bench.board.period_s == 0.02


def test_panic_never_slows_what_the_pi_flies_by():
    bench = Bench()
    bench.run(0.5)
    bench.send("p", b"\x01\x00\x96")
    for _ in range(100):
        assert bench.output((1500, 1500, 0, 1500), bench.newest_orientation()) is None
    started = bench.clock.seconds()
    sequences = [bench.newest_orientation() for _ in range(5)]
    assert sequences == list(range(sequences[0], sequences[0] + 5))
    assert bench.clock.seconds() - started <= 0.11
    bench.run(0.1)
    taken = [each.type for each in bench.listener.take()]
    assert taken.count("i") >= 4
    assert taken.count("r") <= 1


def test_gains_of_three_axes_are_held():
    bench = Bench()
    wanted = floats(*(each / 4 for each in range(18)))
    assert bench.confirmed("g", wanted)
    assert bench.answer("G") == ("G", wanted)


def test_gains_of_two_axes_leave_the_rudder_its_own():
    bench = Bench()
    three = floats(*range(18))
    bench.send("g", three)
    two = floats(*(each + 20 for each in range(12)))
    assert bench.confirmed("t", two)
    assert bench.answer("T") == ("T", two)
    held = bench.answer("G")[1]
    assert held[24:36] == three[24:36]
    assert held[60:72] == three[60:72]
    assert held[0:24] == two[0:24]
    assert held[36:60] == two[24:48]


@pytest.mark.parametrize("bad", [math.nan, math.inf, -0.001, 50.5])
@pytest.mark.parametrize(("letter", "ask", "count"), [("t", "T", 12), ("g", "G", 18)])
def test_gains_with_one_wrong_value_are_refused_whole(letter, ask, count, bad):
    bench = Bench()
    before = bench.answer(ask)
    for position in range(count):
        values = [1.0] * count
        values[position] = bad
        assert bench.refused(letter, floats(*values)) == 3
    assert bench.answer(ask) == before


def test_a_profile_is_held_and_only_taken_disarmed():
    bench = Bench("t=1 aux2=1000")
    assert bench.confirmed("C", profile())
    assert bench.answer("c") == ("C", profile())
    armed = Bench()
    armed.run(2.0)
    armed.listener.take()
    before = armed.answer("c")
    assert armed.refused("C", profile()) == 4
    assert armed.answer("c") == before


@pytest.mark.parametrize(
    "changes",
    [
        {"at0": b"\x02"},
        {"at1": struct.pack(">h", 201)},
        {"at3": struct.pack(">H", 799)},
        {"at5": struct.pack(">H", 2201)},
        {"at3": struct.pack(">2H", 1600, 1600)},
        {"at28": b"\x03"},
        {"at29": b"\x02"},
        {"at30": b"afx"},
        {"at33": struct.pack(">h", -1)},
        {"at39": struct.pack(">h", 9001)},
        {"at43": struct.pack(">H", 2201)},
        {"at47": struct.pack(">H", 0)},
        {"at53": b"\x02"},
    ],
)
def test_a_profile_out_of_range_is_refused_whole(changes):
    bench = Bench("t=1 aux2=1000")
    before = bench.answer("c")
    assert bench.refused("C", profile(**changes)) == 3
    assert bench.answer("c") == before


def test_the_flight_mode_is_told_and_asked_only_at_auto():
    bench = Bench("t=1 aux1=1500")
    bench.run(0.5)
    assert bench.answer("m") == ("m", b"a")
    for letter in b"rfsu":
        assert bench.confirmed("M", bytes([letter]))
    for letter in b"aAhx\0\xff":
        assert bench.refused("M", bytes([letter])) == 3
    bench.run(1.0)
    assert bench.refused("M", b"f") == 7


@pytest.mark.parametrize("what", [0, 1, 3])
def test_calibration_is_confirmed_lying_still(what):
    assert Bench("t=1 aux2=1000").confirmed("e", bytes([what]))


def test_calibration_is_refused_moving_armed_or_unknown():
    bench = Bench("t=1 aux2=1000")
    bench.flight.state = bench.flight.state.__class__(
        *(getattr(bench.flight.state, name) + 9.0 for name in bench.flight.state.__slots__)
    )
    assert bench.refused("e", b"\x00") == 12
    assert bench.refused("e", b"\x03") == 12
    assert bench.refused("e", b"\x04") == 3
    assert bench.refused("e", b"\x02") == 3
    armed = Bench()
    armed.run(2.0)
    assert armed.refused("e", b"\x00") == 4


def test_finding_end_points_vetoes_arming_until_it_ends():
    bench = Bench("t=1 aux2=1000")
    bench.send("e", b"\x01")
    assert bench.status()[4] & 1 << 5
    assert bench.confirmed("e", b"\x02")
    assert not bench.status()[4] & 1 << 5


@pytest.mark.parametrize(
    ("letter", "payload"),
    [
        ("b", struct.pack(">h", 360)),
        ("B", struct.pack(">h", -1)),
        ("l", floats(90.5, 0.0)),
        ("l", floats(math.nan, 0.0)),
        ("l", floats(0.0, -181.0)),
        ("u", struct.pack(">5H", 999, 1500, 0, 1500, 0)),
        ("u", struct.pack(">5H", 1500, 2001, 0, 1500, 0)),
        ("u", struct.pack(">5H", 1500, 1500, 999, 1500, 0)),
        ("S", struct.pack(">3h2H", 0, 0, 0, 0, 0)),
        ("S", struct.pack(">3h2H", 0, 0, 0, 0, 251)),
        ("S", struct.pack(">3h2H", 0, 9001, 0, 0, 100)),
        ("S", struct.pack(">3h2H", 0, 0, 0, 500, 100)),
        ("v", b"\x02"),
    ],
)
def test_a_stream_out_of_range_is_refused(letter, payload):
    bench = Bench()
    bench.run(0.5)
    assert bench.refused(letter, payload) == 3


def test_a_stream_is_refused_at_most_once_a_second():
    bench = Bench()
    count = 0
    for _ in range(100):
        count += bench.refused("b", b"\x7f\xff") is not None
        bench.clock.advance(0.03)
    assert count == 3


def test_unknown_types_and_wrong_sizes_are_named_and_counted():
    bench = Bench()
    assert bench.refused("Z") == 1
    assert bench.refused("O", bytes(26)) == 1
    assert bench.refused("p", b"\x01") == 2
    assert struct.unpack(">H", bench.status()[10:12])[0] == 3


@given(st.lists(st.tuples(st.sampled_from(sorted(COMMAND_SIZES)), st.data()), max_size=20))
@settings(max_examples=100, deadline=None)
def test_any_payloads_are_answered_by_the_book(sequence):
    bench = Bench()
    bench.run(0.1)
    bench.listener.take()
    for letter, data in sequence:
        size = COMMAND_SIZES[letter]
        answers = bench.send(letter, data.draw(st.binary(min_size=size, max_size=size)))
        assert len(answers) <= 1
        for each in answers:
            assert each.type in "K!mTGC"
            if each.type == "!":
                assert each.payload[2] in REASONS
    bench.run(0.1)
    assert all(800 <= pulse <= 2200 for pulse in bench.flight.servos)


@given(st.binary(max_size=300))
@settings(deadline=None)
def test_garbage_stops_nothing(garbage):
    bench = Bench()
    bench.board.data_received(garbage + b"\0")
    bench.run(0.05)
    bench.listener.take()
    bench.board.data_received(frame(0, "m"))
    assert [each.type for each in bench.listener.take("m")] == ["m"]
