"""The content of a report, computed once."""

from __future__ import annotations

from dataclasses import dataclass

from black_box_cog.pictures.chart import Mark, Stage
from black_box_cog.pictures.track_picture import TrackView
from black_box_cog.report.events import Event, events_of
from black_box_cog.report.ground_track import track_view
from black_box_cog.report.panels import Picture, pictures_of
from black_box_cog.report.report_data import ReportData, read_report_data
from up.flight_log.flight_context import FlightContext
from up.flight_log.flight_log import FlightLog
from up.flight_log.summary import Finding, FlightSummary, findings, summarise

_MAX_MARKS = 60


@dataclass(frozen=True, slots=True)
class ReportContent:
    """The content of a flight; ``name`` is the base name of its files."""

    name: str
    number: int | None
    log: FlightLog
    summary: FlightSummary
    findings: list[Finding]
    events: list[Event]
    data: ReportData
    pictures: list[Picture]
    track: TrackView | None
    stage: Stage


def report_content(log: FlightLog, name: str, number: int | None = None) -> ReportContent:
    """Analyse a flight; raises FlightLogError when a file can no longer be read."""
    context = FlightContext(log)
    summary, found = summarise(log, context), findings(log, context)
    data = read_report_data(log, context)
    marks = [Mark(each.time_s, is_bad=True) for each in found if each.level == "alarm"]
    marks += [Mark(each.time_s) for each in summary.marks]
    return ReportContent(
        name=name,
        number=number,
        log=log,
        summary=summary,
        findings=found,
        events=events_of(log, context),
        data=data,
        pictures=list(pictures_of(data)),
        track=track_view(data, [each.time_s for each in summary.marks]),
        stage=Stage(log.length_s, data.bands, marks[:_MAX_MARKS]),
    )
