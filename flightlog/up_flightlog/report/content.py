"""The content of a report, computed once."""

from __future__ import annotations

from dataclasses import dataclass

from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.findings.summary import Finding, FlightSummary, findings, summarise
from up_flightlog.plots.chart import Background, Mark
from up_flightlog.plots.track_picture import TrackView
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.report.events import Event, events_of
from up_flightlog.report.ground_track import track_view
from up_flightlog.report.panels import Picture, pictures_of
from up_flightlog.report.report_data import ReportData, read_report_data

_MAX_MARKS = 60


@dataclass(frozen=True, slots=True)
class ReportContent:
    """The content of a flight."""

    number: int | None
    log: FlightLog
    summary: FlightSummary
    findings: list[Finding]
    events: list[Event]
    data: ReportData
    pictures: list[Picture]
    track: TrackView | None
    background: Background


def report_content(log: FlightLog, number: int | None = None) -> ReportContent:
    """Analyse a flight; raises FlightLogError when a file can no longer be read."""
    context = FlightContext(log)
    summary, found = summarise(log, context), findings(log, context)
    data = read_report_data(log, context)
    marks = [Mark(each.time_s, is_bad=True) for each in found if each.level == "alarm"]
    marks += [Mark(each.time_s) for each in summary.marks]
    return ReportContent(
        number=number,
        log=log,
        summary=summary,
        findings=found,
        events=events_of(log, context),
        data=data,
        pictures=list(pictures_of(data)),
        track=track_view(data, [each.time_s for each in summary.marks]),
        background=Background(log.length_s, data.bands, marks[:_MAX_MARKS]),
    )
