from tests.flightlog.logs import LogMaker
from up_flightlog.findings.finding import Finding, lasting
from up_flightlog.findings.summary import summarise
from up_flightlog.read.spans import Span
from up_flightlog.report.finding_groups import groups_of, verdict_of, worst_of


def missing(begin_s, length_s, level="alarm", subject="attitude"):
    span = Span(begin_s, begin_s + length_s)
    return lasting(span, level, "reading_missing", f"no {subject} arrived", subject=subject)


BLIPS = [missing(float(number), 0.52) for number in range(10, 20)]
LONG = missing(83.2, 7.4)
PANIC = [
    lasting(Span(begin_s, end_s), "warning", "panic", "Panic Mode", f", at {load} percent")
    for begin_s, end_s, load in ((5.0, 130.0, 97), (200.0, 201.0, 91))
]
RESET = Finding(3.0, "alarm", "board_reset", "the board was reset", subject="watchdog")
ALL = [*BLIPS, LONG, *PANIC, RESET]


def test_repeated_kinds_are_one_line_with_the_longest():
    groups = groups_of(ALL)
    assert [(each.worst, len(each.members)) for each in groups] == [
        (LONG, 11),
        (PANIC[0], 2),
        (RESET, 1),
    ]
    assert groups[0].text == "no attitude arrived 11 times, the longest for 7.4 s at 1:23.2"


def test_levels_and_subjects_are_kinds():
    others = [missing(90.0, 3.0, "info"), missing(91.0, 3.0, subject="location")]
    assert len(groups_of([LONG, *others])) == 3


def test_the_worst_is_an_alarm_and_the_longest_of_them():
    assert worst_of(ALL) is LONG
    assert worst_of([*PANIC, BLIPS[3], BLIPS[0]]) is BLIPS[0]


def test_the_verdict_names_the_worst(tmp_path):
    maker = LogMaker()
    maker.add(0, "a", x=1)
    level, text = verdict_of(summarise(maker.log(tmp_path)), ALL)
    assert level == "bad"
    assert LONG.text in text
