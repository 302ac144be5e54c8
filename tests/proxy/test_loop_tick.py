"""The tick and its lateness."""

import pytest
from twisted.internet.task import Clock

from up_proxy.loop_tick import TICK_S, LoopTick


def test_it_ticks_until_stopped_and_measures_its_lateness():
    clock, ticks = Clock(), []
    tick = LoopTick(clock, lambda: ticks.append(clock.seconds()))
    tick.start()
    clock.pump([TICK_S] * 4)
    assert ticks == pytest.approx([TICK_S, 2 * TICK_S, 3 * TICK_S, 4 * TICK_S])
    assert tick.lag_max_s == pytest.approx(0)
    clock.advance(TICK_S + 0.1)
    assert tick.lag_s == pytest.approx(0.1)
    clock.advance(TICK_S)
    assert tick.lag_s == pytest.approx(0)
    assert tick.lag_max_s == pytest.approx(0.1)
    assert tick.uptime_s == pytest.approx(6 * TICK_S + 0.1)
    tick.stop()
    tick.stop()
    clock.advance(10)
    assert len(ticks) == 6
    assert clock.getDelayedCalls() == []
