"""Flights for the tests: a fresh one each, or one that a module shares."""

import pytest

from tests.arduino.flight import Flight


@pytest.fixture
def flight():
    """Return a freshly booted firmware with the switch at ACRO."""
    return Flight()


@pytest.fixture
def fbw():
    """Return one with the switch at FBW."""
    return Flight(aux1=1500)
