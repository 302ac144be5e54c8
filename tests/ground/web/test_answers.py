import pytest
from twisted.internet.task import Clock

from up.protocols.general_message import GeneralMessage
from up_ground.catalogue import Catalogue, title_of
from up_ground.web.answers import ANSWER_LIMIT_S, Answer, Answers, outcome_event


class Bench:
    def __init__(self):
        self.clock = Clock()
        self.answers, self.heard = Answers(self.clock), []

    def expect(self, name="up.arm", data=None):
        return self.answers.expect(name, data or {}, self.heard.append)

    def ack(self, id_):
        self.answers.on_message(GeneralMessage("up.ack", {"id": id_}))

    def nack(self, id_, **more):
        self.answers.on_message(GeneralMessage("up.nack", {"id": id_, **more}))


@pytest.fixture
def bench():
    return Bench()


def test_an_ack_and_how_long_it_took(bench):
    id_ = bench.expect()
    bench.clock.advance(0.25)
    bench.ack(id_)
    (answer,) = bench.heard
    assert (answer.outcome, answer.round_trip_ms) == ("ack", 250.0)
    assert bench.clock.getDelayedCalls() == []


def test_a_nack_and_its_reason(bench):
    bench.nack(bench.expect(), code="refused", reason="switch", detail="not_at_auto")
    (answer,) = bench.heard
    assert (answer.outcome, answer.code, answer.reason) == ("nack", "refused", "switch")
    assert answer.detail == "not_at_auto"


def test_one_answer_counts(bench):
    id_ = bench.expect()
    bench.ack(id_)
    bench.ack(id_)
    bench.nack(id_, code="refused", reason="late")
    assert [each.outcome for each in bench.heard] == ["ack"]


def test_none_in_time_and_one_too_late(bench):
    id_ = bench.expect()
    bench.clock.advance(ANSWER_LIMIT_S)
    bench.ack(id_)
    (answer,) = bench.heard
    assert (answer.outcome, answer.code) == ("timeout", "no_answer")


@pytest.mark.parametrize("id_", ["somebody's", None, 7, [], {}, ""])
def test_answers_to_others_are_none(bench, id_):
    bench.expect()
    bench.ack(id_)
    bench.nack(id_)
    bench.answers.on_message(GeneralMessage("up.ack", {}))
    assert bench.heard == []


def test_a_nack_of_strange_types(bench):
    bench.nack(bench.expect(), code=7, reason=["x"])
    assert (bench.heard[0].code, bench.heard[0].reason) == ("", "")


@pytest.mark.parametrize("order", ["values first", "ack first"])
def test_what_was_asked_for_comes_with_the_answer(bench, order):
    id_ = bench.expect("arduino.pids.tunings", {"request": True})
    values = GeneralMessage("arduino.pids.values", {"ratePIDs": {}})
    if order == "values first":
        bench.answers.on_message(values)
        assert bench.heard == []
        bench.ack(id_)
    else:
        bench.ack(id_)
        assert bench.heard == []
        bench.answers.on_message(values)
    assert bench.heard[0].data == {"ratePIDs": {}}


def test_what_was_asked_for_never_comes(bench):
    bench.ack(bench.expect("arduino.profile.request"))
    bench.clock.advance(ANSWER_LIMIT_S)
    answer = bench.heard[0]
    assert (answer.outcome, answer.code, answer.data) == ("ack", "no_content", None)


def test_a_set_of_gains_waits_for_no_values(bench):
    bench.ack(bench.expect("arduino.pids.tunings", {"pids": {}}))
    assert bench.heard[0].outcome == "ack"


def test_a_lost_link_leaves_it_unknown(bench):
    bench.expect()
    bench.answers.on_link_lost()
    assert (bench.heard[0].outcome, bench.heard[0].code) == ("timeout", "link_lost")
    assert len(bench.answers) == 0


CATALOGUE = Catalogue.installed()
BEFORE = {"ratePIDs": {"ailerons": {"p": 3.0, "i": 0.0, "d": 0.0}}}
AFTER = {"ratePIDs": {"ailerons": {"p": 2.4, "i": 0.0, "d": 0.0}}}
NACK = Answer("nack", "forbidden", "not in flight")


@pytest.mark.parametrize(
    ("name", "data", "answer", "code", "text"),
    [
        ("up.arm", {}, Answer("ack"), "command_ack", "Ann: Arm carried out"),
        ("up.arm", {}, NACK, "command_nack", "Ann: Arm refused: not in flight"),
        (
            "android.speak",
            {"text": "{0.x}"},
            Answer("ack"),
            "command_ack",
            'Ann: Speak "{0.x}" carried out',
        ),
        ("a.cog", {"text": 1}, Answer("ack"), "command_ack", "Ann: a.cog carried out"),
        (
            "arduino.pids.tunings",
            {"pids": AFTER},
            Answer("ack"),
            "gains_ack",
            "Ann changed gains: rate roll P 3 to 2.4",
        ),
        ("arduino.pids.tunings", {"pids": BEFORE}, NACK, "gains_nack", None),
        ("arduino.pids.tunings", {"request": True}, Answer("ack"), "command_ack", None),
        ("black_box.mark", {"text": "gust"}, Answer("ack"), "mark_ack", "Ann marks: gust"),
    ],
)
def test_an_outcome_is_an_event(name, data, answer, code, text):
    title = title_of(CATALOGUE.get(name), name, data)
    kind, report = outcome_event("Ann", title, name, data, BEFORE, answer)
    assert (report.code, kind) == (code, code.partition("_")[0])
    assert text in (None, report.text)
