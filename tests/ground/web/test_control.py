import pytest
from twisted.internet.task import Clock

from up_ground.link_status import ControlStatus
from up_ground.web.access import Denial
from up_ground.web.client_session import ClientSession
from up_ground.web.control import ASK_LIMIT_S, Control
from up_ground.web.messages import PageFault


class Seat:
    """A seat at a proxy that does nothing automatically."""

    def __init__(self):
        self.status, self.holder, self.asked = ControlStatus.FREE, None, None
        self.done = []

    def pop_request(self):
        asked, self.asked = self.asked, None
        return asked

    def request(self):
        self.done.append("request")

    def give(self, to):
        self.done.append(f"give {to}")
        self.status, self.holder = ControlStatus.HELD, to

    def release(self):
        self.done.append("release")
        self.status = ControlStatus.FREE


class Bench:
    def __init__(self):
        self.clock, self.seat, self.told, self.changes = Clock(), Seat(), [], 0
        self.control = Control(self.clock, self.seat, self.report, self.on_change)
        self.ann, self.bob, self.guest = (
            ClientSession(number, name, "", why)
            for number, name, why in (
                (1, "Ann", None),
                (2, "Bob", None),
                (3, "Guest", Denial("no_key", "")),
            )
        )
        for page in (self.ann, self.bob, self.guest):
            page.faults = []
            page.fault = lambda text, code, faults=page.faults: faults.append(code)

    def report(self, kind, report):
        self.told.append(report.code)

    def on_change(self):
        self.changes += 1

    def seat_is(self, status, holder=None):
        self.seat.status, self.seat.holder = status, holder
        self.control.on_lease()

    def has_control(self, page):
        self.control.request(page)
        self.seat_is(ControlStatus.OURS)
        assert self.control.holder is page

    def words(self, page):
        return self.control.describe(page)


@pytest.fixture
def bench():
    return Bench()


def test_the_seat_is_only_taken_when_a_page_wants_control(bench):
    bench.seat_is(ControlStatus.FREE)
    bench.clock.advance(60)
    assert bench.seat.done == []
    assert bench.words(bench.ann)["holder"] == "nobody"
    bench.control.request(bench.ann)
    assert bench.seat.done == ["request"]
    assert bench.control.holder is None
    bench.seat_is(ControlStatus.OURS)
    assert bench.words(bench.ann)["holder"] == "you"
    assert bench.words(bench.bob)["holder"] == "page"
    assert bench.words(bench.bob)["holder_name"] == "Ann"
    bench.control.release(bench.ann)
    assert bench.seat.done == ["request", "release"]
    assert bench.words(bench.ann)["holder"] == "nobody"


def test_a_page_that_may_only_watch_gets_nothing(bench):
    with pytest.raises(PageFault) as fault:
        bench.control.request(bench.guest)
    bench.has_control(bench.ann)
    with pytest.raises(PageFault) as given:
        bench.control.give(bench.ann, bench.guest)
    assert (fault.value.code, given.value.code) == ("watch_only", "watch_only")
    assert bench.control.holder is bench.ann


def test_the_holder_is_asked_and_gives(bench):
    bench.has_control(bench.ann)
    bench.control.request(bench.bob)
    assert bench.control.holder is bench.ann
    assert bench.words(bench.ann)["asks_you"] is True
    assert bench.words(bench.ann)["asked_by"] == {"page": 2, "name": "Bob"}
    assert bench.words(bench.bob)["asks_you"] is False
    bench.control.give(bench.ann, None)
    assert bench.control.holder is bench.bob
    assert bench.words(bench.ann)["asked_by"] is None
    assert bench.seat.done == ["request"]


def test_the_holder_denies(bench):
    bench.has_control(bench.ann)
    bench.control.request(bench.bob)
    bench.control.deny(bench.ann)
    assert bench.control.holder is bench.ann
    assert bench.bob.faults == ["denied"]
    with pytest.raises(PageFault) as fault:
        bench.control.deny(bench.ann)
    assert fault.value.code == "not_requested"


@pytest.mark.parametrize("action", ["give", "deny", "release"])
def test_only_the_holder_decides(bench, action):
    bench.has_control(bench.ann)
    with pytest.raises(PageFault):
        getattr(bench.control, action)(bench.bob, *([bench.bob] if action == "give" else []))
    assert bench.control.holder is bench.ann


def test_who_asks_asks_for_so_long(bench):
    bench.has_control(bench.ann)
    bench.control.request(bench.bob)
    bench.clock.advance(ASK_LIMIT_S)
    assert bench.words(bench.ann)["asks_you"] is False
    assert bench.bob.faults


def test_a_page_that_is_gone_leaves_the_seat(bench):
    bench.has_control(bench.ann)
    bench.control.on_away(bench.ann)
    assert bench.control.holder is bench.ann
    assert bench.seat.done == ["request"]
    bench.control.on_gone(bench.ann)
    assert bench.control.holder is None
    assert bench.seat.done == ["request", "release"]


def test_a_page_that_is_gone_leaves_it_to_who_asks(bench):
    bench.has_control(bench.ann)
    bench.control.request(bench.bob)
    bench.control.on_gone(bench.ann)
    assert bench.control.holder is bench.bob
    assert bench.seat.done == ["request"]


def test_the_ground_that_has_the_seat_is_asked_until_it_gives(bench):
    bench.seat_is(ControlStatus.HELD, 4)
    bench.control.request(bench.ann)
    words = bench.words(bench.bob)
    assert (words["holder"], words["holder_name"]) == ("ground", "ground 4")
    assert words["asked_by"] == {"page": 1, "name": "Ann"}
    for _ in range(3):
        bench.clock.advance(1.1)
    assert bench.seat.done == ["request"] * 4
    bench.seat_is(ControlStatus.OURS)
    assert bench.control.holder is bench.ann
    bench.clock.advance(5)
    assert bench.seat.done == ["request"] * 4


def test_it_is_not_asked_for_ever(bench):
    bench.seat_is(ControlStatus.HELD, 4)
    bench.control.request(bench.ann)
    bench.clock.pump([1.1] * 40)
    assert bench.ann.faults == ["request_timeout"]
    asked = len(bench.seat.done)
    bench.clock.advance(30)
    assert len(bench.seat.done) == asked
    # The answer comes late: no page waits for it.
    bench.seat_is(ControlStatus.OURS)
    assert bench.seat.done[-1] == "release"


def test_another_ground_asks_the_page_and_gets_it(bench):
    bench.has_control(bench.ann)
    bench.seat.asked = 7
    bench.control.on_lease()
    assert bench.words(bench.ann)["asked_by"] == {"page": None, "name": "ground 7"}
    assert bench.words(bench.ann)["asks_you"] is True
    bench.control.give(bench.ann, None)
    assert bench.seat.done == ["request", "give 7"]
    assert bench.words(bench.ann)["holder_name"] == "ground 7"


def test_another_ground_that_was_denied_does_not_ask_each_second(bench):
    bench.has_control(bench.ann)
    bench.seat.asked = 7
    bench.control.on_lease()
    bench.control.deny(bench.ann)
    for _ in range(10):
        bench.clock.advance(1.1)
        bench.seat.asked = 7
        bench.control.on_lease()
        assert bench.words(bench.ann)["asks_you"] is False
    bench.clock.advance(6)
    bench.seat.asked = 7
    bench.control.on_lease()
    assert bench.words(bench.ann)["asks_you"] is True


def test_control_outlives_a_lost_link_and_ends_when_another_ground_took_over(bench):
    bench.has_control(bench.ann)
    bench.seat_is(ControlStatus.UNKNOWN)
    assert bench.words(bench.ann)["holder"] == "you"
    bench.seat_is(ControlStatus.FREE)
    assert bench.seat.done == ["request", "request"]
    bench.seat_is(ControlStatus.OURS)
    assert bench.control.holder is bench.ann
    bench.seat_is(ControlStatus.HELD, 9)
    assert bench.control.holder is None
    assert bench.told[-1] == "control_lost"


def test_the_end_leaves_nothing(bench):
    bench.has_control(bench.ann)
    bench.control.request(bench.bob)
    bench.control.stop()
    assert bench.seat.done[-1] == "release"
    assert bench.clock.getDelayedCalls() == []
