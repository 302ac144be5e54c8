"""docs/adapters.md: each adapter has what its row names; test_pages checks the links."""

import re

import pytest

from bench.__main__ import SUBJECTS
from tests.docs.test_pages import text_of
from tests.simulator.scenarios.shipped import SCENARIOS
from tests.support.virtual_environment import REPOSITORY

DOCS = REPOSITORY / "docs"
LINES = text_of(DOCS / "adapters.md").splitlines()
ROWS = [line.strip("| ").split(" | ") for line in LINES if line.startswith("| ")][1:]
PICTURE = re.compile(r"^!\[|^```\n +\w", re.MULTILINE)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_an_adapter_has_its_page_picture_session_figures_and_flight(row):
    _, session, _, _, figures, flights = row
    path, _, anchor = re.search(r"\((.+?)\)", session)[1].partition("#")
    text = text_of(DOCS / path)
    assert "First session" in text or anchor == "overlay-for-video"
    assert anchor or PICTURE.search(text), "a picture of the wiring"
    for subject in re.findall(r"`(.+?)`", figures):
        assert subject in SUBJECTS
    for flight in re.findall(r"`(.+?)`", flights):
        assert flight in SCENARIOS
    for cell in (figures, flights):
        assert "`" in cell or re.match(r"none: \w{2,} \w+", cell), "no reason"
