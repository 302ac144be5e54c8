"""The text and tables of a report."""

from __future__ import annotations

from itertools import pairwise

from up.flight_log.origin_text import link_and_role
from up_flightlog.read.series import error_of
from up_flightlog.read.spans import duration_text
from up_flightlog.report.content import ReportContent
from up_flightlog.report.figures import TOPIC_HEAD, figures_of, gap_rows, topic_rows
from up_flightlog.report.finding_groups import LEVELS, FindingGroup, groups_of
from up_flightlog.report.formatting import clock_text
from up_flightlog.report.gains import GainSet, changes, gain_sets, requested_sets
from up_flightlog.report.ground_track import place_error_m
from up_flightlog.report.html_text import Markup, join, table, tag
from up_flightlog.report.report_data import first_link

_NAMES = {"alarm": "alarm", "warning": "warning", "info": "note"}


def figures(content: ReportContent) -> Markup:
    """Return the numbers of the flight."""
    summary = content.summary
    shown = [("recorded", duration_text(summary.length_s)), *figures_of(summary)]
    if summary.flight_controller:
        shown.append(("flight controller", summary.flight_controller))
    cells = [tag("div", tag("dt", name), tag("dd", value)) for name, value in shown]
    return tag("dl", *cells, class_="figures")


def finding_list(content: ReportContent) -> Markup:
    """Return the faults, each kind in the order of its first time."""
    items = [
        tag(
            "li",
            tag("time", clock_text(each.time_s)),
            tag("span", _NAMES[each.level], class_="level"),
            tag("div", tag("span", each.text), _all_times(each)),
            class_=LEVELS[each.level],
        )
        for each in groups_of(content.findings)
    ]
    none = tag("p", "The log shows no fault.")
    shown = tag("ol", *items, class_="findings") if items else none
    return tag("section", tag("h2", "Faults"), shown)


def _all_times(group: FindingGroup) -> Markup | None:
    """Return the times of a repeated fault, folded."""
    if len(group.members) == 1:
        return None
    lines = [tag("p", f"{clock_text(each.time_s)} {each.text}") for each in group.members]
    return tag("details", tag("summary", "all of them"), *lines)


def modes(content: ReportContent) -> Markup:
    """Return the modes with their times, and the silences with their lengths."""
    rows = [
        [clock_text(band.begin_s), band.name, duration_text(band.end_s - band.begin_s)]
        for band in content.data.bands
    ]
    gaps = gap_rows(content.summary)
    parts: list[Markup] = []
    if rows:
        parts += [tag("h3", "Modes"), table(["from", "mode", "for"], rows, right=(2,))]
    if gaps:
        title = tag("h3", "Longest silence of each source")
        parts += [title, table(["source", "for"], gaps, right=(1,))]
    return tag("div", *parts)


def events(content: ReportContent) -> Markup | None:
    """Return the events, in the order of time."""
    items = [
        tag(
            "li",
            tag("time", clock_text(event.time_s)),
            tag("span", event.text, class_="level" if event.level != "info" else None),
            class_=event.level if event.level != "info" else None,
        )
        for event in content.events
    ]
    return tag("ol", *items, class_="events") if items else None


def truth(content: ReportContent) -> Markup | None:
    """Return the errors of the measured values against the truth."""
    data = content.data
    rows = []
    # Without measured positions the log has the true ones, marked as such.
    has_source = first_link(content.log) != "simulator"
    for each in content.summary.estimate_errors:
        rows.append([each.axis, f"{each.rms_deg:.2f} deg", f"{each.worst_deg:.2f} deg"])
    _, found = error_of(data.altitude, data.truth["altitude_m"], is_angle=False)
    if found is not None and has_source:
        rows.append(["altitude", f"{found.rms:.2f} m", f"{found.maximum:.2f} m"])
    place = place_error_m(data).values if has_source else []
    if place:
        rms = (sum(value * value for value in place) / len(place)) ** 0.5
        rows.append(["position", f"{rms:.1f} m", f"{max(place):.1f} m"])
    head = ["measured minus true", "root mean square", "maximum"]
    return table(head, rows, right=(1, 2)) if rows else None


def gains(content: ReportContent) -> Markup | None:
    """Return the gains at the beginning, and each change with both values.

    If the board never reported its gains, these are the requested ones.
    """
    sets = gain_sets(content.log)
    verb = "changed"
    parts: list[Markup] = []
    if not sets:
        sets, verb = requested_sets(content.log), "requested"
        if not sets:
            return None
        parts.append(tag("p", "The log has the requested gains, not the gains in use."))
        parts.append(tag("h3", _changed(sets[0], verb)))
    parts.append(_gain_table(sets[0]))
    for before, after in pairwise(sets):
        rows = [[" ".join(key), _gain(old), _gain(new)] for key, old, new in changes(before, after)]
        parts.append(tag("h3", _changed(after, verb)))
        parts.append(table(["gain", "before", "after"], rows, right=(1, 2)))
    return join(*parts)


def _changed(gains: GainSet, verb: str) -> str:
    return f"{clock_text(gains.time_s)} {verb} by {link_and_role(gains.by)[0] or 'unknown'}"


def record(content: ReportContent) -> Markup:
    """Return the log's metadata: files, versions, topics, damage."""
    log = content.log
    facts = [
        [f"{record} {key}", value.strip()]
        for record, values in log.metadata.items()
        for key, value in values.items()
    ]
    problems = log.problems
    return join(
        tag("h3", "File problems") if problems else None,
        tag("ul", *(tag("li", problem.text) for problem in problems)) if problems else None,
        table(["", ""], [*facts, *(["file", path.name] for path in log.paths)]),
        tag("h3", "Topics"),
        table(TOPIC_HEAD, topic_rows(log), right=(1, 2)),
    )


def _gain_table(gains: GainSet) -> Markup:
    rows: dict[tuple[str, str], dict[str, float]] = {}
    for (loop, axis, term), value in gains.values.items():
        rows.setdefault((loop, axis), {})[term] = value
    return table(
        ["loop", "axis", "P", "I", "D"],
        [
            [loop, axis, *(_gain(terms.get(term)) for term in ("p", "i", "d"))]
            for (loop, axis), terms in rows.items()
        ],
        right=(2, 3, 4),
    )


def _gain(value: float | None) -> str:
    return "" if value is None else f"{value:g}"
