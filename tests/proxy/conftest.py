"""Fixtures of the proxy's tests."""

import pytest

from tests.proxy.virtual import Bench


@pytest.fixture
def bench():
    """Return a proxy in virtual time."""
    with Bench() as bench:
        yield bench
