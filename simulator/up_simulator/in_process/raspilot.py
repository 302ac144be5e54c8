"""The unmodified daemon, in this process and in simulated time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from random import Random
from typing import Any, cast

from constantly import NamedConstant
from twisted.internet.defer import Deferred
from twisted.internet.task import LoopingCall
from twisted.logger import ILogObserver, LogEvent, Logger, globalLogPublisher
from twisted.python.failure import Failure
from zope.interface import implementer

from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule, StartResult
from up.commands.system_commands import SystemStopCommand
from up.config import load_all
from up.errors import UserError
from up.life_cycle import BootStoppedError, LifeCycle
from up.loading.application import Application
from up.loading.checking import check_application, config_files
from up.log.levels import level_named, level_of, word_of
from up.log.text import source_of, text_of, traceback_of
from up.mode import Mode
from up.program import make_context
from up.protocols.serial_line import SerialLike
from up.protocols.serial_port import SerialPortError
from up.up import Up
from up.up_loader import UpLoader
from up_simulator.firmware.board import FirmwareBoard
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.world import BYTES_A_STEP
from up_simulator.in_process.host import SimulatedHost
from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.in_process.socket_line import SocketLine
from up_simulator.sensors.twin import TwinBus

MAX_LOG_LINES = 2000
I2C_PERIOD_S = 0.01


@implementer(ILogObserver)
class DaemonLog:
    """Keeps the newest lines, between ``open`` and ``close``; no other observer is touched."""

    def __init__(self, seconds: Callable[[], float]) -> None:
        self.lines: deque[str] = deque(maxlen=MAX_LOG_LINES)
        self._seconds = seconds
        self._level: NamedConstant | None = None

    def open(self, level: NamedConstant) -> None:
        """Take every event of that level and above from now on."""
        if self._level is None:
            globalLogPublisher.addObserver(cast(ILogObserver, self))
        self._level = level

    def close(self) -> None:
        if self._level is not None:
            self._level = None
            globalLogPublisher.removeObserver(cast(ILogObserver, self))

    def add(self, text: str) -> None:
        self.lines.append(f"{self._seconds():9.3f} {text}")

    def __call__(self, event: LogEvent) -> None:
        level = self._level
        if level is not None and level_of(event) >= level:
            self.add(f"{word_of(level_of(event)):<8} {source_of(event)}: {text_of(event)}")
            self.lines.extend(f"    {line}" for line in traceback_of(event, level).splitlines())


class SettableMeter:
    """The load that the Load Guard sees, percent."""

    def __init__(self) -> None:
        self.load = 10.0
        self.memory = 20.0

    def load_percent(self) -> float:
        return self.load

    def memory_percent(self) -> float:
        return self.memory


class InProcessRaspilot:
    """Loads, starts, stops and kills the application as its program does.

    A folder configures it (``write_config``). Its serial port is a socket in this process, whatever
    port its configuration names, which ``pump`` connects with a board; ``line`` can be unplugged.
    So are the ports of a satellite receiver, ``gps_line``, of a CRSF receiver, ``crsf_line``, and
    of goggles, ``goggles_line``; ``i2c`` is its I2C bus. Its random numbers follow ``seed``.
    Signals, the process's priority, its watchdogs and its garbage collector belong to the program,
    and are not part of this. A proxy must be configured by its address: a name would be resolved by
    a thread.
    """

    log_source = Logger()

    def __init__(self, reactor: SimulatedReactor, config_folder: Path, *, seed: int = 1) -> None:
        self.meter = SettableMeter()
        self.line = SocketLine()
        self.gps_line, self.crsf_line, self.goggles_line = SocketLine(), SocketLine(), SocketLine()
        self.i2c = TwinBus({})
        self.up: Up | None = None
        self.boots = 0
        self._reactor = reactor
        self._config_folder = config_folder
        self._seed = seed
        self._log = DaemonLog(reactor.seconds)
        self._host: SimulatedHost | None = None
        self._life: LifeCycle | None = None
        self._is_stopping = False

    @property
    def is_running(self) -> bool:
        """Return whether the process would be there: booting, running or stopping."""
        return self._host is not None

    @property
    def log(self) -> Sequence[str]:
        """Return the newest lines of all starts, with simulated seconds."""
        return list(self._log.lines)

    def start(self) -> None:
        """Begin to boot; raises ParticipantError with every error that the program would print."""
        if self.is_running:
            raise ParticipantError("Raspilot is already running")
        host = self._reactor.host()
        application = None
        try:
            application = Application.installed("raspilot")
            context = make_context(application, host, self._config_folder, {})
            # A later start draws other numbers, as a later process would.
            context.random = Random(self._seed + 1_000_003 * self.boots)
            self._log.open(level_named(context.application.log_level))
            plan = UpLoader(application, context).plan()
            load_all(context.config_folder, config_files(plan.modules))
            up = Up(plan, context)
            self._substitute_modules(up)
            up.initialize()
        except UserError as error:
            self._log.close()
            problems = list(map(str, error.problems))
            if application is not None:
                words = {"UP_MODE": Mode.AUTO.value}
                context = make_context(application, host, self._config_folder, words)
                problems += map(str, check_application(application, context).problems)
            host.cut_off()
            raise ParticipantError("\n".join(dict.fromkeys(problems))) from error
        self.boots += 1
        self._host, self.up, self._is_stopping = host, up, False
        self._life = LifeCycle(up)
        up.command_executor.adopt_thread()
        up.command_executor.register_command(SystemStopCommand, lambda _: self.stop())
        host.callLater(0.0, self._begin)

    def stop(self) -> None:
        """Stop every module, as at a SIGTERM: it has ended after 2 s at the latest."""
        if self._life is None or self._is_stopping:
            return
        self._is_stopping = True
        life, host = self._life, self._host
        done = Deferred.fromCoroutine(life.stop())
        done.addErrback(self._failed, "stopping failed")
        done.addBoth(lambda _: self.kill() if self._host is host else None)

    def kill(self) -> None:
        """Cut off timers, ports, connections, and the serial line in mid-frame."""
        host, self._host = self._host, None
        if host is None:
            return
        self._log.close()
        host.cut_off()
        for line in (self.line, self.gps_line, self.crsf_line, self.goggles_line):
            line.cut()
        self.up = self._life = None

    def freeze(self) -> None:
        """Raise ParticipantError: only a process can be suspended."""
        raise ParticipantError("only a real daemon can be suspended: use 'runs: real'")

    thaw = freeze

    def pump(self, board: FirmwareBoard) -> None:
        """Move the bytes of 2 ms between the board and the daemon; call it at every step."""
        # The rest waits in the socket, and is lost when the daemon is killed.
        data = self.line.read(0.0, BYTES_A_STEP)
        if data:
            board.write(data)
        data = board.read()
        if data:
            self.line.write(data)

    def module(self, class_name: str) -> BaseModule:
        """Return a module that is loaded now; raises LookupError."""
        for module in [] if self.up is None else self.up.modules:
            if module.class_name == class_name:
                return module
        raise LookupError(f"no module {class_name} is loaded")

    def _substitute_modules(self, up: Up) -> None:
        lines = {
            "SerialProvider": self.line,
            "GpsProvider": self.gps_line,
            "CrsfReceiver": self.crsf_line,
            "GogglesOsd": self.goggles_line,
        }
        for module in up.modules:
            each: Any = module
            if module.class_name in lines:
                each.open_port = partial(_open, lines[module.class_name])
            elif module.class_name == "I2cSensors":
                each.open_bus = lambda _number: self.i2c
                each.start = partial(_start_in_reactor, each)
            elif module.class_name == "LoadGuard":
                each.meter = self.meter

    def _begin(self) -> None:
        assert self._life is not None
        Deferred.fromCoroutine(self._life.start()).addErrback(self._boot_failed)

    def _boot_failed(self, failure: Failure) -> None:
        if failure.check(BootStoppedError):
            self._log.add(failure.getErrorMessage())
        else:
            self._failed(failure, "the boot failed")
        self.stop()

    def _failed(self, failure: Failure, what: str) -> None:
        self.log_source.failure(what, failure)


def _open(line: SocketLine, path: str, baud: int) -> SerialLike:
    if not line.is_plugged:
        raise SerialPortError(f"{path} is missing: is the board plugged in?")
    return line.open()


async def _start_in_reactor(sensors: Any) -> StartResult:
    """Start the module that reads the I2C bus; a thread would not be in simulated time."""
    result = await BaseStartedModule.start(sensors)
    loop = LoopingCall(sensors.poll)
    loop.clock = sensors.context.reactor
    loop.start(I2C_PERIOD_S, now=False)
    return result
