"""The content of a report, computed once."""

from __future__ import annotations

from dataclasses import dataclass

from black_box_cog.pictures.chart import Mark, Stage
from black_box_cog.pictures.track_picture import TrackView
from black_box_cog.report.events import Event, events_of
from black_box_cog.report.evidence import Evidence, evidence_of
from black_box_cog.report.ground_track import track_view
from black_box_cog.report.panels import Picture, pictures_of
from up.flight_log.facts import Facts
from up.flight_log.flight_log import FlightLog
from up.flight_log.summary import FlightSummary, Wrong, summarise, wrongs

_MOST_MARKS = 60


@dataclass(frozen=True, slots=True)
class Findings:
    """The findings of a flight; ``name`` is the base name of its files."""

    name: str
    number: int | None
    log: FlightLog
    summary: FlightSummary
    wrongs: list[Wrong]
    events: list[Event]
    evidence: Evidence
    pictures: list[Picture]
    track: TrackView | None
    stage: Stage


def findings_of(log: FlightLog, name: str, number: int | None = None) -> Findings:
    """Analyse a flight; raises FlightLogError when a file can no longer be read."""
    facts = Facts(log)
    summary, wrong = summarise(log, facts), wrongs(log, facts)
    evidence = evidence_of(log)
    marks = [Mark(each.time_s, is_bad=True) for each in wrong if each.level == "alarm"]
    marks += [Mark(each.time_s) for each in summary.marks]
    return Findings(
        name=name,
        number=number,
        log=log,
        summary=summary,
        wrongs=wrong,
        events=events_of(log, facts),
        evidence=evidence,
        pictures=list(pictures_of(evidence)),
        track=track_view(evidence, [each.time_s for each in summary.marks]),
        stage=Stage(log.length_s, evidence.bands, marks[:_MOST_MARKS]),
    )
