import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.receiver import POWERED, SOARING, Receiver, StickMove, SticksError, read_sticks


def test_a_script_is_read():
    assert read_sticks("aileron=1600 t=5 elevator=1400, t=6.5 receiver=off aux1=2000") == [
        StickMove(0.0, "ailerons", 1600),
        StickMove(5.0, "elevator", 1400),
        StickMove(6.5, "receiver", 0),
        StickMove(6.5, "aux1", 2000),
    ]
    assert read_sticks(SOARING)
    assert read_sticks(POWERED)


@pytest.mark.parametrize(
    ("script", "what"),
    [
        ("aileron", "name=value"),
        ("aileron=799", "800 to 2200"),
        ("aileron=2201", "800 to 2200"),
        ("aileron=fast", "800 to 2200"),
        ("flaps=1500", "not understood"),
        ("receiver=maybe", "not understood"),
        ("t=soon", "number of seconds"),
        ("t=nan", "does not come after"),
        ("t=5 t=4", "does not come after t=5"),
        ("t=-1", "does not come after"),
    ],
)
def test_a_wrong_script_is_one_sentence(script, what):
    with pytest.raises(SticksError, match=what) as error:
        read_sticks(script)
    assert "\n" not in str(error.value)


@given(st.text(max_size=60))
def test_any_text_is_read_or_refused(text):
    try:
        moves = read_sticks(text)
    except SticksError:
        return
    assert all(move.time_s >= 0.0 for move in moves)


def test_it_hears_50_times_a_second_with_a_us_of_noise():
    receiver = Receiver(read_sticks("aileron=1600"), 100.0)
    heard = []
    for tick in range(1000):
        if receiver.listen(100.0 + tick * 0.005):
            heard.append(receiver.pulses_us)
    assert len(heard) == 250
    assert {pulses[0] for pulses in heard} == {1599, 1600, 1601}


def test_sticks_move_when_the_script_says():
    receiver = Receiver(read_sticks("t=1 throttle=1800 t=2 receiver=off t=3 receiver=on"), 0.0)
    receiver.listen(0.98)
    assert abs(receiver.pulses_us[2] - 1000) <= 1
    assert receiver.listen(1.0)
    assert abs(receiver.pulses_us[2] - 1800) <= 1
    assert not receiver.listen(2.0)
    assert receiver.heard_s == 1.0
    assert receiver.listen(3.0)
    assert receiver.heard_s == 3.0


def test_the_noise_is_that_of_the_seed():
    def heard(seed):
        receiver = Receiver([], 0.0, seed)
        return [receiver.listen(tick * 0.02) and receiver.pulses_us for tick in range(20)]

    assert heard(1) == heard(1)
    assert heard(1) != heard(2)
