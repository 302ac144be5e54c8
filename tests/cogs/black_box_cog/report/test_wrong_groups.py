"""Findings, each kind once."""

from black_box_cog.report.verdict import verdict_of
from black_box_cog.report.wrong_groups import groups_of, worst_of

from tests.up.flight_log.logs import LogMaker
from up.flight_log.summary import Wrong, summarise

BLIPS = [
    Wrong(float(number), "alarm", "no attitude came for 0.52 s", 0.52) for number in range(10, 20)
]
LONG = Wrong(83.2, "alarm", "no attitude came for 7.4 s", 7.4)
PANIC = [
    Wrong(5.0, "warning", "Panic Mode for 2 min 05 s, at 97 percent of load", 125.0),
    Wrong(200.0, "warning", "Panic Mode for 1.0 s until the end, at 91 percent of load", 1.0),
]
ALL = [*BLIPS, LONG, *PANIC, Wrong(3.0, "alarm", "the board was reset in flight (watchdog)")]


def test_repeated_kinds_are_one_line_that_tells_the_longest():
    assert [each.text for each in groups_of(ALL)] == [
        "no attitude came 11 times, the longest for 7.4 s at 1:23.2",
        "Panic Mode 2 times, the longest for 2 min 05 s at 0:05.0",
        "the board was reset in flight (watchdog)",
    ]
    assert sum(len(each.members) for each in groups_of(ALL)) == len(ALL)


def test_a_note_and_an_alarm_stay_apart():
    note = Wrong(90.0, "info", "no attitude came for 3.0 s until the end", 3.0)
    assert [each.level for each in groups_of([LONG, note])] == ["alarm", "info"]


def test_the_worst_is_an_alarm_and_the_longest_of_them():
    assert worst_of(ALL) is LONG
    assert worst_of([*PANIC, BLIPS[3], BLIPS[0]]) is BLIPS[0]


def test_the_verdict_names_the_worst(tmp_path):
    maker = LogMaker()
    maker.add(0, "a", x=1)
    level, text = verdict_of(summarise(maker.log(tmp_path)), ALL)
    assert level == "bad"
    assert text.endswith(
        "Two things went wrong, and one more deserves a look."
        " The worst, at 1:23.2: no attitude came for 7.4 s."
    )
