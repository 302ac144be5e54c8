"""A process that fails to exit is ended."""

import threading

from up.system.forced_end import ForcedEnd


def test_it_ends_with_the_first_status_asked_for():
    ended, statuses = threading.Event(), []

    def end(status):
        statuses.append(status)
        ended.set()

    forced = ForcedEnd(0.01, end)
    forced.start()
    forced.ask(3)
    forced.ask(4)
    assert ended.wait(30)
    forced._thread.join(30)
    assert statuses == [3]


def test_called_off_it_ends_nothing():
    statuses = []
    forced = ForcedEnd(60, statuses.append)
    forced.start()
    forced.ask(3)
    forced.call_off()
    forced._thread.join(30)
    assert not forced._thread.is_alive()
    assert statuses == []
