"""Which flight a user means."""

import pytest

from tests.cogs.black_box_cog.logbook import START_UNIX_S, write_flight
from up.flight_log.flights import FlightNotFoundError, find_flight, find_flight_of


def found(named, folder):
    return [path.name for path in find_flight(str(named), lambda: folder).paths]


@pytest.fixture
def folder(tmp_path):
    for number in (3, 4):
        write_flight(tmp_path, number)
    write_flight(tmp_path, 4, part=2)
    write_flight(tmp_path, 4, part=10)
    return tmp_path


def test_numbers_last_files_and_folders(folder, tmp_path):
    three, four, second, tenth = (
        "0003-20260424T030640Z-kite.mcap",
        "0004-20260424T030640Z-kite.mcap",
        "0004-20260424T030640Z-kite.2.mcap",
        "0004-20260424T030640Z-kite.10.mcap",
    )
    assert found(3, folder) == found("0003", folder) == [three]
    assert found("last", folder) == found(4, folder) == [four, second, tenth]
    assert found(folder / four, tmp_path / "nowhere") == [four, second, tenth]
    assert found(folder / second, tmp_path / "nowhere") == [second]
    inner = tmp_path / "one"
    inner.mkdir()
    for name in (four, second):
        (folder / name).rename(inner / name)
    assert found(inner, folder) == [four, second]


def test_parts_with_names_of_their_own(tmp_path):
    for name in ("b.mcap", "a.mcap"):
        write_flight(tmp_path).rename(tmp_path / name)
    assert found(tmp_path, None) == ["a.mcap", "b.mcap"]
    assert found(tmp_path / "b.mcap", None) == ["b.mcap"]


def test_two_aircraft_with_one_number(tmp_path):
    for name in ("kite", "glider"):
        write_flight(tmp_path, 1, aircraft=name)
    with pytest.raises(
        FlightNotFoundError, match=r"2 flights have the number 1: name .*glider.* or .*kite"
    ):
        find_flight("1", lambda: tmp_path)
    write_flight(tmp_path, 1, start_unix_s=START_UNIX_S + 60)
    with pytest.raises(FlightNotFoundError, match="3 flights have the number 1"):
        find_flight("1", lambda: tmp_path)


@pytest.mark.parametrize(
    ("named", "sentence"),
    [
        ("9", "there is no flight 9 in {folder}: the newest is 4, the oldest 3"),
        ("lst", "lst: no such flight, did you mean 'last'?"),
        ("Last", "Last: no such flight, did you mean 'last'?"),
        ("x.mcap", "x.mcap: no such flight ('last', a number that 'up log list' tells, "),
        ("\x1b[2J", "\\x1b[2J: no such flight"),
        ("{folder}", "{folder} has 2 flights: say --folder {folder} and a number"),
        ("{folder}/empty", "no flight is in {folder}/empty: it has no file that ends in .mcap"),
    ],
)
def test_what_is_none_is_one_sentence(folder, named, sentence):
    (folder / "empty").mkdir()
    with pytest.raises(FlightNotFoundError) as caught:
        find_flight(named.replace("{folder}", str(folder)), lambda: folder)
    assert str(caught.value).startswith(sentence.replace("{folder}", str(folder)))


def test_where_nothing_was_recorded(tmp_path):
    with pytest.raises(
        FlightNotFoundError, match="no flight has been recorded: there is no folder"
    ):
        find_flight("last", lambda: tmp_path / "nowhere")
    with pytest.raises(FlightNotFoundError, match="no flight is in"):
        find_flight("1", lambda: tmp_path)
    write_flight(tmp_path, 2)
    with pytest.raises(FlightNotFoundError, match="it has 2 only"):
        find_flight("1", lambda: tmp_path)


def test_several_files_are_the_parts_of_one_flight(folder):
    names = [
        "0004-20260424T030640Z-kite.mcap",
        "0004-20260424T030640Z-kite.2.mcap",
        "0004-20260424T030640Z-kite.10.mcap",
    ]
    words = [str(folder / name) for name in (names[2], names[0], names[1])]
    assert [path.name for path in find_flight_of(words, lambda: folder).paths] == names
    assert find_flight_of(["3"], lambda: folder).number == 3
    (folder / names[2]).rename(folder / "a.mcap")
    words = [str(folder / name) for name in (names[0], "a.mcap")]
    assert [str(path) for path in find_flight_of(words, lambda: folder).paths] == words


def test_files_that_are_not_of_one_flight(folder):
    three, four = (str(folder / f"000{n}-20260424T030640Z-kite.mcap") for n in (3, 4))
    with pytest.raises(FlightNotFoundError, match="are of several flights: name one"):
        find_flight_of([three, four], lambda: folder)
    for other in (str(folder), "last", str(folder / "absent.mcap")):
        with pytest.raises(FlightNotFoundError, match="is no file: name one flight, or the files"):
            find_flight_of([three, other], lambda: folder)


@pytest.mark.parametrize("named", ["9" * 5000, "x\0y"])
def test_what_can_be_no_path_is_no_flight(folder, named):
    with pytest.raises(FlightNotFoundError, match="no such flight") as caught:
        find_flight(named, lambda: folder)
    assert len(str(caught.value)) < 500
