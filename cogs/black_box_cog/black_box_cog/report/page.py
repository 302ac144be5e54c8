"""The page of a report: one self-contained HTML file without network access."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path

from black_box_cog.report.content import ReportContent
from black_box_cog.report.formatting import start_text
from black_box_cog.report.html_text import Markup, join, lines, tag
from black_box_cog.report.images import ImageSet
from black_box_cog.report.sections import events, figures, finding_list, gains, modes, record, truth
from black_box_cog.report.verdict import verdict_of
from up.flight_log.spans import duration_text
from up.version import VERSION

_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
"""Even content that slipped through an escape could neither run nor load anything."""
_NARROW = "(max-width: 44rem)"
_DARK = "screen and (prefers-color-scheme: dark)"


def page_of(content: ReportContent, images: Mapping[str, ImageSet], missing: str = "") -> str:
    """Return the page; ``missing`` is the reason if there are no pictures."""
    return f"<!doctype html>\n{_html(content, images, missing)}\n"


def _html(content: ReportContent, images: Mapping[str, ImageSet], missing: str) -> Markup:
    style = (Path(__file__).parent / "report.css").read_text(encoding="utf-8")
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("title", _title(content)),
        tag("style", Markup(style)),
    )
    body = tag(
        "body",
        tag("main", _head(content), finding_list(content), _track(content, images)),
        tag("p", missing) if missing else None,
        *(_picture(content, images, picture.name) for picture in content.pictures),
        _section("Events", events(content)),
        _section("Gains", gains(content)),
        _section("Configuration", _configuration(content)),
        _section("Record", record(content)),
        tag("footer", f"Raspilot {VERSION}, up log report"),
    )
    return tag("html", head, body, lang="en")


def _title(content: ReportContent) -> str:
    number = "" if content.number is None else f" flight {content.number}"
    return f"{content.summary.aircraft or 'aircraft'}{number}"


def _head(content: ReportContent) -> Markup:
    level, sentence = verdict_of(content.summary, content.findings)
    number = "Flight" if content.number is None else f"Flight {content.number}"
    when = f"{start_text(content.log.start_unix_s)}, {duration_text(content.log.length_s)}"
    return tag(
        "header",
        tag("p", number, class_="eyebrow"),
        tag("h1", content.summary.aircraft or "An aircraft without a name"),
        tag("p", when, class_="when"),
        tag("p", sentence, class_=f"verdict {level}"),
        figures(content),
    )


def _section(title: str, content: Markup | None) -> Markup | None:
    return tag("section", tag("h2", title), content) if content else None


def _track(content: ReportContent, images: Mapping[str, ImageSet]) -> Markup | None:
    image = images.get("track")
    if image is None:
        return _section("Modes", modes(content))
    note = "Metres from the home, which is the first position."
    if content.track is not None and content.track.wind is not None:
        note += " The wind is the simulator's."
    figure = tag("figure", _image(image, "the track from above"), tag("figcaption", note))
    return _section("Track", tag("div", figure, modes(content), class_="beside"))


def _picture(content: ReportContent, images: Mapping[str, ImageSet], name: str) -> Markup | None:
    picture = next(each for each in content.pictures if each.name == name)
    image = images.get(name)
    errors = truth(content) if name == "truth" else None
    if image is None and errors is None:
        return None
    alt = f"{picture.title} over time: {', '.join(panel.title for panel in picture.panels)}"
    figure = (
        tag("figure", _image(image, alt), tag("figcaption", picture.caption)) if image else None
    )
    return _section(picture.title, join(figure, errors))


def _image(image: ImageSet, alt: str) -> Markup:
    wide = 1060
    return tag(
        "picture",
        tag("source", media=f"{_DARK} and {_NARROW}", srcset=_data(image.narrow_dark)),
        tag("source", media=f"screen and {_NARROW}", srcset=_data(image.narrow)),
        tag("source", media=_DARK, srcset=_data(image.wide_dark)),
        tag(
            "img",
            src=_data(image.wide),
            alt=alt,
            width=wide,
            height=round(wide * image.ratio),
        ),
    )


def _data(png: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(png).decode('ascii')}"


def _configuration(content: ReportContent) -> Markup | None:
    found = []
    for name, attachment in sorted(content.log.attachments.items()):
        text = attachment.read().decode("utf-8", "replace")
        summary = tag("summary", name, " ", tag("span", f"{attachment.size} bytes", class_="note"))
        found.append(tag("details", summary, tag("pre", lines(text))))
    return join(*found) if found else None
