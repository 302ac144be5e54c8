"""Pulses in and pulses out, at exact cycles."""

import pytest

from tests.arduino.rig.firmware import rig_with

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
    rig.servo.forget()
    rig.receiver.set("ailerons", 1723.5)
    rig.run_us(100_000)
    assert rig.servo.newest_us("ailerons") == 1723.5
