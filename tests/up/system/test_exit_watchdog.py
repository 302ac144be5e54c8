import threading

from up.system.exit_watchdog import ExitWatchdog


def test_it_ends_with_the_first_status_asked_for():
    ended, statuses = threading.Event(), []

    def end(status):
        statuses.append(status)
        ended.set()

    exits = ExitWatchdog(0.01, end)
    exits.start()
    exits.request(3)
    exits.request(4)
    assert ended.wait(30)
    exits._thread.join(30)
    assert statuses == [3]


def test_called_off_it_ends_nothing():
    statuses = []
    exits = ExitWatchdog(60, statuses.append)
    exits.start()
    exits.request(3)
    exits.cancel()
    exits._thread.join(30)
    assert not exits._thread.is_alive()
    assert statuses == []
