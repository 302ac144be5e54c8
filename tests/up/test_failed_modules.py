import pytest
from twisted.internet.defer import CancelledError, Deferred

from tests.up.commands.samples import NumberCommand, OtherCommand
from tests.up.test_life_cycle import System
from up.base_started_module import BaseStartedModule
from up.commands.orientation_command import OrientationCommand
from up.commands.output_command import OutputCommand
from up.needs import needs, wants
from up.telemetry_controller import TelemetryController


class Controller(BaseStartedModule):
    """Flies on every orientation, as a flight controller does."""

    def on_init(self):
        self.up.command_executor.register_command(OrientationCommand, self._on_orientation)
        self.up.command_receiver.register_route("servo", lambda *_: None)
        self.up.vetoes.on_changed = lambda: self.up.command_executor.execute_command(
            OutputCommand(1500, 1500, 1000, 1500, 1)
        )

    def _on_orientation(self, command):
        self.up.command_executor.execute_command(OutputCommand(1500, 1500, 1000, 1500, 1))

    @property
    def telemetry_content(self):
        return {"controller": "flies"}


class Raising(Controller):
    """Raises in its start."""

    def on_start(self):
        self.up.command_executor.register_command(NumberCommand, self._on_orientation)
        self.up.advertise_port("servo", 4000)
        raise RuntimeError("boom")


class RaisingLater(Controller):
    """Subscribes and raises after a pause."""

    async def on_start(self):
        pause = Deferred()
        self.context.reactor.callLater(1, pause.callback, None)
        await pause
        self.up.command_executor.register_command(NumberCommand, self._on_orientation)
        self.up.advertise_port("servo", 4000)
        return False


class Stubborn(Controller):
    """Subscribes when its start was given up already."""

    async def on_start(self):
        try:
            await Deferred()
        except CancelledError:
            self.up.command_executor.register_command(NumberCommand, self._on_orientation)


class Uninitialized(Controller):
    """Raises at the end of its initialization."""

    def on_init(self):
        super().on_init()
        self.up.command_executor.register_command(NumberCommand, self._on_orientation)
        raise SystemExit(1)


class Broken(BaseStartedModule):
    """Is needed and does not start."""

    def on_start(self):
        return False


class Needing(Controller):
    """Is skipped, because a dependency did not start."""

    broken = needs(Broken)


class Wanting(BaseStartedModule):
    """Does without the controller."""

    controller = wants(Controller)

    def on_start(self):
        self.seen = self.controller


@pytest.mark.parametrize("cls", [Raising, RaisingLater, Stubborn, Uninitialized, Needing])
def test_a_failed_controller_puts_out_nothing_and_is_nowhere(tmp_path, cls):
    system = System(tmp_path, cls, Broken, Wanting, TelemetryController)
    system.start()
    system.clock.pump([0.5] * 24)
    assert cls.__name__ not in system.running
    assert "Wanting" in system.running
    outputs = []
    executor = system.up.command_executor
    executor.register_command(OutputCommand, outputs.append)
    for command in (OrientationCommand(1.0, 2.0, 3.0), NumberCommand(1)):
        executor.execute_command(command)
    system.up.vetoes.set("another", "reason")
    assert outputs == []
    assert system.up.get_module(Controller) is None
    assert system.up.get_module(Wanting).seen is None
    assert system.up.get_module(Wanting).controller is None
    assert system.up.ports == {}
    assert "controller" not in system.up.get_module(TelemetryController).collect()
    system.up.command_receiver.register_route("servo", lambda *_: None)
    assert system.reason(cls)


def test_a_controller_that_starts_flies(tmp_path):
    system = System(tmp_path, Controller, Wanting)
    outputs = []
    system.up.command_executor.register_command(OutputCommand, outputs.append)
    system.start()
    system.up.command_executor.execute_command(OrientationCommand(1.0, 2.0, 3.0))
    assert len(outputs) == 1
    with pytest.raises(ValueError):
        system.up.command_receiver.register_route("servo", lambda *_: None)


def test_what_a_module_that_runs_subscribes_later_stays(tmp_path):
    class Late(BaseStartedModule):
        def on_start(self):
            self.heard = []
            self.context.reactor.callLater(1, self._subscribe)

        def _subscribe(self):
            self.up.command_executor.register_command(OtherCommand, self.heard.append)

    system = System(tmp_path, Late, Broken)
    system.start()
    system.clock.advance(1)
    system.up.command_executor.execute_command(OtherCommand())
    assert system.up.get_module(Late).heard == [OtherCommand()]
