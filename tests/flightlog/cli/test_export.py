import csv
from xml.etree import ElementTree

import gpxpy
import pytest

from tests.flightlog.logbook import EVIL, START_UNIX_S, eventful, write_flight
from up.commands.location_command import LocationCommand


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_track_as_gpx(log, flights, tmp_path):
    name = write_flight(flights, 1, eventful, aircraft="</name><b>&").stem
    outcome = log("export", "last", "--format", "gpx")
    assert outcome.status == 0 and outcome.out.startswith(f"{name}.gpx ")
    track = gpxpy.parse((tmp_path / f"{name}.gpx").read_text())
    assert track.tracks[0].name == "</name><b>& flight 1"
    (segment,) = track.tracks[0].segments
    assert len(segment.points) == 20
    assert segment.points[3].latitude == pytest.approx(50.0003)
    assert segment.points[3].time.timestamp() == pytest.approx(START_UNIX_S + 3)
    assert [place.name for place in track.waypoints] == ["home", f"look {EVIL}"]
    assert track.waypoints[1].latitude == pytest.approx(50.0009)


def test_the_track_as_kml(log, flights, tmp_path):
    write_flight(flights, 1)
    log("export", 1, "--format", "kml", "-o", "x.kml")
    root = ElementTree.parse(tmp_path / "x.kml").getroot()
    assert len(list(root.iter("{http://www.google.com/kml/ext/2.2}coord"))) == 20


def test_positions_from_telemetry(log, flights, tmp_path):
    def fill(maker):
        for number in range(5):
            place = {"latitude": 50 + number // 2 / 1000, "longitude": 14.0, "altitude": 300}
            maker.add(number, "up.telemetry.update", location=place)
        maker.add(5, "up.telemetry.update", location={"latitude": None, "longitude": None})

    write_flight(flights, 1, fill)
    log("export", 1, "--format", "gpx", "-o", "a.gpx")
    points = gpxpy.parse((tmp_path / "a.gpx").read_text()).tracks[0].segments[0].points
    assert [point.latitude for point in points] == [50.0, 50.001, 50.002]


def test_a_gap_splits_the_track(log, flights, tmp_path):
    def fill(maker):
        for time_s in (0, 1, 20, 21):
            maker.put(time_s, LocationCommand(50 + time_s / 1e4, 14.0))

    write_flight(flights, 1, fill)
    log("export", 1, "--format", "gpx", "-o", "a.gpx")
    track = gpxpy.parse((tmp_path / "a.gpx").read_text()).tracks[0]
    assert [len(segment.points) for segment in track.segments] == [2, 2]


def test_a_topic_as_a_table(log, flights, tmp_path):
    write_flight(flights, 1)
    log("export", 1, "--format", "csv", "--topic", "up.rx.update", "-o", "rx.csv")
    found = rows(tmp_path / "rx.csv")
    assert len(found) == 200
    assert found[5]["ailerons"] == "1500" and found[5]["_origin"] == "arduino (board)"
    assert float(found[5]["time_s"]) == pytest.approx(0.5)
    assert found[5]["time"] == "2026-04-24T03:06:40.500Z"


def test_several_topics_are_a_folder(log, flights, tmp_path):
    write_flight(flights, 1)
    topics = ("up.rx.update", "up.altitude.change", "up.rx.update")
    named = [word for topic in topics for word in ("--topic", topic)]
    log("export", 1, "--format", "csv", *named, "-o", "tables")
    names = sorted(path.name for path in (tmp_path / "tables").iterdir())
    assert names == ["up.altitude.change.csv", "up.rx.update.csv"]
    outcome = log("export", 1, "--format", "csv", *named, "-o", "-")
    assert outcome.status == 2 and "-o" in outcome.err


def test_all_topics_at_one_rate(log, flights, tmp_path):
    write_flight(flights, 1)
    log("export", 1, "--format", "csv", "--rate", "5", "-o", "all.csv")
    found = rows(tmp_path / "all.csv")
    assert len(found) == 100
    row = found[52]
    assert float(row["time_s"]) == pytest.approx(10.4)
    assert row["up.altitude.change.altitude"] == "310.0"
    assert float(row["up.altitude.change.age_s"]) == pytest.approx(0.4)
    assert row["up.flight.state.armed"] == "true"
    log("export", 1, "--format", "csv", "--rate", "1", "--topic", "up.rx.update", "-o", "b.csv")
    assert list(rows(tmp_path / "b.csv")[0])[2] == "up.rx.update.ailerons"


def test_a_topic_is_not_a_path(log, flights, tmp_path):
    topics = ("../../evil", "/etc/x", "..", "a\x00b")
    write_flight(flights, 1, lambda maker: [maker.add(0, topic, x=1) for topic in topics])
    named = [word for topic in topics[:3] for word in ("--topic", topic)]
    assert log("export", 1, "--format", "csv", *named, "-o", "tables").status == 0
    names = sorted(path.name for path in (tmp_path / "tables").iterdir())
    assert names == ["etc_x.csv", "evil.csv", "topic.csv"]


def test_an_existing_file_is_kept_without_force(log, flights, tmp_path):
    write_flight(flights, 1)
    (tmp_path / "a.gpx").write_text("mine")
    outcome = log("export", 1, "--format", "gpx", "-o", "a.gpx")
    assert outcome.status == 1
    assert "a.gpx" in outcome.err and "--force" in outcome.err
    assert (tmp_path / "a.gpx").read_text() == "mine"
    assert log("export", 1, "--format", "gpx", "-o", "a.gpx", "--force").status == 0
    assert (tmp_path / "a.gpx").read_text().startswith("<?xml")


def test_to_stdout(log, flights):
    write_flight(flights, 1)
    out = log("export", 1, "--format", "gpx", "-o", "-").out
    assert len(gpxpy.parse(out).tracks) == 1


@pytest.mark.parametrize(
    ("options", "status", "named"),
    [
        ("--format gpx --topic x", 2, "gpx"),
        ("--format csv --topic up.rx.updat", 2, "did you mean up.rx.update?"),
        ("--format csv --topic zzz", 2, "up.location.update"),
        ("--format csv --rate 0", 2, "'0'"),
        ("--format csv --rate nan", 2, "'nan'"),
        ("--format xls", 2, "'xls'"),
        ("--format gpx -o file/", 1, "file"),
        ("--format gpx -o nowhere/x.gpx", 1, "nowhere"),
        ("--format csv --topic up.rx.update --topic up.location.update -o nowhere/x", 1, ""),
    ],
)
def test_wrong_options(log, flights, tmp_path, options, status, named):
    write_flight(flights, 1)
    (tmp_path / "file").write_text("a file")
    outcome = log("export", 1, *options.split())
    assert outcome.status == status and named in outcome.err
    assert status == 2 or len(outcome.err.splitlines()) == 1
    assert not (tmp_path / "nowhere").exists()


def test_flights_that_cannot_be_exported(log, flights):
    write_flight(flights, 1, lambda maker: maker.add(0, "a", x=1))
    write_flight(flights, 2, lambda maker: None)
    write_flight(flights, 3, lambda maker: [maker.add(time_s, "a", x=1) for time_s in (0, 1e9)])
    for number, form in ((1, "gpx"), (2, "csv"), (3, "csv")):
        outcome = log("export", number, "--format", form)
        assert (outcome.status, outcome.out, outcome.err.count("\n")) == (1, "", 1)


def test_a_wrong_clock_is_a_warning(log, flights):
    write_flight(flights, 1, start_unix_s=60)
    outcome = log("export", 1, "--format", "gpx")
    assert outcome.status == 0 and outcome.err
