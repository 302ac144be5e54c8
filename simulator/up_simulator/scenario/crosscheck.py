"""Contradictions between parts of a scenario that are valid on their own."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from up.config.nodes import MapNode, Node
from up.fields import suggestion
from up_simulator.aircraft import airframe_names
from up_simulator.scenario.locator import locate
from up_simulator.scenario.sampler import sources_of
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import signal_of

Problem = tuple[Node, str]
_PATH_LIKE = ("/", ".")
_NEEDS_BOARD = ("imu", "imu_errors", "reset")
_NEEDS_RASPILOT = ("serial", "serial_noise", "raspilot", "cpu_load_percent")
_NEEDS_PHONE = ("phone", "phone_battery", "gps")
_NEEDS_GROUND = ("link", "link_settings", "command")
_NEEDS_REAL = ("proxy",)
_PARTS = {
    "board": "a flight computer ('board: direct' has none)",
    "demand": "a flight computer ('board: direct' has none)",
    "error": "a flight computer ('board: direct' has none)",
    "estimate_error": "a flight computer ('board: direct' has none)",
    "raspilot": "a Raspberry Pi: add 'raspilot: {runs: in process}'",
    "phone": "a phone: add 'phone: {}' with its keys",
    "distance": "a ground station: add 'ground: {role: pilot}'",
    "ground": "a ground station: add 'ground: {role: pilot}'",
    "goggles": "goggles: add 'goggles: 50x18'",
    "metrics": "a reader of the metrics: add 'metrics: true'",
    "mavlink": "a MAVLink ground: add 'mavlink: true'",
}


def cross_problems(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    """Yield each mistake with its node."""
    yield from _airframe(scenario, root)
    yield from _sticks(scenario, root)
    yield from _participants(scenario, root)
    yield from _events(scenario, root)
    yield from _expectations(scenario, root)
    yield from _control(scenario, root)


def _airframe(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    name = scenario.airframe
    names = airframe_names()
    is_path = any(each in name for each in _PATH_LIKE) or exists(Path(name))
    if name not in names and not is_path:
        known = ", ".join(names)
        yield (
            locate(root, "airframe"),
            f"unknown airframe {name!r}{suggestion(name, names)} ({known})",
        )


def _sticks(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    for at, point in enumerate(scenario.sticks):
        if point.at_s > scenario.duration_s:
            yield locate(root, "sticks", at, "at_s"), _after_end(scenario)
    for at, gust in enumerate(scenario.weather.gusts):
        if gust.at_s > scenario.duration_s:
            yield locate(root, "weather", "gusts", at, "at_s"), _after_end(scenario)
    modes = set(scenario.switch.positions().values())
    for at, point in enumerate(scenario.sticks):
        if point.mode is not None and point.mode not in modes:
            yield locate(root, "sticks", at, "mode"), _no_position(point.mode, scenario)
    if scenario.control is not None and scenario.control.mode not in {None, *modes}:
        what = _no_position(str(scenario.control.mode), scenario)
        yield locate(root, "control", "mode"), what


def _no_position(mode: str, scenario: Scenario) -> str:
    used = {point.mode for point in scenario.sticks}
    positions = scenario.switch.positions()
    free = [position for position, selected in positions.items() if selected not in used]
    what = f"no switch position selects {mode}"
    if not free:
        return f"{what}: the flight uses all three for other modes"
    return f"{what}: add 'switch: {{{free[0]}: {mode}}}'"


def _participants(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    if not scenario.has_raspilot:
        for name in ("phone", "ground"):
            if getattr(scenario, name) is not None:
                what = "needs a Raspberry Pi: add 'raspilot: {runs: in process}'"
                yield locate(root, name), what
    ground = scenario.ground
    if ground is not None and ground.through != "listener" and not scenario.is_real:
        what = f"{ground.through} is a real program: it needs 'raspilot: {{runs: real}}'"
        yield locate(root, "ground", "through"), what
    phone = scenario.phone
    if scenario.is_real and phone is not None and phone.orientation == "udp":
        what = "the links of real programs carry no datagrams: use tcp with 'runs: real'"
        yield locate(root, "phone", "orientation"), what


def _events(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    for at, event in enumerate(scenario.events):
        kind = event.kinds[0]
        node = locate(root, "events", at, kind)
        if kind in _NEEDS_BOARD and not scenario.has_arduino:
            yield node, f"needs the Arduino, and 'board: {scenario.board}' has none"
        if kind in _NEEDS_RASPILOT and not scenario.has_raspilot:
            yield node, "needs a Raspberry Pi: add 'raspilot: {runs: in process}'"
        if kind in _NEEDS_PHONE and scenario.phone is None:
            yield node, "needs a phone: add 'phone: {plugged: true}'"
        if kind in _NEEDS_GROUND and scenario.ground is None:
            yield node, "needs a ground station: add 'ground: {role: pilot}'"
        if kind == "path" and scenario.through != "two paths":
            yield node, "needs two paths: add 'ground: {through: two paths}'"
        if kind in ("link", "link_settings") and scenario.through == "two paths":
            yield node, "the two paths are no simulated link: use 'path: cut'"
        if kind == "crsf" and not scenario.crsf:
            yield node, "needs a CRSF receiver: add 'crsf: [CRUISE, LOITER, RETURN]'"
        if kind == "mavlink" and not scenario.mavlink:
            yield node, "needs a MAVLink ground: add 'mavlink: true'"
        if kind in _NEEDS_REAL and not scenario.is_real:
            yield node, "needs real programs: 'raspilot: {runs: real}'"
        if event.raspilot in ("hung", "awake") and not scenario.is_real:
            yield node, "needs a process to suspend: 'raspilot: {runs: real}'"
        if event.at_s > scenario.duration_s:
            yield locate(root, "events", at, "at_s"), _after_end(scenario)


def _after_end(scenario: Scenario) -> str:
    return f"is after the end of the flight at {scenario.duration_s:g} s"


def _expectations(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    titles = [event.title for event in scenario.events]
    sources = sources_of(scenario)
    seen: set[str] = set()
    for at, expectation in enumerate(scenario.expect):
        if expectation.after and expectation.after not in titles:
            what = f"unknown event {expectation.after!r}{suggestion(expectation.after, titles)}"
            yield locate(root, "expect", at, "after"), what
        if expectation.name in seen:
            yield locate(root, "expect", at, "name"), "duplicate name of an expectation"
        seen.add(expectation.name)
        source = signal_of(expectation.signal).source
        if source not in sources:
            yield locate(root, "expect", at, "signal"), f"needs {_PARTS[source]}"
        begins_s = expectation.from_s + max(
            (event.at_s for event in scenario.events if event.title == expectation.after),
            default=0.0,
        )
        if begins_s >= scenario.duration_s:
            what = f"the flight ends at {scenario.duration_s:g} s, before this window begins"
            yield locate(root, "expect", at, "from_s"), what


def _control(scenario: Scenario, root: MapNode) -> Iterator[Problem]:
    if scenario.control is None:
        return
    names = [expectation.name for expectation in scenario.expect]
    for at, name in enumerate(scenario.control.fails):
        if name not in names:
            what = f"unknown expectation {name!r}{suggestion(name, names)}"
            yield locate(root, "control", "fails", at), what


def exists(path: Path) -> bool:
    """Return whether a path exists; False for one that is too long."""
    try:
        return path.exists()
    except OSError:
        return False
