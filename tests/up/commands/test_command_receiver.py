"""Messages from outside: default deny, and answers."""

from dataclasses import dataclass
from typing import ClassVar

import pytest
from twisted.internet.defer import Deferred

from tests.up.commands.samples import Border, Log, NumberCommand
from up.commands.command import BaseCommand
from up.commands.command_link import REMEMBERED, REMEMBERED_S
from up.commands.refusal import Code, CommandRefusedError
from up.commands.roles import Role
from up.protocols.general_message import MalformedMessage


@pytest.fixture
def border():
    return Border()


@pytest.fixture
def numbers(border):
    heard = []
    border.bus.register_command(NumberCommand, lambda command: heard.append(command.number))
    return heard


def test_a_command_with_an_id_is_acknowledged(border, numbers):
    border.say("test.number", {"number": 5}, "a")
    border.say("test.old_number", {"number": 6})
    assert numbers == [5, 6]
    assert border.answers == [("ack", "a")]


@pytest.mark.parametrize(
    ("role", "name", "data", "code"),
    [
        (Role.PILOT, "no.such", {}, "unknown"),
        (Role.PILOT, "test.number", {"number": "x"}, "invalid"),
        (Role.PILOT, "test.number", {"number": 100}, "invalid"),
        (Role.OBSERVER, "test.number", {}, "forbidden"),
        (Role.PILOT, "test.other", {}, "forbidden"),
        (Role.OPERATOR, "test.number", {}, "unavailable"),
    ],
)
def test_refusals_have_a_code_and_a_reason(role, name, data, code):
    border = Border(role)
    border.say(name, data)
    assert border.answers == []
    border.say(name, data, "a")
    (got,) = border.answers
    assert got[:2] == (code, "a")
    assert got[2]


def test_a_handlers_refusal_and_its_fault(border):
    def refuse(command):
        if command.number == 1:
            raise CommandRefusedError("low battery", Code.UNAVAILABLE)
        raise RuntimeError("secret detail")

    border.bus.register_command(NumberCommand, refuse)
    border.say("test.number", {"number": 1}, "a")
    border.say("test.number", {"number": 2}, "b")
    assert border.answers[0] == ("unavailable", "a", "low battery")
    assert border.answers[1][:2] == ("failed", "b")
    assert "secret" not in border.answers[1][2]


def test_an_outcome_that_comes_later_and_one_that_never_comes(border):
    later = {}
    border.bus.register_command(
        NumberCommand, lambda command: later.setdefault(command.number, Deferred())
    )
    border.say("test.number", {"number": 1}, "a")
    border.say("test.number", {"number": 2}, "b")
    assert border.answers == []
    border.clock.advance(1)
    later[1].callback(None)
    assert border.answers == [("ack", "a")]
    border.clock.advance(1.01)
    assert border.codes == ["ack", "timeout"]
    later[2].callback(None)
    assert border.codes == ["ack", "timeout"]
    border.say("test.number", {"number": 2}, "b")
    assert border.codes == ["ack", "timeout", "timeout"]


def test_a_repeated_id_is_answered_again_and_not_executed_again(border, numbers):
    for _ in range(4):
        border.say("test.number", {"number": 5}, "a")
    assert numbers == [5]
    assert border.answers == [("ack", "a")] * 4
    assert border.receiver.counters["repeated"] == 3


def test_old_peers_put_one_id_on_all_their_commands(border, numbers):
    for number in (5, 6, 6, 5):
        border.say("test.number", {"number": number}, "a")
    assert numbers == [5, 6, 5]
    assert len(border.link._answers) == 1


def test_a_refused_id_is_refused_again(border, numbers):
    border.say("test.number", {"number": -1}, "a")
    border.say("test.number", {"number": -1}, "a")
    assert border.codes == ["invalid", "invalid"]
    assert border.receiver.counters["invalid"] == 1
    assert numbers == []


def test_a_repeated_id_whose_outcome_is_not_known_yet_is_answered_once(border):
    later = Deferred()
    calls = []
    border.bus.register_command(NumberCommand, lambda c: calls.append(c) or later)
    border.say("test.number", {}, "a")
    border.say("test.number", {}, "a")
    assert border.answers == []
    later.callback(None)
    assert border.answers == [("ack", "a")]
    assert len(calls) == 1


def test_the_newest_ids_are_remembered_and_no_more(border, numbers):
    for number in range(REMEMBERED):
        border.say("test.number", {}, f"id {number}")
    assert len(numbers) == REMEMBERED
    for number in range(REMEMBERED):
        border.say("test.number", {}, f"id {number}")
    assert len(numbers) == REMEMBERED
    for number in range(10_000):
        border.say("test.number", {}, f"flood {number}")
    assert len(border.link._answers) == REMEMBERED
    border.say("test.number", {}, "id 0")
    assert len(numbers) == REMEMBERED + 10_001


def test_an_id_is_forgotten_after_its_time(border, numbers):
    border.say("test.number", {}, "a")
    border.clock.advance(REMEMBERED_S)
    border.say("test.number", {}, "a")
    assert len(numbers) == 1
    border.clock.advance(0.001)
    border.say("test.number", {}, "a")
    assert len(numbers) == 2


def test_malformed_lines_are_counted_and_nacked_where_they_have_an_id(border):
    border.receiver.receive_malformed(MalformedMessage("not JSON"), border.link)
    border.receiver.receive_malformed(MalformedMessage("data is not an object", "a"), border.link)
    assert border.codes == ["malformed"]
    assert border.receiver.counters["malformed"] == 2


def test_what_is_refused_is_logged_first_and_then_as_a_count():
    border = Border(Role.OBSERVER)
    with Log() as log:
        for _ in range(100):
            border.say("test.number")
        for number in range(1000):
            border.say(f"unknown.{number}")
    assert border.receiver.counters["forbidden"] == 100
    assert len(log.events) == 2
    with Log() as log:
        border.clock.advance(10)
    assert [event["more"] for event in log.events] == [99, 999]


class TestBeacons:
    """A Command that shows old telemetry is stale; arming and disarming must show some."""

    @pytest.mark.parametrize("name", ["up.arm", "up.disarm"])
    def test_arming_needs_a_fresh_one_of_this_run(self, border, name):
        armed = []
        border.bus.register_command(name, armed.append)
        old = border.beacons.draw()
        border.clock.advance(2.001)
        fresh = border.beacons.draw()
        border.say(name, {}, "none")
        border.say(name, {}, "old", old)
        border.say(name, {}, "future", fresh + 1)
        border.say(name, {}, "another run", old - 1)
        border.say(name, {}, "negative", -1)
        border.say(name, {}, "huge", 2**63)
        assert border.codes == ["no_beacon", "stale", *["unknown_beacon"] * 4]
        assert not armed
        border.clock.advance(2)
        border.say(name, {}, "fresh", fresh)
        assert border.answers[-1] == ("ack", "fresh")
        assert len(armed) == 1

    def test_any_command_that_echoes_an_old_one_is_stale(self, border, numbers):
        beacon = border.beacons.draw()
        border.clock.advance(3)
        border.say("test.number", {}, "a", beacon)
        border.say("test.number", {}, None, beacon)
        assert border.codes == ["stale"]
        assert not numbers
        border.say("test.number", {}, "b")
        assert len(numbers) == 1

    def test_two_runs_do_not_count_alike(self, border):
        starts = {Border().beacons.draw() for _ in range(20)}
        assert len(starts) == 20

    def test_memory_is_bounded_and_the_newest_known(self, border):
        first = border.beacons.draw()
        for _ in range(5000):
            last = border.beacons.draw()
        assert border.beacons.age_s(first) is None
        border.say("up.arm", {}, "forgotten", first)
        border.say("up.arm", {}, "another run", first - 1)
        assert border.codes == ["stale", "unknown_beacon"]
        assert border.beacons.is_fresh(last)
        assert len(border.beacons._times) <= 4096


@dataclass(frozen=True, slots=True)
class BrokenCommand(BaseCommand):
    """A cog's Command with a mistake in it."""

    NAME: ClassVar[str] = "test.broken"

    def roles(self):
        raise TypeError("a mistake")


def test_a_cogs_broken_command_costs_the_message_and_not_the_link(numbers):
    border = Border(Role.PILOT, BrokenCommand)
    with Log() as log:
        border.say("test.broken", {}, "a")
        border.say("test.broken", {}, "b")
    assert border.codes == ["failed", "failed"]
    assert len(log.failures) == 1


@dataclass(frozen=True, slots=True)
class FarCommand(BaseCommand):
    """A Command that another program carries out."""

    NAME: ClassVar[str] = "test.far"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.OPERATOR})
    ROUTE: ClassVar[str] = "phone"


class TestRoutes:
    """Commands for the phone."""

    def test_without_a_carrier(self):
        border = Border(Role.OPERATOR, FarCommand)
        border.say("test.far", {}, "a")
        assert border.codes == ["unavailable"]

    def test_a_carrier_that_refuses_fails_or_hangs(self):
        border = Border(Role.OPERATOR, FarCommand)
        faults = {"a": CommandRefusedError("gone", Code.UNAVAILABLE), "b": KeyError("oops")}

        def route(command, link, id_):
            if id_ in faults:
                raise faults[id_]
            return Deferred()

        border.receiver.register_route("phone", route)
        for id_ in "abc":
            border.say("test.far", {}, id_)
        border.clock.advance(2.1)
        assert border.codes == ["unavailable", "failed", "timeout"]

    def test_one_carrier_a_route(self):
        border = Border(Role.OPERATOR)
        border.receiver.register_route("phone", lambda *_: None)
        with pytest.raises(ValueError):
            border.receiver.register_route("phone", lambda *_: None)

    def test_a_routed_command_needs_its_role(self):
        border = Border(Role.OBSERVER, FarCommand)
        carried = []
        border.receiver.register_route("phone", lambda *all_: carried.append(all_))
        border.say("test.far", {}, "a")
        assert border.codes == ["forbidden"]
        assert not carried


def test_a_links_policy_refuses_what_its_role_would_permit(border, numbers):
    border.link.policy = lambda command: "not now (x.yml: key)" if command.number else None
    border.say("test.number", {"number": 5}, "a")
    border.say("test.number", {"number": 0}, "b")
    assert numbers == [0]
    assert border.codes == ["forbidden", "ack"]
