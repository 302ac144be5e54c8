"""A proxy for the tests of a file, and an aircraft of its own name for each test."""

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


@pytest.fixture
def owner(proxy):
    """Another ground, which has control."""
    with Client(proxy.ground_port, f"UP1 aircraft={aircraft.NAME} seat=command\n") as client:
        client.expect("seat=command")
        yield client


@pytest.fixture
def listener(proxy):
    """Another ground, without control."""
    with Client(proxy.ground_port, f"UP1 aircraft={aircraft.NAME} seat=listen\n") as client:
        client.expect("seat=listen")
        yield client
