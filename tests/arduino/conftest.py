"""Flights for the tests: a fresh one each, or one that a module shares."""

import pytest

from tests.arduino.flight import Flight


@pytest.fixture
def flight():
    """Return a freshly booted firmware with the switch at ACRO."""
    return Flight()


@pytest.fixture(scope="module")
def shared():
    """Return one that is ready to arm and that the tests of a module share."""
    flight = Flight()
    flight.run_ms(1500)
    return flight


@pytest.fixture(scope="module")
def shared_armed(shared):
    """Return the shared one, armed and reporting."""
    shared.arm()
    shared.send("s")
    return shared


@pytest.fixture
def fbw():
    """Return one with the switch at FBW."""
    return Flight(aux1=1500)
