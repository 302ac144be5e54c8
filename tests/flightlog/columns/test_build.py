"""The columns of a flight: every number of its log, with unit, gaps and sources."""

import pytest

from tests.flightlog.flights import BOARD, PHONE, OrientationCommand
from tests.flightlog.logbook import eventful, write_flight
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.columns.build import TRACK, build_columns
from up_flightlog.columns.column_file import ColumnFile
from up_flightlog.read.flight_log import FlightLog


def made(folder, fill):
    log = FlightLog.read([write_flight(folder, 1, fill)])
    path = folder / "flight.columns"
    build_columns(log, path, [1, "state"])
    return log, ColumnFile(path), path


def test_columns_have_the_numbers_of_the_log(tmp_path):
    log, file, _ = made(tmp_path, eventful)
    columns = {each.name: each for each in file.columns}
    for topic, field, unit in (
        ("up.orientation.update", "roll", "deg"),
        ("up.altitude.change", "altitude", "m"),
        ("simulator.truth", "wind_east_m_s", ""),
    ):
        column = columns[f"{topic}.{field}"]
        times_s, values = log.series(topic, field)
        assert (list(column.times_s), list(column.values)) == (times_s, values)
        assert column.unit == unit
    east, north = (columns[name] for name in TRACK)
    assert (east.values[0], north.values[0]) == (0.0, 0.0)
    assert north.values[-1] == pytest.approx(19e-4 * 111_194.9, rel=1e-4)
    about = file.about
    assert (about["state"], about["aircraft"], about["armed_s"]) == ([1, "state"], "kite", 5.0)
    assert [each["name"] for each in about["bands"]] == ["FBW"]
    assert {"armed", "gains", "mark"} <= {each["code"] for each in about["events"]}


def test_two_sources_of_a_value_are_two_columns(tmp_path):
    def fill(maker):
        for tick in range(20):
            maker.put(tick / 10, OrientationCommand(1.0, 0, 0, 0, 0, 0), BOARD)
            maker.put(tick / 10 + 0.05, OrientationCommand(9.0, 0, 0), PHONE)

    _, file, _ = made(tmp_path, fill)
    found = {each.name: set(each.values) for each in file.columns if ".roll" in each.name}
    assert found["up.orientation.update.roll [arduino]"] == {1.0}
    assert found["up.orientation.update.roll [android]"] == {9.0}


def test_a_damaged_file_of_columns_is_refused(tmp_path):
    _, _, path = made(tmp_path, eventful)
    whole = path.read_bytes()
    for damaged in (
        b"",
        whole[:-8],
        whole[:100],
        b"x" + whole[1:],
        whole.replace(b'"gap_s"', b'"gap_x"'),
    ):
        path.write_bytes(damaged)
        with pytest.raises(FlightLogError) as caught:
            ColumnFile(path)
        assert caught.value.code in ("unreadable", "not_columns")
