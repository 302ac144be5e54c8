import pytest

from tests.cogs.black_box_cog.flights import Flight


@pytest.fixture(autouse=True)
def nobody_listens():
    """A test's recorder must not receive the log of the next test."""
    yield
    Flight.stop_all()
