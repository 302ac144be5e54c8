"""Outcomes of a Command, by the clock."""

import pytest
from twisted.internet.task import Clock

from up.protocols.general_message import GeneralMessage
from up_ground.web.answers import ANSWER_LIMIT_S, Answers


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
    bench.nack(bench.expect(), code="refused", reason="switch")
    (answer,) = bench.heard
    assert (answer.outcome, answer.code, answer.reason) == ("nack", "refused", "switch")


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
    assert answer.outcome == "timeout"
    assert "not known" in answer.reason


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
    assert (bench.heard[0].outcome, bench.heard[0].data) == ("ack", None)
    assert "did not come" in bench.heard[0].reason


def test_a_set_of_gains_waits_for_no_values(bench):
    bench.ack(bench.expect("arduino.pids.tunings", {"pids": {}}))
    assert bench.heard[0].outcome == "ack"


def test_a_lost_link_leaves_it_unknown(bench):
    bench.expect()
    bench.answers.on_link_lost()
    assert bench.heard[0].outcome == "timeout"
    assert "link was lost" in bench.heard[0].reason
    assert len(bench.answers) == 0
