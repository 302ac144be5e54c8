"""Reports of `make run` about the aircraft, by a clock of the test."""

from twisted.internet.task import Clock

from up_simulator.demo.news import News
from up_simulator.phone.java_handset import GONE

LATE = "late by 0.25 s: the missed time is skipped, not flown"


def test_a_busy_machine_is_said_once_and_then_once_a_minute():
    clock = Clock()
    news = News(clock.seconds)
    said = []
    for _ in range(1500):
        said += [(clock.seconds(), line) for line in news.of([LATE])]
        clock.advance(0.125)
    assert [time_s // 1 for time_s, _ in said] == [0, 60, 120, 180]
    assert said[0][1] == LATE
    assert said[1][1].startswith("late 480 times more, by 120.00 s in all")
    # Delayed news is reported also without further news, and only once.
    clock.advance(60)
    (last,) = news.of([])
    assert last.startswith("late 59 times more")
    clock.advance(600)
    assert news.of([]) == []


def test_other_news_are_said_each_time():
    news = News(Clock().seconds)
    lines = ["the wing hit the ground", "nothing of note", LATE, "launched again", "launched again"]
    assert news.of(lines) == [lines[0], *lines[2:]]


def test_the_end_of_the_phone_is_news():
    line = f"phone: ended by itself with signal 9; {GONE}"
    assert News(Clock().seconds).of([line]) == [line]
