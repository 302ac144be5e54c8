"""What holds for the tests of the recorder."""

import pytest

from tests.cogs.black_box_cog.flights import Flight


@pytest.fixture(autouse=True)
def nobody_listens():
    """No recorder of a test hears the log of the next."""
    yield
    Flight.stop_all()
