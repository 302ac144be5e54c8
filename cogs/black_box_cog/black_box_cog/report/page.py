"""The page of a report: one self-contained HTML file without network access."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path

from black_box_cog.report.findings import Findings
from black_box_cog.report.html_text import Markup, join, lines, tag
from black_box_cog.report.images import ImageSet
from black_box_cog.report.sections import events, figures, gains, modes, record, truth, wrong_list
from black_box_cog.report.svg_track import svg_track
from black_box_cog.report.verdict import verdict_of
from black_box_cog.report.wording import start_text
from up.flight_log.spans import duration_text
from up.version import VERSION

_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
"""Even content that slipped through an escape could neither run nor load anything."""
_NARROW = "(max-width: 44rem)"
_DARK = "screen and (prefers-color-scheme: dark)"


def page_of(findings: Findings, images: Mapping[str, ImageSet], missing: str = "") -> str:
    """Return the page; ``missing`` is the reason if there are no pictures."""
    return f"<!doctype html>\n{_html(findings, images, missing)}\n"


def _html(findings: Findings, images: Mapping[str, ImageSet], missing: str) -> Markup:
    style = (Path(__file__).parent / "report.css").read_text(encoding="utf-8")
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("title", _title(findings)),
        tag("style", Markup(style)),
    )
    body = tag(
        "body",
        tag("main", _head(findings), wrong_list(findings), _track(findings, images)),
        tag("p", missing) if missing else None,
        *(_picture(findings, images, picture.name) for picture in findings.pictures),
        _section("Events", events(findings)),
        _section("Gains", gains(findings)),
        _section("Configuration", _configuration(findings)),
        _section("Record", record(findings)),
        tag("footer", f"Raspilot {VERSION}, up log report"),
    )
    return tag("html", head, body, lang="en")


def _title(findings: Findings) -> str:
    number = "" if findings.number is None else f" flight {findings.number}"
    return f"{findings.summary.aircraft or 'aircraft'}{number}"


def _head(findings: Findings) -> Markup:
    level, sentence = verdict_of(findings.summary, findings.wrongs)
    number = "Flight" if findings.number is None else f"Flight {findings.number}"
    when = f"{start_text(findings.log.start_unix_s)}, {duration_text(findings.log.length_s)}"
    return tag(
        "header",
        tag("p", number, class_="eyebrow"),
        tag("h1", findings.summary.aircraft or "An aircraft without a name"),
        tag("p", when, class_="when"),
        tag("p", sentence, class_=f"verdict {level}"),
        figures(findings),
    )


def _section(title: str, content: Markup | None) -> Markup | None:
    return tag("section", tag("h2", title), content) if content else None


def _track(findings: Findings, images: Mapping[str, ImageSet]) -> Markup | None:
    if findings.track is None:
        return None
    image = images.get("track")
    drawn = svg_track(findings.track) if image is None else _image(image, "the track from above")
    note = "Metres from the home, which is the first position."
    if findings.track.wind is not None and image is not None:
        note += " The wind is the simulator's."
    figure = tag("figure", drawn, tag("figcaption", note))
    return _section("Track", tag("div", figure, modes(findings), class_="beside"))


def _picture(findings: Findings, images: Mapping[str, ImageSet], name: str) -> Markup | None:
    picture = next(each for each in findings.pictures if each.name == name)
    image = images.get(name)
    told = truth(findings) if name == "truth" else None
    if image is None and told is None:
        return None
    alt = f"{picture.title} over time: {', '.join(panel.title for panel in picture.panels)}"
    figure = (
        tag("figure", _image(image, alt), tag("figcaption", picture.caption)) if image else None
    )
    return _section(picture.title, join(figure, told))


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


def _configuration(findings: Findings) -> Markup | None:
    found = []
    for name, attachment in sorted(findings.log.attachments.items()):
        text = attachment.read().decode("utf-8", "replace")
        summary = tag("summary", name, " ", tag("span", f"{attachment.size} bytes", class_="note"))
        found.append(tag("details", summary, tag("pre", lines(text))))
    return join(*found) if found else None
