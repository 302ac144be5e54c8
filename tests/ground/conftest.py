"""A proxy for the tests of a file, and an aircraft of its own name for each test."""

import contextlib
import threading
from itertools import count

import pytest

from tests.ground import aircraft
from tests.proxy.program import Client, Program

_NUMBERS = count(1)


@pytest.fixture(scope="module")
def shared_proxy(tmp_path_factory):
    with Program(tmp_path_factory.mktemp("proxy"), "metrics: false\n") as program:
        yield program


@pytest.fixture
def proxy(shared_proxy, monkeypatch):
    monkeypatch.setattr(aircraft, "NAME", f"kite-{next(_NUMBERS)}")
    return shared_proxy


@contextlib.contextmanager
def another_ground(port, access):
    """Connect another ground, which sends a heartbeat each second however long the test takes."""
    ended = threading.Event()

    def beat():
        with contextlib.suppress(OSError):
            while not ended.wait(1):
                client.say("\n")

    with Client(port, f"UP1 aircraft={aircraft.NAME} seat={access}\n") as client:
        client.expect(f"seat={access}")
        thread = threading.Thread(target=beat, daemon=True)
        thread.start()
        yield client
        ended.set()
        thread.join()


@pytest.fixture
def owner(proxy):
    with another_ground(proxy.ground_port, "command") as client:
        yield client


@pytest.fixture
def listener(proxy):
    with another_ground(proxy.ground_port, "listen") as client:
        yield client
