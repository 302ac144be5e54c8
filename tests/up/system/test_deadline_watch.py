import threading

import pytest

from up.system import deadline_watch
from up.system.deadline_watch import DeadlineWatch, now_s, read_deadline, write_deadline


@pytest.fixture
def clock(monkeypatch):
    """The time, set by the test."""
    time = [100.0]
    monkeypatch.setattr(deadline_watch, "now_s", lambda: time[0])
    return time


def test_a_deadline_is_renewed_and_not_withdrawn(tmp_path, clock):
    path = tmp_path / "deadline"
    watch = DeadlineWatch(path, lambda: None)
    assert watch.is_over(), "no deadline yet"
    write_deadline(path, 110.0)
    assert not watch.is_over()
    clock[0] = 109.999
    assert not watch.is_over()
    path.write_text("")
    assert not watch.is_over()
    clock[0] = 110.0
    assert watch.is_over()
    write_deadline(path, 120.0)
    assert not watch.is_over() and read_deadline(path) == 120.0
    path.write_text("nan")
    clock[0] = 120.0
    assert watch.is_over()


def test_it_ends_without_the_main_thread(tmp_path):
    write_deadline(tmp_path / "deadline", now_s() + 0.2)
    ended = threading.Event()
    DeadlineWatch(tmp_path / "deadline", ended.set).start()
    assert ended.wait(30) and now_s() >= read_deadline(tmp_path / "deadline")
