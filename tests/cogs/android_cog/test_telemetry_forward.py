"""Telemetry for the phone: at a low rate, and the newest."""

from itertools import pairwise

from android_cog.telemetry_forward import TelemetryForward
from twisted.internet.task import Clock

from up.commands.telemetry_commands import TelemetryCommand


def frame(number):
    return TelemetryCommand({}, number)


def forward(interval_s=0.5):
    clock, sent = Clock(), []
    made = TelemetryForward(clock, interval_s, lambda f: sent.append((clock.seconds(), f.beacon)))
    return clock, sent, made


def test_at_most_one_frame_an_interval_and_the_newest_wins():
    clock, sent, telemetry = forward()
    for number in range(21):
        telemetry.offer(frame(number))
        clock.advance(0.125)
    assert [number for _, number in sent] == [0, 3, 7, 11, 15, 19]
    times = [time_s for time_s, _ in sent]
    assert all(b - a >= 0.5 for a, b in pairwise(times))


def test_a_frame_after_silence_leaves_at_once():
    clock, sent, telemetry = forward()
    telemetry.offer(frame(1))
    clock.advance(3)
    telemetry.offer(frame(2))
    assert sent == [(0, 1), (3, 2)]


def test_panic_makes_it_slower_and_never_faster():
    clock, sent, telemetry = forward()
    telemetry.min_interval_s = 1.0
    for number in range(5):
        telemetry.offer(frame(number))
        clock.advance(0.5)
    assert [time_s for time_s, _ in sent] == [0, 1, 2]
    telemetry.min_interval_s = 0.05
    telemetry.discard()
    telemetry.offer(frame(8))
    telemetry.offer(frame(9))
    clock.advance(0.25)
    assert sent[-1] == (2.5, 8)


def test_nothing_waits_across_a_reconnect():
    clock, sent, telemetry = forward()
    telemetry.offer(frame(1))
    telemetry.offer(frame(2))
    telemetry.discard()
    clock.advance(10)
    assert sent == [(0, 1)]
    telemetry.offer(frame(3))
    clock.advance(10)
    assert sent == [(0, 1), (10, 3)]
    assert not clock.getDelayedCalls()
