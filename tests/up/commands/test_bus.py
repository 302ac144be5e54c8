"""The bus delivers in order, isolates, waits its turn, counts and names."""

import pytest
from twisted.internet.defer import Deferred, succeed
from twisted.internet.task import Clock

from tests.up.commands.samples import Log, NumberCommand, OtherCommand, make_bus
from up.base_module import BaseModule
from up.cleanup import CleanupStack
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.commands.origin import INTERNAL, Origin
from up.commands.refusal import CommandRefusedError, UnhandledCommandError
from up.commands.roles import Role

GROUND = Origin("ground", Role.PILOT)


@pytest.fixture
def bus():
    return make_bus()


class Grumpy(BaseModule):
    """A module whose handler fails."""

    def on_number(self, command):
        raise RuntimeError("grumpy")


class Adder(BaseCommandHandler):
    """A handler object."""

    COMMAND = NumberCommand

    def __init__(self):
        self.total = 0

    def run_action(self, command):
        self.total += command.number


def test_handlers_run_at_once_and_in_order(bus):
    heard = []
    for name in "abc":
        bus.register_command(NumberCommand, lambda command, name=name: heard.append(name))
    bus.execute_command(NumberCommand(1))
    assert heard == ["a", "b", "c"]


def test_any_number_of_commands_waits_its_turn(bus):
    heard = []

    def publish_many(command):
        if command.number == 0:
            for number in range(1, 2001):
                bus.publish(NumberCommand(number))

    bus.register_command(NumberCommand, publish_many)
    bus.register_command(NumberCommand, lambda command: heard.append(command.number))
    bus.publish(NumberCommand(0))
    assert heard == list(range(2001))


def test_by_class_by_name_by_alias_and_by_object(bus):
    heard = []
    adder = Adder()
    bus.register_command("test.number", heard.append)
    bus.register_command("test.old_number", heard.append)
    bus.register_command(NumberCommand, adder)
    bus.publish(NumberCommand(4))
    assert heard == [NumberCommand(4)] * 2
    assert adder.total == 4
    assert bus.handlers_of(NumberCommand) == bus.handlers_of("test.old_number")


def test_what_is_no_handler_is_refused(bus):
    with pytest.raises(TypeError):
        bus.register_command(NumberCommand, "text")


def test_a_failing_handler_is_named_and_counted_and_the_others_run(bus):
    heard, owners = [], []
    bus.on_handler_failed = owners.append
    bus.register_command(NumberCommand, Grumpy().on_number)
    bus.register_command(NumberCommand, heard.append)
    with Log() as log:
        bus.execute_command(NumberCommand(1))
    assert heard == [NumberCommand(1)]
    assert owners == ["Grumpy"]
    assert bus.counters["failed_handlers"] == 1
    (event,) = log.of("handler_failed")
    assert (event["owner"], event["name"]) == ("Grumpy", "test.number")


def test_a_handler_that_fails_always_does_not_fill_the_log(bus):
    bus.register_command(NumberCommand, Grumpy().on_number)
    with Log() as log:
        for _ in range(1000):
            bus.execute_command(NumberCommand(1))
    assert bus.counters["failed_handlers"] == 1000
    assert len(log.failures) == 4
    assert log.of("handler_failed")[-1]["count"] == 1000


def test_a_command_that_is_refused_always_does_not_fill_the_log():
    clock = Clock()
    bus = make_bus(clock=clock)

    def refuse(command):
        raise CommandRefusedError(f"number {command.number}")

    bus.register_command(NumberCommand, refuse)
    with Log() as log:
        for number in range(5000):
            bus.execute_command(NumberCommand(number % 100))
        clock.advance(10)
    assert bus.counters["refused"] == 5000
    assert [event.get("more", 0) for event in log.events] == [0, 4999]


@pytest.mark.parametrize("fault", [SystemExit(3), RecursionError(), MemoryError(), KeyError("x")])
def test_no_fault_of_a_handler_stops_the_bus(bus, fault):
    heard = []

    def fail(_):
        raise fault

    bus.register_command(NumberCommand, fail)
    bus.register_command(NumberCommand, heard.append)
    bus.execute_command(NumberCommand(1))
    bus.execute_command(NumberCommand(2))
    assert heard == [NumberCommand(1), NumberCommand(2)]
    assert bus.counters["failed_handlers"] == 2


@pytest.mark.parametrize("ask", [False, True])
def test_even_what_may_not_be_caught_leaves_a_bus_that_delivers(bus, ask):
    heard = []
    interrupts = [KeyboardInterrupt()]

    def interrupt(_):
        if interrupts:
            raise interrupts.pop()

    bus.register_command(NumberCommand, interrupt)
    bus.register_command(NumberCommand, heard.append)
    with pytest.raises(KeyboardInterrupt):
        if ask:
            bus.execute_and_wait(NumberCommand(1), GROUND)
        else:
            bus.execute_command(NumberCommand(1))
    bus.execute_command(NumberCommand(2))
    assert heard == [NumberCommand(2)]


def test_a_nested_publish_waits_for_the_rest_of_the_handlers(bus):
    heard = []

    def nesting(command):
        heard.append(("first", command.number))
        if command.number == 1:
            bus.execute_command(NumberCommand(2))
            bus.execute_command(OtherCommand())

    bus.register_command(NumberCommand, nesting)
    bus.register_command(NumberCommand, lambda command: heard.append(("second", command.number)))
    bus.register_command(OtherCommand, lambda _: heard.append("other"))
    bus.execute_command(NumberCommand(1))
    assert heard == [("first", 1), ("second", 1), ("first", 2), ("second", 2), "other"]


def test_an_outcome_asked_for_in_a_handler_waits_its_turn(bus):
    heard = []

    def asking(_):
        bus.execute_and_wait(OtherCommand(), GROUND).addCallback(lambda _: heard.append("done"))
        heard.append("asked")

    bus.register_command(NumberCommand, asking)
    bus.register_command(NumberCommand, lambda _: heard.append("second"))
    bus.register_command(OtherCommand, lambda _: heard.append("other"))
    bus.execute_command(NumberCommand(1))
    assert heard == ["asked", "second", "other", "done"]


def test_the_origin_is_that_of_the_handled_command(bus):
    seen = []

    def nesting(_):
        seen.append(bus.origin)
        bus.execute_command(OtherCommand())
        seen.append(bus.origin)

    bus.register_command(NumberCommand, nesting)
    bus.register_command(OtherCommand, lambda _: seen.append(bus.origin))
    bus.execute_command(NumberCommand(1), GROUND)
    assert seen == [GROUND, GROUND, INTERNAL]


def test_unregistering_takes_the_handle(bus):
    heard = []
    first = bus.register_command(NumberCommand, lambda _: heard.append("first"))
    second = bus.register_command("test.old_number", lambda _: heard.append("second"))
    assert first != second
    bus.unregister_command(NumberCommand, first)
    bus.execute_command(NumberCommand(1))
    assert heard == ["second"]
    with pytest.raises(KeyError):
        bus.unregister_command(NumberCommand, first)
    bus.unregister_command("test.number", second)
    assert not bus.handlers_of(NumberCommand)


def test_unregistering_and_registering_inside_a_handler_acts_from_the_next_command_on(bus):
    heard = []
    handles = {}

    def once(_):
        heard.append("once")
        bus.unregister_command(NumberCommand, handles.pop("once"))
        bus.unregister_command(NumberCommand, handles.pop("other"))
        bus.register_command(NumberCommand, lambda _: heard.append("new"))

    handles["once"] = bus.register_command(NumberCommand, once)
    handles["other"] = bus.register_command(NumberCommand, lambda _: heard.append("other"))
    bus.execute_command(NumberCommand(1))
    assert heard == ["once", "other"]
    bus.execute_command(NumberCommand(2))
    assert heard == ["once", "other", "new"]


def test_what_nobody_handles_is_counted_and_logged_once(bus):
    handle = bus.register_command(NumberCommand, lambda _: None)
    bus.unregister_command(NumberCommand, handle)
    with Log() as log:
        for _ in range(50):
            bus.execute_command(OtherCommand(), GROUND)
            bus.execute_command(NumberCommand(1), GROUND)
    assert bus.counters["unhandled"] == 100
    assert {event["name"] for event in log.of("command_unhandled")} == {"test.other", "test.number"}
    assert len(log.of("command_unhandled")) == 2


def test_a_known_command_of_the_inside_needs_nobody(bus):
    heard = []
    with Log() as log:
        bus.execute_command(OtherCommand())
        bus.register_command(NumberCommand, lambda _: bus.execute_command(OtherCommand()))
        bus.register_command(NumberCommand, heard.append)
        bus.execute_command(NumberCommand(1))
        bus.execute_command(NumberCommand(2))
    assert heard == [NumberCommand(1), NumberCommand(2)]
    assert bus.counters == {}
    assert not log.events


def test_names_without_number_do_not_fill_memory(bus):
    for number in range(1000):
        unknown = type("Unknown", (BaseCommand,), {"NAME": f"unknown.{number}"})
        bus.execute_command(unknown())
    assert bus.counters["unhandled"] == 1000
    assert len(bus._logged_names) <= 100


def outcome_of(bus, command=None):
    got = []
    bus.execute_and_wait(command or NumberCommand(1), GROUND).addBoth(got.append)
    return got


def test_the_outcome_without_handlers(bus):
    assert outcome_of(bus)[0].check(UnhandledCommandError)


def test_the_outcome_waits_for_every_deferred(bus):
    one, two = Deferred(), Deferred()
    bus.register_command(NumberCommand, lambda _: one)
    bus.register_command(NumberCommand, lambda _: two)
    got = outcome_of(bus)
    two.callback(None)
    assert got == []
    one.callback(None)
    assert got == [None]


def test_a_later_fault_is_logged_counted_and_the_outcome(bus):
    later = Deferred()
    bus.register_command(NumberCommand, lambda _: later)
    bus.register_command(NumberCommand, lambda _: succeed(None))
    got = outcome_of(bus)
    with Log() as log:
        later.errback(RuntimeError("late"))
    assert got[0].check(RuntimeError)
    assert bus.counters["failed_handlers"] == 1
    assert len(log.failures) == 1


def test_a_later_fault_that_nobody_waits_for_is_logged_too(bus):
    later = Deferred()
    bus.register_command(NumberCommand, lambda _: later)
    bus.execute_command(NumberCommand(1))
    with Log() as log:
        later.errback(RuntimeError("late"))
    assert bus.counters["failed_handlers"] == 1
    assert len(log.failures) == 1


def test_a_refusal_is_the_outcome_and_no_failure(bus):
    def refuse(_):
        raise CommandRefusedError("not now")

    heard = []
    bus.register_command(NumberCommand, refuse)
    bus.register_command(NumberCommand, heard.append)
    with Log() as log:
        assert outcome_of(bus)[0].check(CommandRefusedError)
    assert bus.counters["refused"] == 1
    assert bus.counters["failed_handlers"] == 0
    assert heard and not log.failures


def test_async_handlers_run_and_their_outcome_counts(bus):
    later, heard = Deferred(), []

    async def handler(command):
        heard.append(await later)
        raise CommandRefusedError("in the end not")

    bus.register_command(NumberCommand, handler)
    got = outcome_of(bus)
    assert not got
    later.callback("came")
    assert heard == ["came"]
    assert got[0].check(CommandRefusedError)


def test_what_was_registered_is_taken_back_as_a_whole(bus):
    heard = []
    bus.register_command(NumberCommand, lambda _: heard.append("old"))
    cleanups = CleanupStack()
    with cleanups.recording():
        gone = bus.register_command(NumberCommand, lambda _: heard.append("gone already"))
        bus.register_command(NumberCommand, lambda _: heard.append("new"))
        bus.register_command(OtherCommand, lambda _: heard.append("other"))
    bus.register_command(NumberCommand, lambda _: heard.append("later"))
    bus.unregister_command(NumberCommand, gone)
    cleanups.unwind()
    bus.execute_command(NumberCommand(1))
    bus.execute_command(OtherCommand())
    assert heard == ["old", "later"]
    assert not bus.handlers_of(OtherCommand)
    with cleanups.recording():
        bus.register_command(OtherCommand, lambda _: heard.append("too late"))
    assert not bus.handlers_of(OtherCommand)
