"""A game controller: its bytes, its map, and what happens when it is pulled out."""

import os
import struct
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.radio.axis_map import JsEvent, JsEventReader, MappedSticks, read_axis_map
from up_simulator.radio.game_controller import GameController, controller_device
from up_simulator.radio.sticks import RadioError

AXIS, BUTTON, INIT = 2, 1, 0x80


def event(number, value, kind=AXIS):
    return struct.pack("=IhBB", 4711, value, kind, number)


def test_axes_buttons_and_the_state_at_the_opening_are_read():
    data = event(3, -32767) + event(1, 1, BUTTON) + event(0, 5, AXIS | INIT)
    assert JsEventReader().feed(data) == [
        JsEvent(3, -32767, True),
        JsEvent(1, 1, False),
        JsEvent(0, 5, True),
    ]


def test_an_unknown_kind_is_left_out():
    assert JsEventReader().feed(event(0, 1, 4) + event(0, 2)) == [JsEvent(0, 2, True)]


@given(st.binary(max_size=200), st.integers(1, 9))
def test_events_do_not_depend_on_how_the_bytes_come(data, size):
    reader, events = JsEventReader(), []
    for at in range(0, len(data), size):
        events += reader.feed(data[at : at + size])
    assert events == JsEventReader().feed(data)
    assert len(events) <= len(data) // 8


@pytest.mark.parametrize(
    ("text", "value", "pulse_us"),
    [
        ("elevator=1", 0, 1500),
        ("elevator=1", 32767, 2000),
        ("elevator=1", -32767, 1000),
        ("elevator=1", -32768, 1000),
        ("elevator=1-", 32767, 1000),
        ("elevator=1 dead=0.1", 3000, 1500),
        ("elevator=1 dead=0.1", -3000, 1500),
        ("elevator=1 dead=0.1", 32767, 2000),
        ("elevator=1 dead=0.5", 24575, 1750),
        ("elevator=1:-20000..1000..31000", 1000, 1500),
        ("elevator=1:-20000..1000..31000", 16000, 1750),
        ("elevator=1:-20000..1000..31000", -9500, 1250),
        ("elevator=1-:-20000..1000..31000", 31000, 1000),
        ("elevator=1:-20000..1000..31000", 32767, 2000),
    ],
)
def test_an_axis_is_a_pulse(text, value, pulse_us):
    sticks = MappedSticks(read_axis_map(text))
    sticks.take(JsEvent(1, value, True))
    assert sticks.now.elevator == pulse_us


def test_buttons_switch_at_each_press():
    sticks = MappedSticks(read_axis_map("aux1=b5, aux2=b4"))
    seen = []
    for _ in range(3):
        for value in (1, 0):
            sticks.take(JsEvent(5, value, False))
            sticks.take(JsEvent(4, value, False))
        seen.append((sticks.now.mode, sticks.now.is_armed))
    assert seen == [("AUTO", True), ("ACRO", False), ("FBW", True)]


def test_one_axis_may_move_two_channels_and_others_move_none():
    sticks = MappedSticks(read_axis_map("ailerons=0 rudder=0- "))
    sticks.take(JsEvent(0, 32767, True))
    sticks.take(JsEvent(7, 32767, True))
    assert (sticks.now.ailerons, sticks.now.rudder, sticks.now.elevator) == (2000, 1000, 1500)


@pytest.mark.parametrize("preset", ["transmitter", "gamepad"])
def test_presets_move_every_channel(preset):
    assert set(read_axis_map(preset).sources) == {
        "ailerons", "elevator", "throttle", "rudder", "aux1", "aux2",
    }  # fmt: skip


def test_a_preset_can_be_changed():
    assert read_axis_map("gamepad elevator=4-").sources["elevator"].is_reversed


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("", "transmitter"),
        ("dead=0.1", "transmitter"),
        ("flaps=1", "'flaps=1'"),
        ("joystick", "'joystick'"),
        ("ailerons", "'ailerons'"),
        ("ailerons=x", "'ailerons=x'"),
        ("ailerons=999", "'ailerons=999'"),
        ("ailerons=0 dead=0.9", "dead=0.9"),
        ("ailerons=0 dead=nan", "dead=nan"),
        ("aux1=b3-", "'aux1=b3-'"),
        ("ailerons=0:5..5..9", "'ailerons=0:5..5..9'"),
        ("ailerons=0:-40000..0..9", "'ailerons=0:-40000..0..9'"),
    ],
)
def test_an_invalid_map_is_refused_by_its_word(text, word):
    with pytest.raises(RadioError) as caught:
        read_axis_map(text)
    assert word in str(caught.value) and "\n" not in str(caught.value)


@given(st.text(max_size=60) | st.from_regex(r"(ailerons|aux1|dead)=b?-?\d{0,6}[-:.0-9]{0,20}"))
def test_any_text_is_a_map_or_refused(text):
    with suppress(RadioError):
        axis_map = read_axis_map(text)
        sticks = MappedSticks(axis_map)
        for source in axis_map.sources.values():
            for value in (-32768, 0, 32767):
                sticks.take(JsEvent(source.number, value, source.is_axis))
        assert all(1000 <= getattr(sticks.now, each) <= 2000 for each in axis_map.sources)


class Plugged:
    """A FIFO in the place of the kernel's device."""

    def __init__(self, path):
        self.path = path

    def plug(self):
        os.mkfifo(self.path)
        # Both ways open: there is a writer before anybody reads.
        self.file = os.open(self.path, os.O_RDWR | os.O_NONBLOCK)

    def unplug(self):
        self.path.unlink()
        os.close(self.file)


@pytest.fixture
def plugged(tmp_path):
    device = Plugged(tmp_path / "js0")
    device.plug()
    return device


def test_its_bytes_move_the_sticks(plugged):
    controller = GameController(plugged.path, read_axis_map("transmitter dead=0"))
    assert controller.sticks(0.0, None).ailerons == 1500
    os.write(plugged.file, event(0, 32767) + event(2, -32767) + event(5, 32767)[:5])
    sticks = controller.sticks(0.1, None)
    assert (sticks.ailerons, sticks.throttle, sticks.is_armed) == (2000, 1000, False)
    os.write(plugged.file, event(5, 32767)[5:])
    assert controller.sticks(0.2, None).is_armed
    controller.close()


def test_an_unplugged_controller_stops_the_pulses_until_it_is_back(plugged):
    logged = []
    axis_map = read_axis_map("transmitter")
    log = lambda _text, **fields: logged.append(fields["code"])  # noqa: E731
    controller = GameController(plugged.path, axis_map, log)
    os.write(plugged.file, event(0, 32767))
    assert controller.sticks(0.0, None).is_on
    plugged.unplug()
    lost = controller.sticks(0.1, None)
    assert (lost.is_on, lost.ailerons) == (False, 2000)
    assert not controller.sticks(5.0, None).is_on
    plugged.plug()
    os.write(plugged.file, event(0, -32767))
    assert not controller.sticks(5.5, None).is_on, "it retries once a second"
    back = controller.sticks(6.1, None)
    assert (back.is_on, back.ailerons) == (True, 1000)
    assert logged == ["controller_lost", "controller_back"]
    controller.close()


def test_a_missing_controller_is_refused(tmp_path):
    with pytest.raises(RadioError) as error:
        GameController(tmp_path / "js0", read_axis_map("transmitter"))
    assert error.value.code == "controller_missing"


def test_a_controller_without_permission_names_the_group(tmp_path, monkeypatch):
    def refuse(*_arguments):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(RadioError, match="group 'input'"):
        GameController(tmp_path / "js0", read_axis_map("transmitter"))


def test_a_name_is_a_device_and_a_path_is_unchanged():
    assert str(controller_device("js1")) == "/dev/input/js1"
    assert str(controller_device("/tmp/mine")) == "/tmp/mine"
