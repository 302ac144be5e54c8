"""Which files a flight is."""

import argparse

import pytest

from up.cli.cli_error import CliError
from up_ground.replay.flights import FlightNotFoundError, find_flight, flights_folder
from up_ground.replay.verb import add

NAMES = (
    "0001-20261121T100000Z-kite.mcap",
    "0002-20261121T110000Z-kite.mcap",
    "0002-20261121T110000Z-kite.2.mcap",
    "0002-20261121T110000Z-kite.10.mcap",
    "notes.txt",
)


@pytest.fixture
def folder(tmp_path):
    for name in NAMES:
        (tmp_path / name).write_bytes(b"")
    return tmp_path


def names(paths):
    return [path.name for path in paths]


def test_the_parts_of_a_flight_are_taken_in_order(folder):
    parts = [NAMES[1], NAMES[2], NAMES[3]]
    for words in (["last"], ["2"], ["0002"], [str(folder)], [str(folder / NAMES[2])]):
        assert names(find_flight(words, folder)) == parts
    assert names(find_flight(["1"], folder)) == [NAMES[0]]
    files = [str(folder / name) for name in reversed(parts)]
    assert names(find_flight(files, folder)) == parts


@pytest.mark.parametrize("words", [["7"], ["nothing.mcap"], ["nothing/here"]])
def test_what_is_not_there_is_a_sentence(folder, words):
    with pytest.raises(FlightNotFoundError, match="there is no"):
        find_flight(words, folder)


def test_no_flights_at_all(tmp_path):
    with pytest.raises(FlightNotFoundError, match="there is no flight in"):
        find_flight(["last"], tmp_path)
    with pytest.raises(FlightNotFoundError, match="cannot be read"):
        find_flight(["last"], tmp_path / "absent")


def test_where_flights_are():
    assert str(flights_folder({"STATE_DIRECTORY": "/var/lib/up"})) == "/var/lib/up/flights"
    assert str(flights_folder({"XDG_STATE_HOME": "/s"})) == "/s/raspilot/flights"


def test_it_is_a_verb_of_up_log_too():
    verbs = argparse.ArgumentParser().add_subparsers()
    add(verbs)
    (parser,) = verbs.choices.values()
    options = parser.parse_args(["last", "--listen", "127.0.0.1:0", "--folder", "/nowhere/at/all"])
    with pytest.raises(CliError, match="/nowhere/at/all cannot be read"):
        options.carry_out(options)
