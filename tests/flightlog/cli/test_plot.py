import pytest
from PIL import Image

from tests.flightlog.logbook import EVIL, eventful, write_flight


def size_of(path):
    with Image.open(path) as image:
        image.verify()
        return image.size


def test_the_flight_as_a_picture(log, flights, tmp_path):
    path = write_flight(flights, 1, eventful, aircraft="$\\frac{kite")
    outcome = log("plot", "last")
    assert outcome.status == 0 and outcome.out.startswith(f"{path.stem}.png ")
    width, height = size_of(tmp_path / f"{path.stem}.png")
    assert width > 1500 and height > 500


@pytest.mark.parametrize("order", ["plot 1 {fields} -o a.png", "plot 1 -o a.png {fields}"])
def test_named_fields(log, flights, tmp_path, order):
    write_flight(flights, 1, eventful)
    fields = ("up.orientation.update.roll", "arduino.pids.values.ratePIDs.ailerons.p")
    outcome = log(*order.replace("{fields}", " ".join(fields)).split())
    assert outcome.status == 0, outcome.err
    assert size_of(tmp_path / "a.png")[0] > 1000


def test_an_unknown_field(log, flights):
    write_flight(flights, 1)
    outcome = log("plot", 1, "up.orientation.update.rol")
    assert outcome.status == 2 and "up.orientation.update.roll?" in outcome.err
    unlike = log("plot", 1, "zzzzzzzz")
    assert unlike.status == 2 and "'zzzzzzzz'" in unlike.err and unlike.err.count(",") < 12
    assert log("plot", 1, "up.orientation.update").status == 2
    assert log("plot", 1, *(f"a.f{n}" for n in range(13))).status == 2


def test_an_existing_file_is_kept_without_force(log, flights, tmp_path):
    write_flight(flights, 1)
    (tmp_path / "a.png").write_text("mine")
    assert "--force" in log("plot", 1, "-o", "a.png").err
    assert (tmp_path / "a.png").read_text() == "mine"
    assert log("plot", 1, "-o", "a.pdf").status == 2


def test_a_single_value_is_drawn_too(log, flights, tmp_path):
    write_flight(flights, 1, lambda maker: maker.add(0, "a", x=1))
    assert log("plot", 1, "a.x", "-o", "a.png").status == 0
    assert size_of(tmp_path / "a.png")


def test_nothing_to_draw(log, flights, monkeypatch):
    write_flight(flights, 1, lambda maker: maker.add(0, f"a {EVIL}", text="x"))
    outcome = log("plot", 1)
    assert outcome.status == 1 and "FIELD" in outcome.err
    monkeypatch.setattr("up_flightlog.cli.plot_verb.has_matplotlib", lambda: False)
    outcome = log("plot", 1)
    assert outcome.status == 1 and "raspilot[log]" in outcome.err
