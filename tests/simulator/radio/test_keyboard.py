import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.radio.keyboard import HOLD_S, KeyboardSticks, KeyReader
from up_simulator.radio.sticks import Sticks


def pressed(*keys, start=None):
    keyboard = KeyboardSticks(start)
    for key in keys:
        keyboard.press(key, 0.0)
    return keyboard.sticks(0.0)


@pytest.mark.parametrize(
    ("key", "channel", "sign"),
    [
        ("left", "ailerons", -1),
        ("right", "ailerons", 1),
        ("up", "elevator", -1),
        ("down", "elevator", 1),
        ("a", "rudder", -1),
        ("d", "rudder", 1),
        ("w", "throttle", 1),
    ],
)
def test_a_key_moves_its_stick_by_a_step(key, channel, sign):
    before, after = getattr(Sticks(), channel), getattr(pressed(key), channel)
    assert (after - before) * sign in (50, 60)
    assert pressed(*[key] * 40) == pressed(*[key] * 41), "and no further than its end"


def test_the_throttle_does_not_go_below_its_end():
    assert pressed("s", "s").throttle == 1000


@pytest.mark.parametrize(("key", "mode"), [("1", "ACRO"), ("2", "FBW"), ("3", "AUTO")])
def test_a_number_moves_the_mode_switch(key, mode):
    assert pressed(key).mode == mode


def test_space_moves_the_arming_switch_there_and_back():
    assert pressed(" ").is_armed
    assert not pressed(" ", " ").is_armed


def test_a_released_stick_recentres_and_the_throttle_stays():
    keyboard = KeyboardSticks()
    for key in ("right", "right", "down", "w", "a"):
        keyboard.press(key, 0.0)
    assert keyboard.sticks(HOLD_S).ailerons == 1620, "a held key repeats: it stays"
    going = keyboard.sticks(HOLD_S + 0.05)
    assert 1500 < going.ailerons < 1620
    at_rest = keyboard.sticks(HOLD_S + 0.2)
    assert (at_rest.ailerons, at_rest.elevator, at_rest.rudder) == (1500, 1500, 1500)
    assert at_rest.throttle == 1050


def test_x_centres_at_once():
    sticks = pressed("left", "up", "d", "w", "x")
    assert (sticks.ailerons, sticks.elevator, sticks.rudder) == (1500, 1500, 1500)
    assert sticks.throttle == 1050


def test_it_starts_with_the_sticks_of_the_other_pilot():
    start = Sticks(throttle=1600, aux1=2000, aux2=2000)
    assert pressed("left", start=start) == start.moved("ailerons", 1440)


def test_other_keys_move_nothing():
    assert not KeyboardSticks().press("k", 0.0)


@given(st.lists(st.tuples(st.sampled_from([*"wsad123x k", "left", "up"]), st.floats(0, 3))))
def test_pulses_stay_in_range_and_all_ends_in_the_middle(presses):
    keyboard, now_s = KeyboardSticks(), 0.0
    for key, passed_s in presses:
        now_s += passed_s
        keyboard.press(key, now_s)
        sticks = keyboard.sticks(now_s)
        assert all(1000 <= getattr(sticks, each) <= 2000 for each in ("ailerons", "throttle"))
    at_rest = keyboard.sticks(now_s + 3.0)
    assert (at_rest.ailerons, at_rest.elevator, at_rest.rudder) == (1500, 1500, 1500)


@pytest.mark.parametrize(
    ("data", "keys"),
    [
        (b"\x1b[A\x1b[B\x1b[C\x1b[D", ["up", "down", "right", "left"]),
        (b"\x1bOA", ["up"]),
        (b"\x1b[1;2C", ["right"]),
        (b"\x1b[3~w", ["w"]),
        (b"\x1b1", ["1"]),
        (b"\x1b\x1b[A", ["up"]),
        (b"\x00\x7f\xc3\xa4 ?", [" ", "?"]),
    ],
)
def test_bytes_become_keys(data, keys):
    assert KeyReader().feed(data) == keys


@given(st.binary(max_size=200), st.integers(1, 5))
def test_keys_do_not_depend_on_how_the_bytes_come(data, size):
    reader, keys = KeyReader(), []
    for at in range(0, len(data), size):
        keys += reader.feed(data[at : at + size])
    assert keys == KeyReader().feed(data)


@given(st.binary(max_size=60))
def test_after_any_rubbish_the_keyboard_still_works(rubbish):
    reader = KeyReader()
    reader.feed(rubbish)
    assert reader.feed(b"\x1b[Aw")[-2:] == ["up", "w"]
