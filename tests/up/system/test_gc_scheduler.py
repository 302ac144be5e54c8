"""The garbage collector works only where the program lets it."""

import gc

import pytest
from twisted.internet.task import Clock

from up.system import gc_scheduler
from up.system.gc_scheduler import FULL_PERIOD_S, PERIOD_S, GcScheduler, frozen_imports


@pytest.fixture
def rounds(monkeypatch):
    found = []
    monkeypatch.setattr(gc_scheduler.gc, "collect", lambda generation=2: found.append(generation))
    return found


@pytest.fixture
def clock():
    return Clock()


def test_what_is_imported_is_not_collected_even_where_the_import_fails():
    before = gc.get_freeze_count()
    try:
        with pytest.raises(ImportError), frozen_imports():
            assert not gc.isenabled()
            raise ImportError
        assert gc.isenabled()
        assert gc.get_freeze_count() > before
    finally:
        gc.unfreeze()


def test_it_takes_over_and_gives_back(clock):
    collector = GcScheduler(clock)
    collector.start()
    try:
        assert not gc.isenabled()
        assert gc.get_freeze_count() > 1000
    finally:
        collector.stop()
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0
    assert not clock.getDelayedCalls()
    collector.stop()


def test_young_garbage_every_second_and_old_now_and_then(clock, rounds):
    for collector, full_every in (
        (GcScheduler(clock), round(FULL_PERIOD_S / PERIOD_S)),
        (GcScheduler(clock, full_period_s=3 * PERIOD_S), 3),
    ):
        collector.start()
        clock.pump([PERIOD_S] * full_every)
        collector.stop()
        assert rounds == [2, *[1] * (full_every - 1), 2]
        rounds.clear()


def test_cycles_that_modules_make_are_really_freed(clock):
    class Node:
        pass

    import weakref

    collector = GcScheduler(clock)
    collector.start()
    try:
        node = Node()
        node.itself = node
        gone = weakref.ref(node)
        del node
        clock.advance(1.0)
        assert gone() is None
    finally:
        collector.stop()
