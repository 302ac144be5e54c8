from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.flight_log.flight_file import FlightFile, flight_files
from up.flight_log.flights_folder import default_folder, folder_of

HERE = Path("flights")


@given(
    st.integers(1, 999_999_999),
    st.floats(0, 4e9),
    st.text(max_size=40),
    st.integers(1, 999_999),
)
def test_every_name_is_read_again(number, start_unix_s, aircraft, part):
    made = FlightFile.first(HERE, number, start_unix_s, aircraft).at_part(part)
    assert FlightFile.of(made.path) == made
    assert made.path.parent == HERE
    assert made.path.name.isascii()


def test_the_name_reads_like_this():
    made = FlightFile.first(HERE, 7, 1_786_699_800.4, "kite.2")
    assert made.path.name == "0007-20260814T093000Z-kite_2.mcap"
    assert made.at_part(2).path.name == "0007-20260814T093000Z-kite_2.2.mcap"


@pytest.mark.parametrize(
    "name",
    [
        "7-20260814T093000Z-kite.mcap",
        "0007-20260814-kite.mcap",
        "0007-20260814T093000Z-.mcap",
        "0007-20260814T093000Z-kite.1.mcap",
        "0007-20260814T093000Z-kite.02.mcap",
        "0007-20260814T093000Z-kite.mcap.bak",
        "0007-20260814T093000Z-kite.csv",
        " 0007-20260814T093000Z-kite.mcap",
        "\u0660\u0660\u0660\u0667-20260814T093000Z-kite.mcap",
        "notes.txt",
    ],
)
def test_other_names(name):
    assert FlightFile.of(HERE / name) is None


@given(st.text(max_size=60).filter(lambda text: "/" not in text and "\0" not in text))
def test_any_name_is_read_or_refused(name):
    found = FlightFile.of(HERE / f"{name}.mcap")
    assert found is None or found.path == HERE / f"{name}.mcap"


def test_files_are_listed_by_number_and_part(tmp_path):
    names = [
        "0010-20260101T000000Z-kite.mcap",
        "0009-20260814T093000Z-kite.10.mcap",
        "0009-20260814T093000Z-kite.2.mcap",
        "0009-20260814T093000Z-kite.mcap",
    ]
    for name in [*names, "readme.txt", "other.mcap"]:
        (tmp_path / name).touch()
    assert [each.path.name for each in flight_files(tmp_path)] == names[::-1]


def test_where_flights_are_kept_by_default(monkeypatch):
    assert default_folder({"STATE_DIRECTORY": "/var/lib/raspilot:/b"}) == Path(
        "/var/lib/raspilot/flights"
    )
    assert default_folder({"XDG_STATE_HOME": "/x"}) == Path("/x/raspilot/flights")
    monkeypatch.setenv("HOME", "/home/pilot")
    for environ in ({}, {"XDG_STATE_HOME": "relative"}, {"STATE_DIRECTORY": ""}):
        assert default_folder(environ) == Path("/home/pilot/.local/state/raspilot/flights")
    assert folder_of("~/flown", {}) == Path("/home/pilot/flown")
    assert folder_of("", {"XDG_STATE_HOME": "/x"}) == Path("/x/raspilot/flights")
