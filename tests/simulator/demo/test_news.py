"""The news that `make run` prints about the aircraft, with a simulated clock."""

from twisted.internet.task import Clock

from up_simulator.demo.news import CODES, News
from up_simulator.harness.user_log import LogLine

LATE = LogLine("late by 0.25 s", "late", {"late_s": 0.25})


def test_a_busy_machine_is_reported_first_and_then_once_a_minute():
    clock = Clock()
    news = News(clock.seconds)
    printed = []
    for _ in range(1500):
        printed += [(clock.seconds(), text) for text in news.select([LATE])]
        clock.advance(0.125)
    assert [time_s // 1 for time_s, _ in printed] == [0, 60, 120, 180]
    assert printed[0][1] == LATE.text
    assert "480 times" in printed[1][1] and "120.00 s" in printed[1][1]
    # Delayed news is reported also without further news, and only once.
    clock.advance(60)
    (last,) = news.select([])
    assert "59 times" in last
    clock.advance(600)
    assert news.select([]) == []


def test_other_news_is_printed_each_time():
    lines = [LogLine(code, code) for code in (*CODES, *CODES)]
    others = [LogLine("a mode", "board_mode"), LogLine("crashed", "")]
    selected = News(Clock().seconds).select([*lines, *others])
    assert selected == [line.text for line in lines]
