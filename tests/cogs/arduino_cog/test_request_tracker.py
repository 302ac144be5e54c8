import pytest
from arduino_cog.request_tracker import RequestTracker
from twisted.internet.task import Clock

from up.commands.refusal import Code, CommandRefusedError


class Line:
    def __init__(self):
        self.sent = []
        self.next = 250
        self.is_open = True

    def __call__(self, type_, payload):
        if not self.is_open:
            return None
        self.sent.append((type_, payload))
        self.next = (self.next + 1) % 256
        return self.next


@pytest.fixture
def line():
    return Line()


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def requests(line, clock):
    return RequestTracker(clock, line)


def outcome_of(done):
    found = []
    done.addBoth(found.append)
    return found


def refusal(found):
    assert found[0].check(CommandRefusedError)
    return found[0].value


def test_a_confirmation_belongs_to_the_request_with_its_sequence(requests):
    first = outcome_of(requests.request("g", b"1"))
    second = outcome_of(requests.request("g", b"2"))
    requests.on_confirmed("g", 252)
    assert (first, second) == ([], [b""])
    requests.on_confirmed("g", 251)
    assert first == [b""]


@pytest.mark.parametrize(("type_", "sequence"), [("a", 250), ("a", 252), ("d", 251)])
def test_a_confirmation_of_something_else_confirms_nothing(requests, type_, sequence):
    found = outcome_of(requests.request("a"))
    requests.on_confirmed(type_, sequence)
    assert found == []
    assert requests.unmatched == 1
    requests.fail_all("over")


def test_a_confirmation_is_no_value(requests):
    found = outcome_of(requests.request("G", answer="G"))
    requests.on_confirmed("G", 251)
    assert found == []
    requests.on_value("G", b"gains")
    assert found == [b"gains"]


def test_a_refusal_belongs_to_its_request(requests):
    found = outcome_of(requests.request("a"))
    assert requests.on_refused("a", 251, "the throttle is not low", "throttle_not_low")
    assert refusal(found).detail == "throttle_not_low"
    assert refusal(found).code is Code.REFUSED
    assert not requests.on_refused("a", 251, "again")


def test_without_an_answer_it_is_asked_once_more_and_then_fails(requests, line, clock):
    found = outcome_of(requests.request("d"))
    clock.advance(0.49)
    assert len(line.sent) == 1
    clock.advance(0.02)
    assert len(line.sent) == 2
    clock.advance(0.51)
    assert refusal(found).code is Code.TIMEOUT
    assert len(line.sent) == 2
    assert not clock.getDelayedCalls()


def test_the_answer_to_either_sending_counts(requests, clock):
    for late in (0, 1):
        found = outcome_of(requests.request("d"))
        clock.advance(0.51)
        requests.on_confirmed("d", (251 + 2 * late + late) % 256 if not late else 253)
        assert found == [b""]
    assert not clock.getDelayedCalls()


def test_what_must_not_be_repeated_is_sent_once(requests, line, clock):
    found = outcome_of(requests.request("a", may_repeat=False))
    clock.advance(0.51)
    assert len(line.sent) == 1
    assert refusal(found).code is Code.TIMEOUT


def test_a_closed_line_fails_at_once(requests, line, clock):
    line.is_open = False
    assert refusal(outcome_of(requests.request("d"))).code is Code.UNAVAILABLE
    assert not clock.getDelayedCalls()


def test_a_line_that_closes_before_the_repetition_fails(requests, line, clock):
    found = outcome_of(requests.request("d"))
    line.is_open = False
    clock.advance(0.51)
    assert refusal(found).code is Code.UNAVAILABLE


def test_everything_that_waits_fails_with_the_arduino(requests, clock):
    found = [outcome_of(requests.request(each)) for each in "agM"]
    requests.fail_all("gone")
    assert [refusal(each).reason for each in found] == ["gone"] * 3
    assert not clock.getDelayedCalls()


def test_a_request_that_was_given_up_is_not_repeated(requests, line, clock):
    done = requests.request("d")
    outcome_of(done)
    done.cancel()
    clock.advance(5)
    assert len(line.sent) == 1
