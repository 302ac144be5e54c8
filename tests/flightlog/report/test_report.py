"""``up log report``: one self-contained page that makes no request and runs no script."""

import base64
import io
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from tests.flightlog.flights import GROUND, PIDTuningsCommand
from tests.flightlog.logbook import EVIL, eventful, gains, quiet, write_flight
from up.cli.cli_error import CliError
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.cli.report_verb import write_report
from up_flightlog.plots.canvas import MISSING, PictureError
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import find_flight
from up_flightlog.report.content import report_content
from up_flightlog.report.finding_groups import verdict_of
from up_flightlog.report.html_text import markup, tag
from up_flightlog.report.images import image_sets
from up_flightlog.report.page import page_of

ALLOWED = set(
    re.findall(
        r"\w+",
        "html head meta title style body main header section footer h1 h2 h3 p dl div dt dd ol ul"
        " li time span figure figcaption picture source img table thead tbody tr th td details"
        " summary pre",
    )
)
VOID = {"meta", "source", "img"}


class Page(HTMLParser):
    """The content of a page, and a list of what it must not contain."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.tags, self.wrong, self.images, self.words, self.open = [], [], [], [], []
        self.policy = ""
        self.feed(text)
        self.close()
        if self.open:
            self.wrong.append(f"not closed: {self.open}")

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        if tag not in ALLOWED:
            self.wrong.append(tag)
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attrs:
            if name in ("src", "srcset"):
                self.images.append(value)
                if not value.startswith("data:image/png;base64,"):
                    self.wrong.append(f"{tag} {name}={value[:40]}")
            elif name.startswith("on") or name in ("href", "style", "action", "background"):
                self.wrong.append(f"{tag} {name}")
        values = dict(attrs)
        if values.get("http-equiv"):
            self.policy += values["content"]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(f"/{tag}")

    def handle_data(self, data):
        if self.open and self.open[-1] == "style":
            if "url(" in data or "@import" in data or "expression" in data:
                self.wrong.append("the style asks for something")
        else:
            self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


def report_of(folder, fill=quiet, **more):
    write_flight(folder / "flights", 1, fill, **more)
    return written(folder)


def written(folder):
    flight = find_flight("last", lambda: folder / "flights")
    content = report_content(FlightLog.read(flight.paths), flight.number)
    files = write_report(content, folder / "report", may_overwrite=False)
    assert files[0] == folder / "report" / "report.html"
    return Page(files[0].read_text()), files, content


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """The report of the malicious flight: drawing it takes seconds, so it is drawn once."""
    return report_of(tmp_path_factory.mktemp("report"), eventful, aircraft=EVIL)


def test_no_scripts_and_no_requests(report):
    page, _, _ = report
    assert not page.wrong
    assert page.policy == "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
    assert "script" not in page.tags


def test_malicious_names_and_texts_are_shown_as_text(report):
    page, _, _ = report
    assert page.words.count(EVIL) >= 3
    assert f"mark: look {EVIL}" in page.text
    assert f"trouble {EVIL}" in page.text
    assert f"config/{EVIL}.yml" in page.text


def test_the_content(report):
    page, _, _ = report
    for words in (
        "Flight 1",
        "20 s were recorded, 10 s of it armed",
        "Faults",
        "gains were changed in flight",
        "Track",
        "Attitude and set-point",
        "Sticks and servos",
        "Ages of the links",
        "Battery and load",
        "Loop times",
        "Measured against the truth",
        "Events",
        "flight mode FBW",
        "disarmed",
        "Gains loop axis P I D rate roll 2 0 0.1",
        "rate roll p 2 3",
        "config/config.yml",
        "# by hand log level: info",
        "serial_cog 1.0.0",
        "up.rx.update 200",
    ):
        assert words in page.text, words


def test_the_error_against_the_truth(report):
    page, _, _ = report
    # Measured 1 and 2 degrees, true 2 and 2; 300 to 320 m, true 301 m.
    assert "roll 1.00 deg 1.00 deg pitch 0.00 deg 0.00 deg altitude" in page.text
    assert "18.50 m" in page.text and "position" in page.text


def test_the_pictures_are_in_the_page_and_beside_it(report):
    page, files, content = report
    names = ["report.html", "track.png", *(f"{each.name}.png" for each in content.pictures)]
    assert [path.name for path in files] == names
    # Wide and narrow, for daylight and for the dark.
    assert len(page.images) == 4 * (len(files) - 1)
    beside = {path.read_bytes() for path in files[1:]}
    drawn = [base64.b64decode(each.partition(",")[2]) for each in page.images]
    assert beside <= set(drawn)
    for png in drawn:
        with Image.open(io.BytesIO(png)) as image:
            image.verify()
    corners = [Image.open(io.BytesIO(png)).convert("RGB").getpixel((0, 0)) for png in drawn[:4]]
    # The palette of a picture has the colour of the page within one step.
    dark, light = pytest.approx((18, 22, 27), abs=1), pytest.approx((255, 255, 255), abs=1)
    assert corners == [dark, light, dark, light]


def test_the_same_flight_is_the_same_picture(report):
    _, files, content = report
    (drawn,) = [image for image in image_sets(replace(content, pictures=[]))]
    assert drawn.wide == files[1].read_bytes()


def test_without_matplotlib(tmp_path, monkeypatch, capsys):
    def missing(*_):
        raise PictureError(MISSING, "no_matplotlib")

    monkeypatch.setattr("up_flightlog.report.images.png_of", missing)
    write_flight(tmp_path / "flights", 1, eventful, aircraft=EVIL)
    page, files, _ = written(tmp_path)
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert [path.name for path in files] == ["report.html"]
    assert not page.wrong and not page.images
    assert MISSING in page.text and "18.50 m" in page.text


@pytest.mark.parametrize(
    "fill",
    [
        lambda maker: None,
        lambda maker: maker.add(0, "a", x=1),
        lambda maker: maker.add(0, "up.telemetry.update", flight_mode=[], armed="yes", location=5),
        lambda maker: [
            maker.add(number, topic, **dict.fromkeys(("roll", "latitude", "level", "pids"), odd))
            for number, odd in enumerate(([], {}, "x", None, True, -1e300, 10**400))
            for topic in ("up.orientation.update", "up.location.update", "arduino.pids.tunings")
        ],
    ],
)
def test_a_log_of_little_or_nonsense(tmp_path, fill):
    page, _, _ = report_of(tmp_path, fill)
    assert not page.wrong and "Faults" in page.text


def test_an_existing_report_is_kept(report, tmp_path):
    _, _, content = report
    (tmp_path / "report.html").write_text("mine")
    with pytest.raises(CliError, match="--force"):
        write_report(content, tmp_path, may_overwrite=False)
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]
    (tmp_path / "file").write_text("")
    with pytest.raises(CliError, match="file"):
        write_report(content, tmp_path / "file", may_overwrite=True)


def test_the_verdict_of_a_quiet_flight(tmp_path):
    write_flight(tmp_path / "flights", 1)
    flight = find_flight("last", lambda: tmp_path / "flights")
    content = report_content(FlightLog.read(flight.paths))
    level, text = verdict_of(content.summary, content.findings)
    assert (level, content.findings) == ("good", [])
    assert all(value in text for value in ("20 s", "10 s", "211 m"))


@settings(deadline=None)
@given(st.text())
def test_any_text_is_escaped(text):
    page = Page(tag("p", text, class_=text))
    assert page.tags == ["p"] and not page.wrong
    shown = "".join(page.words)
    assert shown.isprintable() and (shown == text or not text.isprintable())
    assert "<" not in markup(text)


def test_requested_gains(tmp_path):
    def fill(maker):
        maker.put(1.0, PIDTuningsCommand(pids=gains(2.0).data), GROUND)
        maker.put(3.0, PIDTuningsCommand(pids=gains(2.5).data), GROUND)

    page, _, _ = report_of(tmp_path, fill)
    assert "0:02.0 requested by mission_control" in page.text
    assert "rate roll p 2 2.5" in page.text


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_damaged_log_has_a_page_or_an_error(tmp_path_factory, data):
    """A byte of a real log is another one, or its end is missing."""
    folder = tmp_path_factory.mktemp("damaged")
    path = write_flight(folder, 1, eventful)
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(st.integers(0, len(content) - 1))
        content[at] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(0, len(content)))])
    try:
        content = report_content(FlightLog.read([path]))
        page = Page(page_of(content, {}))
    except FlightLogError as error:
        assert path.name in str(error)
    else:
        assert not page.wrong
