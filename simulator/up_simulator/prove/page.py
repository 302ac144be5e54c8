"""The result of a proof: one self-contained HTML page, and the same as JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from up.version import VERSION
from up_flightlog.report.html_text import Markup, join, table, tag
from up_simulator.prove.advice import advice_of, story
from up_simulator.prove.flight import Outcome
from up_simulator.prove.judge import Sample
from up_simulator.prove.rows import point_of, row_of
from up_simulator.prove.setup import Setup

_STYLE = """body{font:16px/1.45 sans-serif;max-width:64rem;margin:1rem auto;padding:0 1rem}
table{border-collapse:collapse}td,th{padding:.2rem .6rem;border-bottom:1px solid #8885;
text-align:left}.number{text-align:right}.table{overflow-x:auto}.bad{color:#c22}.good{color:#283}
figure{display:inline-block;margin:0 1rem 0 0}svg{max-width:100%;height:auto}"""
_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
_SIZE, _EDGE = 320, 14


@dataclass(slots=True)
class Proof:
    """Everything known: the flights in their order, and rows that are left out, with reasons."""

    setup: Setup
    planned: int
    outcomes: list[Outcome] = field(default_factory=list)
    refusals: list[str] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)

    @property
    def failed(self) -> list[Outcome]:
        return [each for each in self.outcomes if not each.is_held]

    @property
    def is_whole(self) -> bool:
        return len(self.outcomes) == self.planned

    @property
    def is_held(self) -> bool:
        return self.is_whole and not self.refusals and not self.failed

    def verdict(self) -> str:
        if self.refusals:
            return "This configuration is refused: the aircraft does not arm. Nothing was flown."
        held, flown = len(self.outcomes) - len(self.failed), len(self.outcomes)
        rest = "" if self.is_whole else f" Interrupted: {self.planned - flown} were not flown."
        return f"{held} of {flown} flights held.{rest}"

    def worst(self) -> list[tuple[str, int, int, Outcome]]:
        """Return of each row its code, the flights, how many held, and the worst of them."""
        found = []
        for code in dict.fromkeys(each.case.row for each in self.outcomes):
            own = [each for each in self.outcomes if each.case.row == code]
            worst = max(own, key=_badness)
            found.append((code, len(own), sum(each.is_held for each in own), worst))
        return found


def _badness(outcome: Outcome) -> tuple[int, float]:
    figures = outcome.figures
    return len(outcome.found), figures.height_lost_m - figures.least_m_s


def document(proof: Proof) -> dict[str, Any]:
    """Return the result for programs."""
    setup = proof.setup
    return {
        "config": setup.folder,
        "airframe": setup.airframe,
        "held": proof.is_held,
        "refusals": proof.refusals,
        "left_out": proof.left_out,
        "planned": proof.planned,
        "cpu_s": round(sum(each.cpu_s for each in proof.outcomes), 1),
        "flights": [_flight(each, setup) for each in proof.outcomes],
    }


def _flight(outcome: Outcome, setup: Setup) -> dict[str, Any]:
    advice = advice_of(outcome, setup)
    figures = dataclasses.asdict(outcome.figures)
    return {
        **dataclasses.asdict(outcome.case),
        "held": outcome.is_held,
        "codes": outcome.codes,
        "text": story(outcome, setup),
        **{key: value if value is None else round(value, 2) for key, value in figures.items()},
        "advice": None
        if advice is None
        else {
            "settings": [dataclasses.asdict(each) for each in advice.settings],
            "text": str(advice),
        },
    }


def page(proof: Proof) -> str:
    """Return the page."""
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", "Proof of a configuration"),
        tag("style", Markup(_STYLE)),
    )
    setup = proof.setup
    body = tag(
        "body",
        tag("h1", "Does this configuration bring the aircraft home?"),
        tag("p", f"{setup.folder}, airframe {setup.airframe}, Raspilot {VERSION}, simulated."),
        tag("p", tag("strong", proof.verdict()), class_="good" if proof.is_held else "bad"),
        _list("Refused", proof.refusals),
        *(_failure(each, setup) for each in proof.failed),
        tag("h2", "Every failure, with its worst flight") if proof.outcomes else None,
        _rows(proof) if proof.outcomes else None,
        _list(
            "Not flown: the configuration has no such failure",
            [f"{row_of(code).about}: {why}" for code, why in proof.left_out.items()],
        ),
    )
    return f"<!doctype html>\n{tag('html', head, body, lang='en')}\n"


def _list(title: str, texts: Sequence[str]) -> Markup | None:
    if not texts:
        return None
    return join(tag("h2", title), tag("ul", *(tag("li", each) for each in texts)))


def _failure(outcome: Outcome, setup: Setup) -> Markup:
    case, advice = outcome.case, advice_of(outcome, setup)
    change = None if advice is None else tag("p", tag("strong", "Change: "), str(advice))
    return tag(
        "section",
        tag("h2", f"{row_of(case.row).about}, {point_of(case.point).about}", class_="bad"),
        tag("p", story(outcome, setup)),
        change,
        _picture(outcome.track) if outcome.track else None,
        tag("p", f"{case.weather}; flight controller {case.controller}, seed {case.seed}."),
    )


def _rows(proof: Proof) -> Markup:
    head = ["failure", "held", "worst flight", "height lost", "farthest", "least airspeed", "time"]
    rows = []
    for code, count, held, worst in proof.worst():
        case, figures = worst.case, worst.figures
        word = tag("span", f"{held} of {count}", class_="good" if held == count else "bad")
        about = f"{point_of(case.point).about}, {case.weather}, {case.controller}, seed {case.seed}"
        rows.append([
            row_of(code).about, word, about, f"{figures.height_lost_m:.0f} m",
            f"{figures.greatest_m:.0f} m", f"{figures.least_m_s:.1f} m/s",
            f"{figures.flown_s:.0f} s",
        ])  # fmt: skip
    return table(head, rows, right=(3, 4, 5, 6))


def _picture(track: Sequence[Sample]) -> Markup:
    """Draw the track from above, north up: home is green, the end red."""
    points = [(0.0, 0.0), *((each.east_m, -each.north_m) for each in track)]
    left, top = (min(each[at] for each in points) for at in (0, 1))
    wide = max(max(each[at] for each in points) - low for at, low in ((0, left), (1, top)))
    scale = (_SIZE - 2 * _EDGE) / (wide or 1.0)
    home, *line = [
        f"{_EDGE + scale * (east - left):.1f},{_EDGE + scale * (south - top):.1f}"
        for east, south in points
    ]
    dots = [
        tag("circle", cx=x, cy=y, r=5, fill=colour)
        for (x, y), colour in ((home.split(","), "#283"), (line[-1].split(","), "#c22"))
    ]
    drawn = tag("polyline", points=" ".join(line), fill="none", stroke="#26c", stroke_width=2)
    size = f"0 0 {_SIZE} {_SIZE}"
    svg = tag("svg", drawn, *dots, viewBox=size, width=_SIZE, role="img")
    caption = f"From above, north up, {wide:.0f} m wide; home is green, the end is red."
    return tag("figure", svg, tag("figcaption", caption))
