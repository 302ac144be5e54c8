"""An aircraft at the test's proxy, and a server for pages."""

import pytest

from tests.ground.aircraft import Aircraft
from tests.ground.web.page import Serve


@pytest.fixture
def aircraft(proxy):
    with Aircraft(proxy.airborne_port) as aircraft:
        yield aircraft


@pytest.fixture
def server(proxy, tmp_path):
    with Serve(tmp_path, proxy.ground_port) as server:
        yield server
