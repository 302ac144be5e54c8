"""Real processes, held by descriptors."""

import os
import signal
import socket
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests.support.reactor import reactor, until
from up_runner.process import (
    Identity,
    Process,
    ProcessGone,
    boot_id,
    describe_status,
    identity_of,
    listening_ports,
    sessions_with,
)

SLEEP = "import time; time.sleep(3600)"


def spawn(code, log=None, **environ):
    descriptor = os.open(log or os.devnull, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    try:
        process = Process.spawn(
            reactor,
            [sys.executable, "-c", code],
            cwd=Path.cwd(),
            environ=dict(os.environ, **environ),
            log=descriptor,
        )
    finally:
        os.close(descriptor)
    ends = []
    process.on_end = ends.append
    return process, ends


def gone(pid):
    try:
        identity_of(pid)
    except ProcessGone:
        return True
    return False


@pytest.mark.parametrize(
    ("code", "status"),
    [("raise SystemExit(3)", 3), ("pass", 0), ("import os; os.abort()", -signal.SIGABRT)],
)
async def test_the_exit_status_of_a_child_is_reported_once(code, status):
    process, ends = spawn(code)
    await until(lambda: ends)
    assert ends == [status] and process.fileno() == -1


async def test_terminate_asks_and_kill_does_not():
    first, first_ends = spawn(SLEEP)
    first.terminate()
    second, second_ends = spawn(SLEEP)
    second.kill()
    await until(lambda: first_ends and second_ends)
    assert (first_ends, second_ends) == ([-signal.SIGTERM], [-signal.SIGKILL])
    # It has ended: the process that has the number now is left alone.
    first.terminate()
    second.kill()


async def test_processes_of_a_child_end_with_it(tmp_path):
    helper = (
        "import subprocess, sys;"
        f"print(subprocess.Popen([sys.executable, '-c', '{SLEEP}']).pid, flush=True)"
    )
    _, ends = spawn(helper, tmp_path / "log")
    await until(lambda: ends)
    pid = int((tmp_path / "log").read_text())
    await until(lambda: gone(pid))


async def test_an_adopted_process_is_watched_without_its_status():
    child = subprocess.Popen([sys.executable, "-c", SLEEP])
    with child:
        process = Process.adopt(reactor, identity_of(child.pid))
        ends = []
        process.on_end = ends.append
        process.terminate()
        await until(lambda: ends)
        assert ends == [None]


async def test_a_closed_one_is_left_alone():
    process, ends = spawn(SLEEP)
    process.close()
    process.close()
    process.kill()
    process.terminate()
    assert not gone(process.pid) and ends == []
    os.kill(process.pid, signal.SIGKILL)
    os.waitpid(process.pid, 0)
    process._child.returncode = 0


async def test_another_process_of_the_same_number_is_not_adopted():
    me = identity_of(os.getpid())
    for other in (replace(me, start_ticks=me.start_ticks + 1), replace(me, boot_id="another")):
        with pytest.raises(ProcessGone):
            Process.adopt(reactor, other)
    with pytest.raises(ProcessGone):
        Process.adopt(reactor, Identity(2**22 + 1, 1, boot_id()))


def test_a_zombie_is_gone():
    child = subprocess.Popen([sys.executable, "-c", "pass"])
    with child:
        os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
        assert gone(child.pid)


def test_names_with_parentheses_do_not_hide_the_start():
    code = (
        "import ctypes, sys; ctypes.CDLL(None).prctl(15, b'a) R (b', 0, 0, 0);"
        "print('named', flush=True); sys.stdin.read()"
    )
    before = identity_of(os.getpid())
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        assert child.stdout.readline() == b"named\n"
        assert identity_of(child.pid).start_ticks >= before.start_ticks
        child.stdin.close()


async def test_session_leaders_are_found_by_their_environment(short_path):
    process, ends = spawn(SLEEP, NOTIFY_SOCKET=f"{short_path}/a/notify")
    found = await until(lambda: list(sessions_with("NOTIFY_SOCKET", f"{short_path}/")))
    assert found == [(process.pid, f"{short_path}/a/notify")]
    assert list(sessions_with("NOTIFY_SOCKET", f"{short_path}/b")) == []
    process.kill()
    await until(lambda: ends)


def test_a_program_that_is_not_there_is_an_os_error():
    with pytest.raises(FileNotFoundError):
        Process.spawn(reactor, ["/nowhere"], cwd=Path.cwd(), environ={}, log=2)


def test_ends_in_words():
    assert describe_status(3).endswith(" 3")
    assert describe_status(-9).endswith(" SIGKILL")
    assert describe_status(-63).endswith(" 63")
    assert describe_status(None)


def test_listeners_and_bound_datagram_sockets_count_connections_do_not():
    with (
        socket.create_server(("127.0.0.1", 0)) as tcp,
        socket.create_server(("::1", 0), family=socket.AF_INET6) as tcp6,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp,
        socket.socket() as bound,
    ):
        udp.bind(("127.0.0.1", 0))
        bound.bind(("127.0.0.1", 0))
        ports = [each.getsockname()[1] for each in (tcp, tcp6, udp)]
        with socket.create_connection(("127.0.0.1", ports[0])) as connection:
            found = listening_ports(os.getpid())
            assert set(ports) <= found
            assert connection.getsockname()[1] not in found
            assert bound.getsockname()[1] not in found
    assert not set(ports) & listening_ports(os.getpid())


def test_another_process_has_its_own():
    with socket.create_server(("127.0.0.1", 0)) as server:
        assert server.getsockname()[1] not in (listening_ports(1) or ())


def test_the_ports_of_a_missing_process_are_unknown():
    assert listening_ports(2**22 + 1) is None
