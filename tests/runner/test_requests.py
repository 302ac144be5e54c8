"""The request port under good, bad and hostile askers; real sockets and a real runner."""

import random
import socket
import threading
from pathlib import Path

import pytest

from tests.runner.runners import wait_until


def memory_kb(pid):
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1])
    raise AssertionError("no memory known")


def test_a_malformed_line_is_answered_and_the_connection_stays(runner):
    talk = runner.talk()
    for line in (b"{}}\n", b"{\xff}\n", b"{" + b"[" * 10_000 + b"\n", b'{"aircraft": 1}\n'):
        answer = talk.ask(line)
        assert answer["error"] and answer["running"] is False and answer["instance"] is None
    # No longer a legacy client, whatever it sends.
    assert talk.ask(b"hello\n")["code"] == "malformed_request"
    assert talk.ask({"action": "status"})["error"] is None
    assert runner.instances() == []


def test_a_line_that_is_too_long_is_answered_and_ended(runner):
    talk = runner.talk()
    sender = threading.Thread(target=flood, args=(talk.socket, b'{"a": "', b"x" * 65536))
    sender.start()
    assert talk.hear()["code"] == "too_long"
    sender.join()
    assert talk.ended()


def flood(line, head, chunk, total=2**30):
    try:
        line.sendall(head)
        for _ in range(total // len(chunk)):
            line.sendall(chunk)
    except OSError:
        pass


def test_a_gigabyte_without_a_line_feed_costs_no_memory(runners):
    runner = runners(connections={"idle": 2}).start()
    before_kb = memory_kb(runner.process.pid)
    for head in (b"{", b"x"):
        # A legacy client that never reads is not read either, and dropped when it is silent.
        flood(runner.talk().socket, head, b"x" * 65536)
    assert memory_kb(runner.process.pid) - before_kb < 10_000
    assert runner.ask(action="status")["error"] is None


def test_thousands_of_pipelined_requests_are_answered_in_order(runner):
    talk = runner.talk()
    lines = [b'{"action": "status", "aircraft": "p%d"}\r\n\n' % n for n in range(3000)]
    talk.say(b"".join(lines))
    for number in range(3000):
        assert talk.hear()["instance"] == f"p{number}"
    # An empty line after a request does not make a legacy client.
    assert runner.instances() == []


def test_a_client_that_ends_its_output_still_gets_the_response(runner):
    for line in (b'{"aircraft": "a"}\n', b'{"aircraft": "a"}', b"spawn\n"):
        talk = runner.talk()
        talk.say(line)
        talk.socket.shutdown(socket.SHUT_WR)
        assert talk.hear()["running"] is True
        assert talk.ended()


def test_a_thousand_idle_sockets_do_not_block_others(runners):
    runner = runners(connections={"limit": 50, "address limit": 40, "idle": 600}).start()
    idle = [runner.talk(source=f"127.0.0.{2 + number % 50}") for number in range(1000)]
    assert runner.ask(action="status")["error"] is None
    assert runner.spawn()["spawned"] is True
    for each in idle:
        each.close()


def test_a_client_that_waits_for_its_response_is_not_displaced(runners):
    runner = runners(connections={"limit": 1, "idle": 600}).start()
    gate = runner.close_gate()
    waiting = runner.talk()
    waiting.say({"aircraft": "glider-1"})
    wait_until(runner.instances, "it starts")
    with pytest.raises((AssertionError, ConnectionResetError)):
        runner.talk().ask({"action": "status"})
    gate.touch()
    assert waiting.hear()["spawned"] is True


def test_garbage_of_every_kind_breaks_nothing(runners):
    limits = {"limit": 1000, "address limit": 1000, "idle": 600}
    runner = runners(instances=1, connections=limits).start()
    runner.spawn("default")
    descriptors = Path(f"/proc/{runner.process.pid}/fd")
    before = len(list(descriptors.iterdir()))
    chance = random.Random(4)
    for _ in range(300):
        with socket.create_connection(("127.0.0.1", runner.port)) as line:
            data = chance.randbytes(chance.randrange(1, 2000))
            line.sendall(chance.choice([data, b"{" + data + b"\n", b'{"aircraft":"' + data]))
            if chance.random() < 0.5:
                # Gone with a reset, in the middle.
                line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\x01\0\0\0\0\0\0\0")
    assert runner.status("default")["running"] is True
    wait_until(lambda: len(list(descriptors.iterdir())) <= before, "no connection stays")
    assert "Traceback" not in runner.printed
    assert "runner_bug" not in [fields.get("code") for fields in runner.events()]
