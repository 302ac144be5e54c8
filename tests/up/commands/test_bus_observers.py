"""An observer of the bus sees every Command without being a handler."""

import pytest
from twisted.internet.defer import Deferred

from tests.up.commands.samples import Border, Log, NumberCommand, OtherCommand, make_bus
from up.cleanup import CleanupStack
from up.commands.origin import INTERNAL, Origin
from up.commands.refusal import CommandRefusedError, UnhandledCommandError
from up.commands.roles import Role

GROUND = Origin("ground", Role.PILOT)


@pytest.fixture
def bus():
    return make_bus()


class Recorder:
    """Records the Commands that it sees."""

    def __init__(self, bus):
        self.seen = []
        bus.add_observer(self.observe)

    def observe(self, command, origin):
        self.seen.append((command, origin))


class Clumsy:
    """An observer that fails."""

    def __init__(self, fault):
        self.fault = fault

    def observe(self, command, origin):
        raise self.fault


def test_it_sees_what_is_handled_and_what_nobody_handles_with_the_origin(bus):
    recorder = Recorder(bus)
    bus.register_command(NumberCommand, lambda _: None)
    bus.execute_command(NumberCommand(1), GROUND)
    bus.execute_command(NumberCommand(2))
    bus.execute_command(OtherCommand(), GROUND)
    bus.execute_command(OtherCommand())
    assert recorder.seen == [
        (NumberCommand(1), GROUND),
        (NumberCommand(2), INTERNAL),
        (OtherCommand(), GROUND),
        (OtherCommand(), INTERNAL),
    ]


def test_it_sees_a_command_before_its_handlers(bus):
    order = []
    bus.register_command(NumberCommand, lambda _: order.append("handler"))
    bus.add_observer(lambda command, origin: order.append("observer"))
    bus.register_command(NumberCommand, lambda _: order.append("later handler"))
    bus.execute_command(NumberCommand(1))
    bus.execute_and_wait(NumberCommand(1), GROUND)
    assert order == ["observer", "handler", "later handler"] * 2


def test_a_publish_of_an_observer_waits_its_turn(bus):
    heard = []
    bus.register_command(OtherCommand, lambda _: heard.append("other"))
    bus.register_command(NumberCommand, lambda _: heard.append("number"))

    def publish(command, origin):
        if isinstance(command, NumberCommand):
            bus.execute_command(OtherCommand())

    bus.add_observer(publish)
    bus.execute_command(NumberCommand(1))
    assert heard == ["number", "other"]


def test_what_only_an_observer_sees_stays_unhandled(bus):
    recorder = Recorder(bus)
    got = []
    bus.execute_and_wait(NumberCommand(1), GROUND).addBoth(got.append)
    assert got[0].check(UnhandledCommandError)
    bus.execute_command(NumberCommand(2), GROUND)
    assert bus.counters["unhandled"] == 2
    assert bus.handlers_of(NumberCommand) == ()
    assert len(recorder.seen) == 2


def test_a_peer_is_told_that_nobody_handled_what_an_observer_saw():
    border = Border()
    recorder = Recorder(border.bus)
    border.say("test.number", {"number": 1}, "a")
    assert border.codes == ["unavailable"]
    command, answered = [command for command, _ in recorder.seen]
    assert command == NumberCommand(1)
    assert (answered.name, answered.code) == ("test.number", "unavailable")


@pytest.mark.parametrize("fault", [RuntimeError("clumsy"), CommandRefusedError("no"), SystemExit()])
@pytest.mark.parametrize("ask", [False, True])
def test_its_fault_is_named_and_counted_and_harms_nobody(bus, ask, fault):
    heard, owners, got = [], [], []
    bus.on_handler_failed = owners.append
    bus.add_observer(Clumsy(fault).observe)
    recorder = Recorder(bus)
    bus.register_command(NumberCommand, heard.append)
    with Log() as log:
        if ask:
            bus.execute_and_wait(NumberCommand(1), GROUND).addBoth(got.append)
            assert got == [None]
        else:
            bus.execute_command(NumberCommand(1), GROUND)
    assert heard == [NumberCommand(1)]
    assert len(recorder.seen) == 1
    assert owners == ["Clumsy"]
    assert bus.counters == {"failed_handlers": 1}
    assert [event["owner"] for event in log.of("handler_failed")] == ["Clumsy"]


def test_what_it_returns_delays_no_outcome(bus):
    bus.add_observer(lambda command, origin: Deferred())
    bus.register_command(NumberCommand, lambda _: None)
    got = []
    bus.execute_and_wait(NumberCommand(1), GROUND).addBoth(got.append)
    assert got == [None]


def test_what_is_no_observer_is_refused(bus):
    async def later(command, origin):
        """Never awaited by anybody."""

    for wrong in ("text", later):
        with pytest.raises(TypeError):
            bus.add_observer(wrong)


def test_it_is_taken_back_with_its_module(bus):
    cleanups = CleanupStack()
    with cleanups.recording():
        recorder = Recorder(bus)
    cleanups.unwind()
    bus.execute_command(NumberCommand(1))
    assert not recorder.seen
