"""A timeout that is restarted often."""

from twisted.internet.task import Clock

from up_runner.watchdog import Watchdog


def test_it_expires_once_after_the_last_reset():
    clock, expired = Clock(), []
    watchdog = Watchdog(clock, 2.0, lambda: expired.append(clock.seconds()))
    clock.advance(100)
    assert expired == []
    for _ in range(30):
        watchdog.reset()
        clock.advance(0.1)
    assert expired == [] and len(clock.getDelayedCalls()) == 1
    clock.pump([0.5] * 10)
    assert len(expired) == 1 and 104.8 < expired[0] < 105.5
    assert not watchdog.running and clock.getDelayedCalls() == []


def test_a_stopped_one_does_not_expire():
    clock, expired = Clock(), []
    watchdog = Watchdog(clock, 2.0, lambda: expired.append(1))
    watchdog.reset()
    watchdog.stop()
    watchdog.stop()
    clock.advance(10)
    assert expired == []
    watchdog.reset()
    clock.advance(2)
    assert expired == [1]


def test_a_reset_on_expiry_restarts_it():
    clock = Clock()
    expired = []

    def on_expired():
        expired.append(clock.seconds())
        watchdog.reset()

    watchdog = Watchdog(clock, 1.0, on_expired)
    watchdog.reset()
    clock.pump([0.5] * 8)
    assert expired == [1.0, 2.0, 3.0, 4.0]
    watchdog.stop()
