"""Noise on the serial line, loose contacts, and the socket that stands for the port."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.in_process.serial_wire import SerialNoise, SerialWire, SocketLine


class Line:
    """Gives back what is written to it."""

    def __init__(self):
        self.held = b""

    def read(self, timeout_s, most):
        data, self.held = self.held[:most], self.held[most:]
        return data

    def write(self, data):
        self.held += data


def passed(data, seed=1, **noise):
    wire = SerialWire(Line(), seed, SerialNoise(**noise))
    wire.write(data)
    return wire._line.held, wire.spoilt


@given(st.binary(max_size=300))
def test_a_good_wire_changes_nothing(data):
    assert passed(data) == (data, 0)


@given(st.binary(max_size=300), st.integers(0, 1000))
def test_the_same_seed_spoils_the_same_bytes(data, seed):
    noise = {"flips": 0.1, "inserts": 0.1, "drops": 0.1}
    assert passed(data, seed, **noise) == passed(data, seed, **noise)


@given(st.binary(max_size=300))
def test_flips_turn_one_bit_of_a_byte(data):
    arrived, spoilt = passed(data, flips=1.0)
    assert spoilt == len(data) == len(arrived)
    assert all((one ^ other).bit_count() == 1 for one, other in zip(data, arrived, strict=True))


@given(st.binary(max_size=300))
def test_drops_and_inserts_lose_and_add_whole_bytes(data):
    assert passed(data, drops=1.0) == (b"", len(data))
    arrived, spoilt = passed(data, inserts=1.0)
    assert arrived[1::2] == data
    assert spoilt == len(data)


def test_noise_comes_as_often_as_asked():
    _, spoilt = passed(bytes(100_000), flips=0.01)
    assert 850 < spoilt < 1150


def test_a_loose_wire_is_silent_both_ways():
    wire = SerialWire(Line())
    wire.is_connected = False
    wire.write(b"from the board")
    assert wire._line.held == b""
    wire._line.held = b"to the board"
    assert wire.read(0.0, 100) == b""
    wire.is_connected = True
    wire.write(b"again")
    assert wire.read(0.0, 100) == b"again"


@pytest.mark.parametrize("name", ["flips", "inserts", "drops"])
@pytest.mark.parametrize("value", [-0.1, 1.1, float("nan")])
def test_what_is_no_probability_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=name):
        SerialNoise(**{name: value})


def test_a_line_passes_bytes_at_once_and_ends_with_a_hang_up():
    line = SocketLine()
    assert line.read(0.0, 10) == b""
    line.write(b"nobody has opened it")
    with line.open() as other:
        line.write(b"abc")
        assert os.read(other.fileno(), 10) == b"abc"
        other.send(b"defg")
        assert (line.read(0.0, 3), line.read(0.0, 3)) == (b"def", b"g")
        line.unplug()
        assert not line.is_plugged
        assert os.read(other.fileno(), 10) == b""


def test_opening_a_line_again_hangs_up_on_the_end_before():
    line = SocketLine()
    with line.open() as first, line.open() as second:
        assert os.read(first.fileno(), 10) == b""
        line.write(b"x")
        assert os.read(second.fileno(), 10) == b"x"
        line.cut()
        assert second.fileno() == -1
