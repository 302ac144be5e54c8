"""The picture of a flight: its content, that it is reproducible, and missing data."""

import builtins
import sys

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.text import Text

from tests.simulator.picture.flights import COLUMNS, made_up
from up_flightlog.plots.canvas import PictureError, Sheet
from up_flightlog.plots.chart import Mark, Shade
from up_flightlog.plots.overview import draw_overview, overview_png
from up_flightlog.plots.theme import DAYLIGHT
from up_flightlog.plots.track_picture import Wind
from up_simulator.picture.flight_picture import FOOT, Failure, overview_of
from up_simulator.scenario.log import FlightLog

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(scope="module")
def flight():
    return made_up(20.0)


def drawn(log, **options):
    figure = Figure()
    FigureCanvasAgg(figure)
    draw_overview(Sheet(figure, DAYLIGHT), overview_of(log, **options))
    return figure


def words(figure):
    return "\n".join(each.get_text() for each in figure.findobj(Text))


def test_the_same_flight_gives_the_same_bytes(flight):
    overview = overview_of(flight, title="twice", wind=Wind(4, 90))
    pictures = [overview_png(overview) for _ in range(2)]
    assert pictures[0] == pictures[1]
    assert pictures[0].startswith(PNG) and b"tEXt" not in pictures[0]


def test_all_that_the_log_tells_is_on_it(flight):
    written = words(drawn(flight, title="A title", subtitle="a subtitle"))
    for each in ("A title", "a subtitle", "Roll", "Pitch", "Roll rate", "Sticks", "Servo pulses"):
        assert each in written
    for each in ("Height above ground", "Airspeed", "Load factor", "home", "end"):
        assert each in written
    for each in ("ACRO", "RATE", "FBW", "gust from the left", "phone unplugged"):
        assert each in written
    assert "deg rms" in written


def test_panels_without_data_are_left_out():
    log = FlightLog(["time_s", "truth.roll_deg", "truth.pitch_deg", "demand.roll_deg"])
    for row in range(50):
        log.append({"time_s": row * 0.02, "truth.roll_deg": row})
    written = words(drawn(log))
    assert "Roll" in written
    for missing in ("Pitch", "Sticks", "Servo pulses", "Load factor", "estimate", "demand"):
        assert missing not in written
    assert "home" not in written


def test_marks_given_take_the_place_of_the_events(flight):
    written = words(drawn(flight, marks=[Mark(3, is_bad=True, text="IMU unplugged")]))
    assert "IMU unplugged" in written
    assert "phone unplugged" not in written


def test_a_failed_expectation_is_shaded_on_its_signal(flight):
    failure = Failure("error.roll_deg", 5, 9, "roll: 8 deg, not 3")
    assert "roll: 8 deg, not 3" in words(drawn(flight, failures=[failure]))
    shades = {panel.title: panel.shades for panel in overview_of(flight, failures=[failure]).panels}
    assert shades.pop("Roll") == [Shade(5, 9)]
    assert not any(shades.values())
    homeless = Failure("ground.age_s", 5, 9, "telemetry: 5 s, not 1")
    panels = overview_of(flight, failures=[homeless]).panels
    assert [panel.shades for panel in panels] == [[Shade(5, 9, FOOT)]] * len(panels)
    figure = drawn(flight, failures=[homeless])
    hatched = [each for each in figure.findobj(Rectangle) if each.get_hatch()]
    assert len(hatched) == len(panels)


def test_a_crash_is_marked_and_named():
    log = made_up(60.0, crashes=True)
    assert log.numbers("truth.crashed")[-1] == 1
    written = words(drawn(log))
    assert "crash" in written
    assert "crashed at" in written
    assert "end" not in written.split("\n")


def test_wind_is_drawn_where_it_blows(flight):
    assert "wind 5.0 m/s" in words(drawn(flight, wind=Wind(5, 240)))
    assert "wind" not in words(drawn(flight))


def test_a_log_with_nothing_to_draw_is_refused():
    empty = FlightLog(COLUMNS)
    with pytest.raises(PictureError) as raised:
        overview_of(empty)
    assert raised.value.code == "too_short"
    other = FlightLog(["time_s", "board.loop_us"])
    for row in range(3):
        other.append({"time_s": row, "board.loop_us": 2000})
    with pytest.raises(PictureError) as raised:
        overview_of(other)
    assert raised.value.code == "no_signal"


def test_without_matplotlib_the_error_names_the_package(flight, monkeypatch):
    for name in [each for each in sys.modules if each.partition(".")[0] == "matplotlib"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(PictureError) as raised:
        overview_png(overview_of(flight))
    assert raised.value.code == "no_matplotlib" and "\n" not in str(raised.value)


def test_nothing_of_it_imports_matplotlib_before_something_is_drawn(monkeypatch):
    def refuse(name, *rest, **options):
        assert not name.startswith("matplotlib"), "imported too early"
        return real(name, *rest, **options)

    real = builtins.__import__
    for name in [each for each in sys.modules if each.startswith("up_simulator.picture")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(builtins, "__import__", refuse)
    import up_simulator.picture.flight_picture  # noqa: F401
