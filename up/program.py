"""The program of an Up application: from the command line to the exit status."""

import os
import signal
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from twisted.internet.defer import Deferred
from twisted.logger import Logger

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.config import ConfigErrors, load_all, no_configuration
from up.config.atomic_writer import remove_unfinished
from up.context import Context
from up.errors import Problem, UserError
from up.life_cycle import BootStoppedError, LifeCycle
from up.loading.application import Application
from up.loading.checking import check_application, config_files
from up.loading.plan import BootError
from up.log import start_logging
from up.mode import Mode
from up.output import print_problems
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE
from up.system.deadline_watch import start_from_environment
from up.system.exit_watchdog import ExitWatchdog
from up.system.gc_scheduler import GcScheduler, frozen_imports
from up.system.notify import Notifier, WatchdogPinger
from up.system.pid_file import service
from up.system.reactor_monitor import ReactorMonitor
from up.system.scheduling import use_realtime_priority
from up.system.signal_wakeup import SignalWakeup
from up.up import Up
from up.up_loader import UpLoader

EXIT_OK = 0
EXIT_STOPPED = 1
EXIT_CONFIG = 2
EXIT_INTERRUPTED = 130
FORCED_AFTER_S = 2.0


class Program:
    """Runs one application on the reactor until a signal, a Command or a failed boot ends it."""

    log = Logger()

    def __init__(self, up: Up, environ: Mapping[str, str] = os.environ) -> None:
        self._up = up
        self._reactor = up.context.reactor
        self._life = LifeCycle(up)
        self._notifier = Notifier.from_environment(environ)
        self._watchdog = WatchdogPinger(
            self._reactor, lambda: self._life.is_healthy, self._notifier, environ
        )
        self._gc_scheduler = GcScheduler(self._reactor)
        self._monitor = ReactorMonitor(self._reactor, (BaseModule, BaseCommandHandler))
        up.count("reactor", self._monitor.blocking_calls)
        self._exit_watchdog = ExitWatchdog(FORCED_AFTER_S)
        self._exit_status = EXIT_OK
        self._stopping = False
        self._running = False
        self._signals = 0

    def run(self) -> int:
        """Start the modules, run the reactor, stop the modules; return the exit status."""
        from up.commands.system_commands import SystemStopCommand

        self._up.command_executor.adopt_thread()
        self._up.command_executor.register_command(
            SystemStopCommand, lambda _: self.stop("a module asked for it")
        )
        self._monitor.start()
        self._exit_watchdog.start()
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._on_signal)
        SignalWakeup(self._reactor).start()
        self._reactor.callWhenRunning(self._begin)
        self._reactor.run(installSignalHandlers=False)
        return self._exit_status

    def stop(self, why: str) -> None:
        """Stop everything and then the reactor; idempotent."""
        if self._stopping:
            return
        self._stopping = True
        self.log.info("stopping: {why}", why=why, code="stopping")
        self._notifier.stopping(why)
        self._exit_watchdog.request(self._exit_status or EXIT_STOPPED)
        done = Deferred.fromCoroutine(self._end())
        done.addErrback(
            lambda failure: self.log.failure("stopping failed", failure, code="stop_failed")
        )
        done.addCallback(self._ended)

    def _ended(self, result: None) -> None:
        self._exit_watchdog.cancel()
        self._reactor.stop()

    def _begin(self) -> None:
        self._watchdog.start()
        Deferred.fromCoroutine(self._start()).addErrback(self._boot_failed)

    async def _start(self) -> None:
        await self._life.start()
        if self._stopping:
            return
        self._running = True
        self._up.on_ports_changed = self._notify_ports
        self._notify_ports()
        self._notifier.ready(f"{len(self._life.started)} modules run")
        self._gc_scheduler.start()
        # Runs after the reactor's next wait: the current turn belongs to the start.
        later = self._reactor.callLater
        later(0, later, 0, setattr, self._monitor, "has_started", True)
        self.log.info("{count} modules run", count=len(self._life.started), code="started")
        if self._up.vetoes.own:
            self.log.warn(
                "arming is refused: {vetoes}",
                vetoes="; ".join(self._up.vetoes.own),
                code="arming_refused",
            )

    def _notify_ports(self) -> None:
        ports = " ".join(f"{name}:{port}" for name, port in sorted(self._up.ports.items()))
        self._notifier.variable("X_UP_PORTS", ports)

    def _boot_failed(self, failure: Any) -> None:
        self._exit_status = EXIT_STOPPED
        if failure.check(BootStoppedError):
            print_problems(failure.value.problems)
            self.stop("the boot was stopped")
        else:
            self.log.failure("the boot failed", failure, code="boot_failed")
            self.stop("the boot failed")

    async def _end(self) -> None:
        self._watchdog.stop()
        await self._life.stop()
        self._monitor.stop()
        if self._running:
            self._gc_scheduler.stop()

    def _on_signal(self, number: int, frame: object) -> None:
        self._signals += 1
        if self._signals > 1:
            os._exit(128 + number)
        # Requested here, because a blocked event loop could not do it.
        self._exit_watchdog.request(EXIT_STOPPED)
        self._reactor.callFromThread(self.stop, signal.Signals(number).name)


@service()
def run_application(
    start: Path,
    config_folder: Path | None = None,
    environ: Mapping[str, str] = os.environ,
    *,
    use_defaults: bool = False,
) -> int:
    """Run the application that a folder belongs to; return the exit status.

    A folder without any configuration file is refused unless ``use_defaults``. Errors that a user
    can fix are all printed on stderr, one sentence each, with exit status 2.
    """
    from twisted.internet import reactor

    from up.system.clock import use_monotonic_time

    use_monotonic_time(reactor)
    start_from_environment(environ)
    application = None
    try:
        application = Application.find(start)
        context = make_context(application, reactor, config_folder, environ)
        _start_log(context)
        use_realtime_priority(context.application.realtime_priority)
        with frozen_imports():
            plan = UpLoader(application, context).plan()
        files = config_files(plan.modules)
        nothing = no_configuration(context.config_folder, files)
        if nothing is not None and not use_defaults:
            raise nothing
        load_all(context.config_folder, files)
        remove_unfinished(context.config_folder)
        up = Up(plan, context)
        up.initialize()
    except UserError as error:
        problems = list(error.problems)
        if application is not None:
            problems += _more_problems(application, reactor, config_folder, environ)
        print_problems(problems)
        return EXIT_CONFIG
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    return Program(up, environ).run()


def _more_problems(
    application: Application,
    reactor: Any,
    config_folder: Path | None,
    environ: Mapping[str, str],
) -> list[Problem]:
    """Return the result of ``up check``: the error that ended the boot hides later ones."""
    try:
        context = make_context(application, reactor, config_folder, environ)
    except ConfigErrors:
        words = {**environ, "UP_MODE": Mode.AUTO.value}
        context = make_context(application, reactor, config_folder, words)
    except BootError:
        # The folder or mode does not exist: there is nothing to check.
        return []
    return check_application(application, context).problems


def make_context(
    application: Application,
    reactor: Any,
    config_folder: Path | None,
    environ: Mapping[str, str] = os.environ,
) -> Context:
    """Return the context of a run; raises ConfigErrors, or BootError for an invalid UP_MODE."""
    folder = application.config_folder if config_folder is None else config_folder.resolve()
    if config_folder is not None and not folder.is_dir():
        text = f"--config {config_folder}: no such folder"
        raise BootError(text, "folder_missing", folder=config_folder)
    instance = environ.get("UP_INSTANCE", "")
    if instance and not AIRCRAFT_NAME.fullmatch(instance):
        text = f"UP_INSTANCE={instance!r}: must be {AIRCRAFT_NAME_RULE}"
        raise BootError(text, "instance_invalid", value=instance)
    context = Context(reactor, Mode.AUTO, folder, instance=instance)
    wanted = environ.get("UP_MODE") or context.application.mode
    try:
        context.mode = Mode(wanted.strip().lower())
    except ValueError:
        words = ", ".join(mode.value for mode in Mode)
        text = f"UP_MODE={wanted!r} is not a mode; the modes are: {words}"
        raise BootError(text, "mode_invalid", value=wanted) from None
    return context


def _start_log(context: Context) -> None:
    values = context.application
    json_path = Path(values.log_file) if values.log_file else None
    start_logging(values.log_level, sys.stderr, json_path)
