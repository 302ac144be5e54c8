"""The program `up-proxy`."""

import resource
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from up.cli.server_parser import ServerParser
from up.log import UpLogger, start_logging
from up.output import program_error
from up.system.clock import use_monotonic_time
from up.system.gc_scheduler import GcScheduler
from up.system.notify import Notifier, WatchdogPinger
from up.system.pid_file import service
from up_proxy.config import PROXY, ProxyConfig
from up_proxy.listener import StartError

_SPARE_DESCRIPTORS = 64
FULL_COLLECTION_S = 24 * 3600.0
"""With thousands of aircraft one holds up all lines for tenths of a second, and finds little."""
_log = UpLogger.get_logger("proxy")


def raise_descriptor_limit(config: ProxyConfig) -> None:
    """Raise the descriptor limit to the number needed, as far as the system permits."""
    wanted = 2 * config.limits.connections + _SPARE_DESCRIPTORS
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft >= wanted or soft == resource.RLIM_INFINITY:
        return
    granted = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
    resource.setrlimit(resource.RLIMIT_NOFILE, (granted, hard))
    if granted < wanted:
        _log.warn(
            "{granted} open files are allowed, the configured limits need {wanted}",
            code="descriptor_limit",
            granted=granted,
            wanted=wanted,
        )


def run(reactor: Any, config: ProxyConfig, folder: Path = Path()) -> int:
    """Serve until SIGTERM, SIGINT or SIGHUP; return the exit status."""
    from up_proxy.proxy import Proxy

    # Before the ports are open: a program that sees them open may end this one.
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        # 'nohup' ignores SIGHUP; a shell's background job ignores SIGINT, which still ends it.
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda *_: reactor.callFromThread(reactor.stop))
    try:
        proxy = Proxy(reactor, config, folder)
        proxy.start()
    except StartError as error:
        sys.stderr.write(f"{program_error('up-proxy', str(error), error.code)}\n")
        return error.status
    notifier = Notifier.from_environment()
    pinger = WatchdogPinger(reactor, proxy.is_healthy, notifier)
    collector = GcScheduler(reactor, full_period_s=FULL_COLLECTION_S)

    def on_running() -> None:
        collector.start()
        ports = f"airborne {proxy.airborne_port}, ground {proxy.ground_port}"
        notifier.ready(f"relaying, {ports}")
        pinger.start()

    def on_stop() -> object:
        notifier.stopping()
        pinger.stop()
        return proxy.stop().addCallback(lambda _: _log.info("stopped", code="stopped"))

    reactor.callWhenRunning(on_running)
    reactor.addSystemEventTrigger("before", "shutdown", on_stop)
    reactor.run(installSignalHandlers=False)
    return 0


@service()
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status."""
    parser = ServerParser(
        PROXY,
        ("--airborne-port", "--ground-port", "--metrics-port"),
        prog="up-proxy",
        description="Relay between aircraft and ground stations: the Ground Station Proxy.",
    )
    _, folder, config = parser.load(arguments, Path("config"))
    start_logging(config.log_level, json_path=Path(config.log_file) if config.log_file else None)
    raise_descriptor_limit(config)
    from twisted.internet import reactor

    use_monotonic_time(reactor)
    return run(reactor, config, folder)


if __name__ == "__main__":
    sys.exit(main())
