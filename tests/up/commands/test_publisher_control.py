"""One publisher of set-points and Outputs at a time; a second one is refused and named."""

import threading

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.task import LoopingCall

from tests.up.commands.samples import Log
from up.base_started_module import BaseStartedModule
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand, SetpointCommand
from up.commands.publisher_control import SILENCE_S
from up.commands.refusal import CommandRefusedError
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand
from up.testing import Bench

OUTPUT = OutputCommand(1500, 1500, 0, 1500, 1)


class Mode(BaseStartedModule):
    """Publishes a set-point every 20 ms, as a flight mode does."""

    ROLL_DEG = 0.0

    def on_init(self):
        self.loop = LoopingCall(self.step)
        self.loop.clock = self.context.reactor

    def on_start(self):
        self.loop.start(0.02)

    def on_stop(self):
        self.loop.stop()

    def step(self):
        self.up.command_executor.execute_command(SetpointCommand(self.ROLL_DEG, 0.0))


class Thermal(Mode):
    ROLL_DEG = 30.0


class Level(Mode):
    pass


class Sink(BaseStartedModule):
    """Remembers delivered Commands."""

    def on_init(self):
        self.rolls, self.origins, self.outputs, self.seen = [], [], [], []
        executor = self.up.command_executor
        executor.register_command(SetpointCommand, self.on_setpoint)
        executor.register_command(OutputCommand, self.outputs.append)
        executor.add_observer(lambda command, origin: self.seen.append((command, origin.link)))

    def on_setpoint(self, command):
        self.rolls.append(command.roll_deg)
        self.origins.append(self.up.command_executor.origin.link)


@pytest.fixture
def bench(tmp_path):
    bench = Bench(Sink, Thermal, Level, config_folder=tmp_path)
    bench.start()
    yield bench
    bench.stop()


def control(bench):
    content = bench.up.telemetry_content
    return content["control"]["publisher"], content["counters"]["control"]


def test_the_first_publisher_keeps_control_and_the_second_is_refused_and_named(bench):
    sink = bench.module(Sink)
    with Log() as log:
        first = sink.origins[0]
        second = ({"Thermal", "Level"} - {first}).pop()
        bench.advance(*[0.02] * 50)
    assert len(sink.rolls) >= 50 and set(sink.origins) == {first} and len(set(sink.rolls)) == 1
    setpoints = [link for command, link in sink.seen if isinstance(command, SetpointCommand)]
    assert set(setpoints) == {first}, "an observer, so the flight's log, has the flown ones only"
    publisher, refused = control(bench)
    assert publisher == first and list(refused) == [second] and refused[second] >= 50
    assert not [event for event in log.events if event.get("code") == "control_taken"]


def test_the_refusal_is_logged_once_with_its_fields(tmp_path):
    bench = Bench(Sink, Thermal, Level, config_folder=tmp_path)
    with Log() as log:
        bench.start()
        bench.advance(*[0.02] * 20)
    (event,) = [event for event in log.events if event.get("code") == "control_taken"]
    assert {event["publisher"], event["owner"]} == {"Thermal", "Level"}
    assert event["command"] == SetpointCommand.NAME
    bench.stop()


def test_control_passes_on_after_silence_and_after_a_stop(bench):
    sink = bench.module(Sink)
    first = bench.module(Thermal if sink.origins[0] == "Thermal" else Level)
    second = bench.module(Level if sink.origins[0] == "Thermal" else Thermal)
    first.loop.stop()
    bench.advance(SILENCE_S - 0.03)
    assert control(bench)[0] == first.class_name
    bench.advance(0.05, 0.02)
    assert control(bench)[0] == sink.origins[-1] == second.class_name
    first.loop.start(0.02)
    bench.advance(0.02)
    assert control(bench)[0] == second.class_name
    bench.up.command_executor.control.release(first.class_name)
    assert control(bench)[0] == second.class_name, "only the owner's stop counts"
    bench.up.exclude(second, "failed")
    second.loop.stop()
    bench.advance(0.02)
    assert control(bench)[0] == sink.origins[-1] == first.class_name
    second.loop.start(10)


def test_outputs_and_setpoints_share_the_lease_however_they_are_published(bench):
    executor, sink = bench.up.command_executor, bench.module(Sink)
    owner = sink.origins[0]
    executor.execute_command(OUTPUT)
    executor.execute_command(OUTPUT, Origin("ModeManager", Role.INTERNAL))
    outcome = executor.execute_and_wait(OUTPUT, Origin("ModeManager", Role.INTERNAL))
    outcome.addErrback(lambda failure: failure.check(CommandRefusedError))
    assert isinstance(outcome, Deferred) and outcome.result is CommandRefusedError
    thread = threading.Thread(target=executor.execute_command, args=(OUTPUT,))
    thread.start()
    thread.join()
    bench.clock.take_call()
    assert sink.outputs == [] and control(bench)[0] == owner


def test_a_publisher_inside_a_handler_is_itself_not_the_module_above_it(bench):
    """A handler's publication waits for its turn; it is the handler's module's all the same."""
    executor, sink = bench.up.command_executor, bench.module(Sink)
    owner, other = bench.module(Thermal), bench.module(Level)
    if sink.origins[0] == "Level":
        owner, other = other, owner
    owner.loop.stop()
    other.loop.stop()
    bench.advance(1.0)
    sink.origins.clear()
    executor.register_command(LinkStateCommand, lambda _: other.step())
    executor.execute_command(LinkStateCommand("test", True))
    assert sink.origins == [other.class_name]
    for each in (owner, other):
        each.loop.start(10)
