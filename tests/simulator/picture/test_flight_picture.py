"""The picture of a flight: its content, that it is reproducible, and missing data."""

import builtins
import re
import sys

import pytest

from tests.simulator.picture.flights import COLUMNS, made_up
from up_simulator.picture.flight_picture import Failure, Mark, PictureError, Wind, draw_flight
from up_simulator.scenario.log import FlightLog

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(scope="module")
def flight():
    return made_up(20.0)


@pytest.fixture(scope="module")
def plain(flight, tmp_path_factory):
    """The picture of the flight, drawn once."""
    return svg(flight, tmp_path_factory.mktemp("plain"), title="A title", subtitle="a subtitle")


def svg(log, tmp_path, **options):
    """Return the picture as SVG in which words are words."""
    path = tmp_path / "flight.svg"
    draw_flight(log, path, **options)
    return path.read_text(encoding="utf-8")


def words(text):
    """Return the texts of a picture: matplotlib notes each text beside its outlines."""
    return "\n".join(re.findall(r"<!-- (.*?) -->", text))


def test_the_same_flight_gives_the_same_bytes(flight, tmp_path):
    pictures = []
    for name in ("a.svg", "b.svg", "c.png"):
        draw_flight(flight, tmp_path / name, title="twice", wind=Wind(4, 90))
        pictures.append((tmp_path / name).read_bytes())
    assert pictures[0] == pictures[1]
    assert b"<dc:date>" not in pictures[0]
    assert pictures[2].startswith(PNG) and b"tEXt" not in pictures[2]


def test_all_that_the_log_tells_is_on_it(plain):
    written = words(plain)
    for each in ("A title", "a subtitle", "Roll", "Pitch", "Roll rate", "Sticks", "Servo pulses"):
        assert each in written
    for each in ("Height and airspeed", "Load factor", "Track from above", "start", "end"):
        assert each in written
    for each in ("ACRO", "RATE", "FBW", "gust from the left", "phone unplugged"):
        assert each in written
    assert "deg rms" in written


def test_panels_without_data_are_left_out(tmp_path):
    log = FlightLog(["time_s", "truth.roll_deg", "truth.pitch_deg", "demand.roll_deg"])
    for row in range(50):
        log.append({"time_s": row * 0.02, "truth.roll_deg": row})
    written = words(svg(log, tmp_path))
    assert "Roll" in written
    for missing in ("Pitch", "Sticks", "Servo pulses", "Load factor", "estimate", "demand"):
        assert missing not in written
    assert "Track" not in written


def test_marks_given_take_the_place_of_the_events(flight, tmp_path):
    written = words(svg(flight, tmp_path, marks=[Mark(3, "IMU unplugged", is_fault=True)]))
    assert "IMU unplugged" in written
    assert "phone unplugged" not in written


def test_a_failed_expectation_is_shaded_on_its_signal(flight, plain, tmp_path):
    one = svg(flight, tmp_path, failures=[Failure("error.roll_deg", 5, 9, "roll: 8 deg, not 3")])
    homeless = Failure("ground.age_s", 5, 9, "telemetry: 5 s, not 1")
    everywhere = svg(flight, tmp_path, failures=[homeless])
    assert "roll: 8 deg, not 3" in words(one)
    shaded = [text.count("fill: url(#") for text in (plain, one, everywhere)]
    assert shaded[0] == 0
    assert shaded[1] == 1
    panels = 7
    assert shaded[2] == panels


def test_a_crash_is_marked_and_named(tmp_path):
    log = made_up(60.0, crashes=True)
    assert log.numbers("truth.crashed")[-1] == 1
    written = words(svg(log, tmp_path))
    assert "crash" in written
    assert "crashed at" in written
    assert "end" not in written.split("\n")


def test_wind_is_drawn_where_it_blows(flight, plain, tmp_path):
    assert "wind 5 m/s" in words(svg(flight, tmp_path, wind=Wind(5, 240)))
    assert "wind" not in words(plain)


def test_a_long_flight_keeps_its_peaks_and_stays_small(tmp_path):
    log = FlightLog(["time_s", "truth.roll_deg"])
    for row in range(60_000):
        log.append({"time_s": row * 0.02, "truth.roll_deg": 80.0 if row == 31_234 else 0.0})
    path = tmp_path / "long.svg"
    draw_flight(log, path)
    assert path.stat().st_size < 1_000_000
    assert "bank 0 to 80 deg" in words(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", ["flight.jpg", "flight", "flight.pdf"])
def test_another_ending_is_refused(flight, tmp_path, name):
    with pytest.raises(PictureError) as raised:
        draw_flight(flight, tmp_path / name)
    assert raised.value.code == "unknown_format"


def test_an_unwritable_path_is_refused(flight, tmp_path):
    with pytest.raises(PictureError) as raised:
        draw_flight(flight, tmp_path / "nowhere" / "flight.png")
    assert raised.value.code == "not_writable" and "\n" not in str(raised.value)


def test_a_log_with_nothing_to_draw_is_refused(tmp_path):
    empty = FlightLog(COLUMNS)
    with pytest.raises(PictureError) as raised:
        draw_flight(empty, tmp_path / "flight.png")
    assert raised.value.code == "too_short"
    other = FlightLog(["time_s", "board.loop_us"])
    for row in range(3):
        other.append({"time_s": row, "board.loop_us": 2000})
    with pytest.raises(PictureError) as raised:
        draw_flight(other, tmp_path / "flight.png")
    assert raised.value.code == "no_signal"


def test_without_matplotlib_the_error_names_the_package(flight, tmp_path, monkeypatch):
    for name in [each for each in sys.modules if each.partition(".")[0] == "matplotlib"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(PictureError) as raised:
        draw_flight(flight, tmp_path / "flight.png")
    assert raised.value.code == "no_matplotlib" and "\n" not in str(raised.value)
    assert not (tmp_path / "flight.png").exists()


def test_nothing_of_it_imports_matplotlib_before_something_is_drawn(monkeypatch):
    def refuse(name, *rest, **options):
        assert not name.startswith("matplotlib"), "imported too early"
        return real(name, *rest, **options)

    real = builtins.__import__
    for name in [each for each in sys.modules if each.startswith("up_simulator.picture")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(builtins, "__import__", refuse)
    import up_simulator.picture.flight_picture  # noqa: F401
