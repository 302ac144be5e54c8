"""The socket that receives the instances' notifications."""

import array
import os
import socket
import subprocess
import sys

from tests.support.reactor import reactor, run_in_reactor, until
from up.system.notify import Notifier
from up_runner.notification import Notification
from up_runner.notify_socket import NotifySocket


def count_descriptors():
    return len(os.listdir("/proc/self/fd"))  # noqa: PTH208


def test_it_knows_who_speaks(short_path):
    async def body():
        heard = []
        ear = NotifySocket(reactor, short_path / "notify", lambda *said: heard.append(said))
        ear.open()
        Notifier(str(ear.path)).ready("runs")
        await until(lambda: heard)
        assert heard == [(os.getpid(), Notification(ready=True, status="runs"))]
        code = "from up.system.notify import Notifier; import sys; Notifier(sys.argv[1]).watchdog()"
        with subprocess.Popen([sys.executable, "-c", code, str(ear.path)]) as child:
            await until(lambda: len(heard) == 2)
        assert heard[1] == (child.pid, Notification(alive=True))
        ear.close(remove=True)
        assert not ear.path.exists()

    run_in_reactor(body)


def test_the_next_runners_socket_takes_over_at_the_same_path(short_path):
    async def body():
        heard = []
        first = NotifySocket(reactor, short_path / "notify", lambda *said: heard.append(1))
        first.open()
        first.close(remove=False)
        assert first.path.exists()
        assert Notifier(str(first.path)).ready() is False
        second = NotifySocket(reactor, short_path / "notify", lambda *said: heard.append(2))
        second.open()
        assert Notifier(str(second.path)).ready() is True
        await until(lambda: heard)
        assert heard == [2]
        second.close(remove=True)

    run_in_reactor(body)


def test_drained_it_hears_at_once(short_path):
    async def body():
        heard = []
        ear = NotifySocket(reactor, short_path / "notify", lambda *said: heard.append(said))
        ear.open()
        notifier = Notifier(str(ear.path))
        for _ in range(5):
            notifier.watchdog()
        ear.drain()
        assert len(heard) == 5
        ear.close(remove=True)
        ear.drain()

    run_in_reactor(body)


def test_descriptors_that_somebody_sends_do_not_stay(short_path):
    async def body():
        heard = []
        ear = NotifySocket(reactor, short_path / "notify", lambda *said: heard.append(said))
        ear.open()
        before = count_descriptors()
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as line:
            for _ in range(20):
                line.sendmsg(
                    [b"WATCHDOG=1"],
                    [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", [0, 1, 2]))],
                    0,
                    str(ear.path),
                )
                ear.drain()
        assert count_descriptors() == before
        assert len(heard) + ear.dropped == 20
        ear.close(remove=True)

    run_in_reactor(body)


def test_a_datagram_that_is_too_long_is_dropped_and_counted(short_path):
    async def body():
        heard = []
        ear = NotifySocket(reactor, short_path / "notify", lambda *said: heard.append(said))
        ear.open()
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as line:
            line.sendto(b"READY=1\n" + b"x" * 10_000, str(ear.path))
        ear.drain()
        assert (heard, ear.dropped) == ([], 1)
        ear.close(remove=True)

    run_in_reactor(body)
