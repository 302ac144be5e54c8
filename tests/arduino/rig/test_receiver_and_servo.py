"""Pulses in and pulses out, at exact cycles."""

import itertools

import pytest

from tests.arduino.rig.firmware import rig_with
from up_rig import CHANNELS, PROTOTYPE

LATENCY_CYCLES = 5000 * 16


@pytest.fixture
def rig(tmp_path):
    return rig_with("pulse", tmp_path)


def pulses_of(rig, channel="ailerons"):
    return [pulse for pulse in rig.receiver.sent if pulse.channel == channel]


def test_a_hardware_output_follows_the_stick_without_jitter(rig):
    rig.receiver.sticks(ailerons=1600)
    rig.receiver.start(at_us=100_000)
    rig.run_until_us(900_000)
    sent, got = pulses_of(rig), rig.servo.pulses("ailerons")
    assert len(got) >= 39
    assert {pulse.width_cycles for pulse in got} == {1600 * 16}
    latencies = {out.rise_cycle - into.rise_cycle for into, out in zip(sent, got, strict=False)}
    assert len(latencies) == 1
    assert abs(latencies.pop() - LATENCY_CYCLES) < 4 * 16


def test_both_outputs_of_a_timer_rise_in_the_same_cycle(rig):
    rig.receiver.start(at_us=100_000)
    rig.run_until_us(300_000)
    assert rig.servo.pulses("ailerons") == rig.servo.pulses("elevator") != []


def test_outputs_that_the_program_leaves_alone_have_no_edge(rig):
    rig.receiver.start(at_us=100_000)
    rig.run_until_us(300_000)
    assert rig.servo.edges("throttle") == rig.servo.edges("rudder") == []


def test_a_stick_that_moves_is_seen_in_the_next_frame(rig):
    rig.receiver.start(at_us=100_000)
    rig.run_until_us(200_000)
    rig.servo.clear()
    rig.receiver.set("ailerons", 1723.5)
    rig.run_us(100_000)
    assert rig.servo.newest_us("ailerons") == 1723.5


def test_the_last_pulse_is_known_whether_edges_are_recorded_or_not(rig):
    assert rig.servo.last_pulse("ailerons") is None
    rig.receiver.sticks(ailerons=1600)
    rig.receiver.start(at_us=100_000)
    rig.run_until_us(300_000)
    last = rig.servo.pulses("ailerons")[-1]
    rig.servo.clear()
    assert rig.servo.last_pulse("ailerons") == last
    rig.servo.record(False)
    rig.receiver.set("ailerons", 1723.5)
    rig.run_us(100_000)
    assert rig.servo.edges("ailerons") == []
    newer = rig.servo.last_pulse("ailerons")
    assert newer.width_us == 1723.5
    assert 60_000 < (newer.rise_cycle - last.rise_cycle) / 16 < 140_000
    assert rig.servo.last_pulse("throttle") is None


def levels(rig):
    return {channel: rig.receiver.level(channel) for channel in CHANNELS}


def test_channels_follow_each_other_or_start_together(rig):
    rig.receiver.start(at_us=1000)
    rig.run_until_us(20_000)
    first = rig.receiver.sent[:6]
    assert [pulse.channel for pulse in first] == list(CHANNELS)
    for before, after in itertools.pairwise(first):
        assert after.rise_cycle - before.rise_cycle - before.width_cycles == 10 * 16
    rig.receiver.is_simultaneous = True
    rig.receiver.period_us = 7_000
    rig.run_us(60_000)
    frame = rig.receiver.sent[-6:]
    assert {pulse.rise_cycle for pulse in frame} == {frame[0].rise_cycle}
    assert (frame[0].rise_cycle - rig.receiver.sent[-12].rise_cycle) == 7_000 * 16


def test_a_wire_moves_at_its_cycle(rig):
    rig.receiver.sticks(throttle=1234.0625)
    rig.receiver.start(at_us=70_000)
    rig.run_until_us(70_000)
    pulse = next(each for each in rig.receiver.sent if each.channel == "throttle")
    assert pulse.width_cycles == 1234.0625 * 16
    for edge, before, after in (
        (pulse.rise_cycle, 0, 1),
        (pulse.rise_cycle + pulse.width_cycles, 1, 0),
    ):
        rig.run_until_cycle(edge - 8)
        assert rig.receiver.level("throttle") == before
        rig.run_until_cycle(edge + 1)
        assert rig.receiver.level("throttle") == after


def test_a_channel_can_be_lost_low_or_high_and_come_back(rig):
    rig.receiver.start(at_us=0)
    rig.run_until_us(90_000)
    rig.receiver.stop("rudder")
    rig.receiver.stop("aux1", level=1)
    rig.run_until_us(198_000)
    assert levels(rig) == {**dict.fromkeys(CHANNELS, 0), "aux1": 1}
    late = [pulse for pulse in rig.receiver.sent if pulse.rise_cycle > 95_000 * 16]
    assert {pulse.channel for pulse in late} == set(CHANNELS) - {"rudder", "aux1"}
    rig.receiver.resume("aux1")
    rig.receiver.resume("rudder")
    rig.run_until_us(238_000)
    assert levels(rig) == dict.fromkeys(CHANNELS, 0)
    assert {pulse.channel for pulse in rig.receiver.sent[-6:]} == set(CHANNELS)


def test_all_channels_stop_and_start_again(rig):
    rig.receiver.start(at_us=0)
    rig.run_until_us(100_000)
    rig.receiver.stop()
    rig.run_until_us(200_000)
    assert max(pulse.rise_cycle for pulse in rig.receiver.sent) <= 120_000 * 16
    rig.receiver.start()
    rig.run_until_us(300_000)
    assert max(pulse.rise_cycle for pulse in rig.receiver.sent) > 280_000 * 16


def test_jitter_stays_within_its_bounds_and_is_repeated_by_the_seed(tmp_path):
    def fly(seed):
        rig = rig_with("pulse", tmp_path, seed=seed)
        rig.receiver.jitter_us = 2.0
        rig.receiver.period_jitter_us = 50.0
        rig.receiver.start(at_us=0)
        rig.run_until_us(600_000)
        return [pulse.width_cycles for pulse in pulses_of(rig)]

    widths = fly(3)
    assert len(set(widths)) > 10
    assert all(abs(width - 1500 * 16) <= 2 * 16 for width in widths)
    assert fly(3) == widths != fly(4)


def test_noise_is_seen_as_short_as_it_is(rig):
    rig.receiver.set("ailerons", 1500)
    rig.receiver.glitch("ailerons", 150_000, 3.0)
    rig.run_until_us(200_000)
    (pulse,) = rig.servo.pulses("ailerons")
    # The program copies it: what its interrupt took for 3 us, more or less its own length.
    assert pulse.width_us < 10


def test_a_channel_that_does_not_exist_is_refused(rig):
    with pytest.raises(KeyError):
        rig.receiver.set("flaps", 1500)


def test_the_prototypes_board_has_its_wires_elsewhere(tmp_path):
    rig = rig_with("pulse", tmp_path, pins=PROTOTYPE)
    assert PROTOTYPE.servos["throttle"] == 8 + 1
    rig.receiver.start(at_us=0)
    rig.run_until_us(200_000)
    # D2 is not an input of that board, so the program sees no pulse.
    assert rig.servo.pulses("ailerons") == []
