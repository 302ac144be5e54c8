"""Calls that block the reactor are named, on a real reactor."""

import signal
import sys
import threading
import time
from functools import partial
from pathlib import Path

import pytest
from twisted.internet.endpoints import TCP4ClientEndpoint, connectProtocol
from twisted.internet.protocol import Factory, Protocol

from tests.support.reactor import reactor, run_in_reactor, sleep, until
from tests.support.system import build_up
from tests.up.commands.samples import Log, NumberCommand
from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.system.reactor_monitor import BUDGET_S, OTHERS, ReactorMonitor, blocking_call_in

OWNERS = (BaseModule, BaseCommandHandler)
HOLD_S = 0.06
LONG_HOLD_S = 1.0


def hold(seconds=HOLD_S):
    """Hold the thread in Python, as a loop that is too long does."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        pass


class HoldingHandler(BaseCommandHandler):
    """A handler object that holds."""

    COMMAND = NumberCommand

    def run_action(self, command):
        hold()


class HoldingModule(BaseModule):
    """Blocks wherever it is called."""

    def on_number(self, command):
        hold()

    def on_timer(self):
        hold()


class HoldingProtocol(Protocol):
    """A connection that belongs to a module, or to none."""

    module = None

    def dataReceived(self, data):  # noqa: N802
        if self.module is None:
            hold()
        else:
            self.module.on_timer()
        self.transport.loseConnection()


def blocked_calls(log):
    return [each["call"] for each in log.events if each.get("code") == "event_loop_blocked"]


def watch(folder, scenario, has_started=True):
    """Run a scenario under the monitor; return the names that it reported."""

    async def run():
        up = build_up((HoldingModule,), reactor, folder, builtins=False)
        up.command_executor.adopt_thread()
        monitor = ReactorMonitor(reactor, OWNERS)
        monitor.start()
        monitor.has_started = has_started
        try:
            await scenario(up, monitor)
        finally:
            monitor.stop()
        return monitor.blocking_calls

    return run_in_reactor(run)


class Sender(Protocol):
    """The other side."""

    is_over = False

    def connectionLost(self, reason):  # noqa: N802
        self.is_over = True


async def repeat(block, is_noticed):
    """Block until it is noticed: on a busy machine the monitor's thread may miss a short block."""
    # A turn has one alarm.
    await sleep(0)
    while not is_noticed():
        block()
        await sleep(0)


async def send(module):
    """Send a byte to a connection whose protocol blocks."""
    factory = Factory.forProtocol(HoldingProtocol)
    HoldingProtocol.module = module
    port = reactor.listenTCP(0, factory, interface="127.0.0.1")
    sender = Sender()
    factory.noisy = False
    endpoint = TCP4ClientEndpoint(reactor, "127.0.0.1", port.getHost().port)
    await connectProtocol(endpoint, sender)
    sender.transport.write(b"x")
    await until(lambda: sender.is_over)
    await port.stopListening()


def test_a_handler_of_a_module(tmp_path):
    async def scenario(up, monitor):
        module = up.get_module(HoldingModule)
        up.command_executor.register_command(NumberCommand, module.on_number)
        execute = partial(up.command_executor.execute_command, NumberCommand(1))
        await repeat(execute, lambda: "HoldingModule" in monitor.blocking_calls)

    with Log() as log:
        assert "HoldingModule" in watch(tmp_path, scenario)
    assert blocked_calls(log).count("HoldingModule") == 1


def test_what_holds_during_the_start_is_information_and_later_an_error(tmp_path):
    async def scenario(up, monitor):
        module = up.get_module(HoldingModule)
        up.command_executor.register_command(NumberCommand, module.on_number)
        for monitor.has_started in (False, True):
            execute = partial(up.command_executor.execute_command, NumberCommand(1))
            await repeat(execute, lambda: len(named()) == 1 + monitor.has_started)

    def named():
        events = [each for each in log.events if each.get("call") == "HoldingModule"]
        return [each["log_level"].name for each in events]

    with Log() as log:
        counts = watch(tmp_path, scenario, has_started=False)
    assert named() == ["info", "error"]
    assert counts["HoldingModule"] == 1


def test_a_handler_object(tmp_path):
    async def scenario(up, monitor):
        up.command_executor.register_command(NumberCommand, HoldingHandler())
        execute = partial(up.command_executor.execute_command, NumberCommand(1))
        await repeat(execute, lambda: "HoldingHandler" in monitor.blocking_calls)

    assert "HoldingHandler" in watch(tmp_path, scenario)


def test_a_timer(tmp_path):
    async def scenario(up, monitor):
        on_timer = partial(reactor.callLater, 0, up.get_module(HoldingModule).on_timer)
        await repeat(on_timer, lambda: "HoldingModule" in monitor.blocking_calls)

    assert "HoldingModule" in watch(tmp_path, scenario)


def test_data_received_of_a_module_and_of_nobody(tmp_path):
    async def scenario(up, monitor):
        while "HoldingModule" not in monitor.blocking_calls:
            await send(up.get_module(HoldingModule))
        while not any("reactor_monitor_cases.hold" in each for each in monitor.blocking_calls):
            await send(None)

    watch(tmp_path, scenario)


def test_it_is_named_while_it_still_holds(tmp_path):
    named_after_s = []

    async def scenario(up, monitor):
        def long():
            began_s = time.monotonic()
            while not monitor.blocking_calls and time.monotonic() - began_s < 30:
                pass
            named_after_s.append(time.monotonic() - began_s)

        reactor.callLater(0.1, long)
        await until(lambda: named_after_s)

    watch(tmp_path, scenario)
    assert named_after_s[0] < 30, "it was the name that ended the hold, not its limit"


def test_one_hold_is_counted_once_and_logged_once(tmp_path):
    async def scenario(up, monitor):
        module, calls = up.get_module(HoldingModule), monitor.blocking_calls

        def hold_on(command):
            """Hold until it is noticed, and on."""
            before, end_s = counted(), time.monotonic() + 5 * LONG_HOLD_S
            # No function of ours: the innermost one is named.
            while max(calls.values(), default=0) == before and time.monotonic() < end_s:
                pass
            hold(LONG_HOLD_S)

        def counted():
            # A machine that is busy elsewhere may hold something else up, once.
            return max(calls.values(), default=0)

        module.on_number = hold_on
        up.command_executor.register_command(NumberCommand, lambda c: module.on_number(c))
        execute = partial(up.command_executor.execute_command, NumberCommand(1))
        for count in (1, 2):
            await repeat(execute, lambda count=count: counted() >= count)
            await sleep(0.1)
            assert counted() == count, calls

    with Log() as log:
        counts = watch(tmp_path, scenario)
    assert len(blocked_calls(log)) == len(counts)


class SlowModule(BaseModule):
    """May hold the loop longer than others."""

    TIME_BUDGET_S = 1.0

    def on_timer(self, seconds):
        hold(seconds)


def test_a_module_may_declare_a_longer_budget(tmp_path):
    async def scenario(up, monitor):
        slow = SlowModule()
        # Others are watched while its budget passes.
        reactor.callLater(0, slow.on_timer, 0.1)
        await sleep(0.2)
        assert "SlowModule" not in monitor.blocking_calls
        while "HoldingModule" not in monitor.blocking_calls:
            reactor.callLater(0, slow.on_timer, 0.1)
            reactor.callLater(0.01, up.get_module(HoldingModule).on_timer)
            await sleep(0.2)
        assert "SlowModule" not in monitor.blocking_calls
        on_timer = partial(reactor.callLater, 0, slow.on_timer, 1.5)
        await repeat(on_timer, lambda: "SlowModule" in monitor.blocking_calls)

    with Log() as log:
        watch(tmp_path, scenario)
    assert [each["ms"] for each in log.events if each.get("call") == "SlowModule"] == [1000]


def test_an_idle_reactor_is_not_counted_and_wakes_nobody(tmp_path):
    async def scenario(up, monitor):
        before = switches(monitor)
        await sleep(1.0)
        assert switches(monitor) - before < 10

    assert sum(watch(tmp_path, scenario).values()) < 5


def switches(monitor):
    """Return how often the monitor's thread has slept."""
    status = Path(f"/proc/self/task/{monitor._thread.native_id}/status").read_text()
    return int(status.partition("voluntary_ctxt_switches:")[2].split()[0])


def test_a_thread_that_was_there_before_does_not_end_the_program(tmp_path):
    over = threading.Event()
    older = threading.Thread(target=over.wait)
    older.start()

    async def scenario(up, monitor):
        module = up.get_module(HoldingModule)
        for _ in range(3):
            reactor.callLater(0, module.on_timer)
            await sleep(0.1)

    watch(tmp_path, scenario)
    over.set()
    older.join()


def test_afterwards_the_reactor_is_as_it_was(tmp_path):
    before = reactor._poller

    async def scenario(up, monitor):
        assert reactor._poller is not before

    watch(tmp_path, scenario)
    assert reactor._poller is before
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
    assert signal.SIGALRM not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def test_the_names_are_bounded():
    monitor = ReactorMonitor(None, OWNERS)
    monitor.has_started = True
    for number in range(200):
        frames = {"__name__": f"module_{number}"}
        exec("import sys\nframe = sys._getframe()", frames)
        monitor._count_block(*blocking_call_in(frames["frame"], OWNERS))
    assert len(monitor.blocking_calls) <= 51
    assert monitor.blocking_calls[OTHERS] == 150


def test_nobody_in_the_stack():
    assert blocking_call_in(None, OWNERS) == ("?", BUDGET_S)


@pytest.mark.parametrize("bad", [7, object()])
def test_a_self_that_is_no_module(bad):
    def inner(self):
        return blocking_call_in(sys._getframe(), OWNERS)

    assert "inner" in inner(bad)[0]
