import pytest

from tests.flightlog.logbook import START_UNIX_S, write_flight
from up_flightlog.read.flights import FlightNotFoundError, find_flight, find_flight_of

THREE, FOUR, SECOND, TENTH = (
    "0003-20260424T030640Z-kite.mcap",
    "0004-20260424T030640Z-kite.mcap",
    "0004-20260424T030640Z-kite.2.mcap",
    "0004-20260424T030640Z-kite.10.mcap",
)


def found(name, folder):
    return [path.name for path in find_flight(str(name), lambda: folder).paths]


def error_of(names, folder):
    with pytest.raises(FlightNotFoundError) as caught:
        find_flight_of([str(name) for name in names], lambda: folder)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 500
    return caught.value


@pytest.fixture
def folder(tmp_path):
    for number in (3, 4):
        write_flight(tmp_path, number)
    write_flight(tmp_path, 4, part=2)
    write_flight(tmp_path, 4, part=10)
    return tmp_path


def test_numbers_last_files_and_folders(folder, tmp_path):
    assert found(3, folder) == found("0003", folder) == [THREE]
    assert found("last", folder) == found(4, folder) == [FOUR, SECOND, TENTH]
    assert found(folder / FOUR, tmp_path / "nowhere") == [FOUR, SECOND, TENTH]
    assert found(folder / SECOND, tmp_path / "nowhere") == [SECOND]
    inner = tmp_path / "one"
    inner.mkdir()
    for name in (FOUR, SECOND):
        (folder / name).rename(inner / name)
    assert found(inner, folder) == [FOUR, SECOND]


def test_renamed_parts(tmp_path):
    for name in ("b.mcap", "a.mcap"):
        write_flight(tmp_path).rename(tmp_path / name)
    assert found(tmp_path, None) == ["a.mcap", "b.mcap"]
    assert found(tmp_path / "b.mcap", None) == ["b.mcap"]


def test_several_flights_with_one_number(tmp_path):
    for name in ("kite", "glider"):
        write_flight(tmp_path, 1, aircraft=name)
    write_flight(tmp_path, 1, start_unix_s=START_UNIX_S + 60)
    error = error_of([1], tmp_path)
    assert error.code == "several_flights"
    assert "glider" in str(error) and "kite" in str(error)


@pytest.mark.parametrize(
    ("name", "code", "text"),
    [
        ("9", "no_such_flight", "newest is 4, the oldest 3"),
        ("lst", "no_such_flight", "did you mean 'last'?"),
        ("Last", "no_such_flight", "did you mean 'last'?"),
        ("x.mcap", "no_such_flight", "up log list"),
        ("\x1b[2J", "no_such_flight", "\\x1b[2J"),
        ("9" * 5000, "no_such_flight", ""),
        ("x\0y", "no_such_flight", ""),
        ("{folder}", "several_flights", "--folder"),
        ("{folder}/empty", "no_flights", ".mcap"),
    ],
)
def test_a_name_without_a_flight(folder, name, code, text):
    (folder / "empty").mkdir()
    error = error_of([name.replace("{folder}", str(folder))], folder)
    assert error.code == code
    assert text in str(error)


def test_a_folder_without_flights(tmp_path):
    assert error_of(["last"], tmp_path / "nowhere").code == "no_folder"
    assert error_of([1], tmp_path).code == "no_flights"
    write_flight(tmp_path, 2)
    assert error_of([1], tmp_path).code == "no_such_flight"


def test_several_files_are_the_parts_of_one_flight(folder):
    names = [FOUR, SECOND, TENTH]
    words = [str(folder / name) for name in (TENTH, FOUR, SECOND)]
    assert [path.name for path in find_flight_of(words, lambda: folder).paths] == names
    (folder / TENTH).rename(folder / "a.mcap")
    words = [str(folder / name) for name in (FOUR, "a.mcap")]
    assert [str(path) for path in find_flight_of(words, lambda: folder).paths] == words


def test_files_of_several_flights(folder):
    assert error_of([folder / THREE, folder / FOUR], folder).code == "several_flights"
    for other in (folder, "last", folder / "absent.mcap"):
        assert error_of([folder / THREE, other], folder).code == "not_a_file"
