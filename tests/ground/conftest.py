"""A proxy of one's own for every test."""

import pytest

from tests.proxy.program import Program


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path / "proxy", "metrics: false\n") as program:
        yield program
