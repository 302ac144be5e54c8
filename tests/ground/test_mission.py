"""`up-ground mission`: real programs, a real proxy, and the store of a real aircraft."""

import json

import pytest

from raspilot.mission.store import PlanStore
from tests.ground.aircraft import Aircraft, coded, codes, frame, ground
from tests.up.mission.plans import document, row, rows, simple, waypoint
from up.commands.mission_commands import (
    MissionCommitCommand,
    MissionPartCommand,
    MissionRequestCommand,
)
from up.commands.refusal import CommandRefusedError
from up.mission.items import plan_id
from up.mission.plan_forms import read_plan

CIRCLE = {"circle": {"center": [50.08, 14.43], "radius": 900.0}, "inclusion": True, "version": 1}
MANY = document(*(waypoint(each, 50.08 + each / 1e4) for each in range(1, 46)), circles=[CIRCLE])


class Flying(Aircraft):
    """An aircraft that keeps plans; `problems` are what its check finds."""

    def __init__(self, port, folder, problems=()):
        self.stores = {plan: PlanStore(plan, folder) for plan in ("mission", "fence")}
        self.problems = problems
        answers = {
            "up.mission.part": lambda message: self._do(message, MissionPartCommand, self._part),
            "up.mission.commit": lambda message: self._do(
                message, MissionCommitCommand, self._commit
            ),
            "up.mission.request": lambda message: self._do(
                message, MissionRequestCommand, self._request
            ),
        }
        super().__init__(port, answers)

    def _do(self, message, cls, carry_out):
        command = cls.from_data(message["data"])
        try:
            told = carry_out(self.stores[command.plan], command) or []
        except CommandRefusedError as error:
            nack = {"id": message["id"], "code": error.code.value, "reason": error.reason}
            return [*self._told(command), ("up.nack", {**nack, "detail": error.detail})]
        return [*told, ("up.ack", {"id": message["id"]})]

    def _told(self, command):
        if isinstance(command, MissionCommitCommand):
            data = {"plan": command.plan, "plan_id": command.plan_id}
            yield "up.mission.problems", {**data, "problems": self.problems, "untold": 2}

    def _part(self, store, command):
        store.stage(command)

    def _commit(self, store, command):
        items, _ = store.staged(command)
        if self.problems:
            raise CommandRefusedError("too far", detail="plan_invalid")
        store.use(tuple(items), command.plan_id)

    def _request(self, store, command):
        part = store.part(command)
        return [(part.NAME, part.data)]


@pytest.fixture
def flying(proxy, tmp_path):
    with Flying(proxy.airborne_port, tmp_path) as aircraft:
        yield aircraft


def written(folder, given, name="field.plan"):
    path = folder / name
    path.write_text(given if isinstance(given, str) else json.dumps(given))
    return str(path)


def run(folder, proxy, *words, **more):
    return ground(folder, proxy.ground_port, "mission", *words, **more)


def test_a_file_is_uploaded_and_comes_back_as_it_was(proxy, flying, tmp_path):
    path = written(tmp_path, MANY)
    status, said, stderr = run(tmp_path, proxy, "upload", path)
    assert (status, stderr) == (0, "")
    plan = read_plan(json.dumps(MANY), "")
    assert flying.stores["mission"].items == plan.items
    assert flying.stores["fence"].items == plan.borders
    identities = {"mission": plan_id(plan.items), "fence": plan_id(plan.borders)}
    told = json.loads(said)
    assert {each: told[each]["plan_id"] for each in told} == identities
    commits = [each for each in flying.received if each["name"] == "up.mission.commit"]
    assert [each["data"]["plan"] for each in commits] == ["fence", "mission"]
    assert all(each["beacon"] > 4711 for each in commits)

    copy = str(tmp_path / "copy.plan")
    assert run(tmp_path, proxy, "download", copy)[0] == 0
    again = read_plan((tmp_path / "copy.plan").read_text(), "")
    assert (again.items, again.borders) == (plan.items, plan.borders)
    kept = (tmp_path / "copy.plan").read_text()
    status, _, stderr = run(tmp_path, proxy, "download", copy)
    assert (status, codes(stderr)) == (1, ["file_unsuitable"])
    assert (tmp_path / "copy.plan").read_text() == kept

    status, said, _ = run(tmp_path, proxy, "clear", "mission", UP_LOG_FORMAT="")
    assert (status, said) == (0, "mission: 0 items in use\n")
    assert flying.stores["mission"].items == ()
    assert flying.stores["fence"].items == plan.borders


def test_only_one_of_both_can_be_transferred(proxy, flying, tmp_path):
    path = written(tmp_path, MANY)
    status, said, _ = run(tmp_path, proxy, "upload", path, "--fence-only")
    assert (status, list(json.loads(said))) == (0, ["fence"])
    assert flying.stores["mission"].items == ()
    path = str(tmp_path / "copy.waypoints")
    status, _, stderr = run(tmp_path, proxy, "download", path, "--fence-only")
    assert (status, codes(stderr)) == (1, ["file_unsuitable"])


def test_problems_of_the_aircraft_name_the_items_of_the_file(proxy, flying, tmp_path):
    flying.problems = [{"item": 2, "code": "too_far", "text": "9000 m from home"}]
    path = written(tmp_path, rows(row(1, 189), *(row(n, 16, *PLACE) for n in (2, 3))), "a.txt")
    status, said, stderr = run(tmp_path, proxy, "upload", path)
    assert (status, codes(stderr)) == (1, ["left_out", "refused", "too_far", "untold"])
    (problem,) = json.loads(said)["mission"]["problems"]
    assert (problem["item"], problem["number"], problem["code"]) == (2, 3, "too_far")
    assert flying.stores["mission"].items == ()


PLACE = (0, 0, 0, 0, 50.08, 14.43, 60)


def test_a_wrong_file_is_not_uploaded(proxy, tmp_path):
    path = written(tmp_path, document(waypoint(1), simple(2, 84), simple(3, 9999)))
    status, said, stderr = ground(tmp_path, 1, "mission", "upload", path)
    assert (status, said) == (1, "")
    assert [(each["item"], each["code"]) for each in coded(stderr)] == [
        (2, "command_unsupported"),
        (3, "command_unknown"),
    ]


def test_a_file_is_checked_offline(tmp_path):
    path = written(tmp_path, MANY)
    status, said, stderr = ground(tmp_path, 1, "mission", "check", path)
    told = json.loads(said)
    assert (status, stderr) == (0, "")
    assert (told["form"], told["items"], told["borders"]) == ("plan", 45, 1)
    path = written(tmp_path, json.dumps(MANY)[:-9])
    status, said, _ = ground(tmp_path, 1, "mission", "check", path)
    assert (status, [each["code"] for each in json.loads(said)["problems"]]) == (1, ["not_json"])
    status, said, stderr = ground(tmp_path, 1, "mission", "check", path, UP_LOG_FORMAT="")
    assert (status, said, stderr.count("\n")) == (1, "", 1)


@pytest.mark.parametrize(
    ("words", "status", "code"),
    [
        (["check", "missing.plan"], 1, "os_error"),
        (["upload", "missing.plan"], 1, "os_error"),
        (["start", "--item", "0"], 2, "usage"),
        (["clear", "all"], 2, "usage"),
        (["upload"], 2, "usage"),
    ],
)
def test_mistakes_are_found_before_a_connection(tmp_path, words, status, code):
    assert ground(tmp_path, 1, "mission", *words)[::2][0] == status
    assert codes(ground(tmp_path, 1, "mission", *words)[2]) == [code]


def test_bytes_and_empty_plans_are_refused(tmp_path):
    path = tmp_path / "a.plan"
    path.write_bytes(b"{\xff")
    assert codes(ground(tmp_path, 1, "mission", "check", str(path))[2]) == ["not_text"]
    empty = written(tmp_path, document())
    assert codes(ground(tmp_path, 1, "mission", "upload", empty)[2]) == ["nothing_to_upload"]


def test_start_selects_the_item_and_then_the_mode(proxy, flying, tmp_path):
    status, said, _ = run(tmp_path, proxy, "start", "--item", "3")
    assert (status, codes(said)) == (0, ["ack", "ack"])
    assert [(each["name"], each["data"]) for each in flying.received] == [
        ("up.mission.item", {"item": 3}),
        ("up.flight_mode.set", {"mode": "MISSION"}),
    ]
    assert all(each["beacon"] > 4711 for each in flying.received)


def test_an_item_that_is_refused_starts_nothing(proxy, tmp_path):
    def refuse(message):
        return [("up.nack", {"id": message["id"], "code": "refused", "detail": "no_item"})]

    with Aircraft(proxy.airborne_port, {"up.mission.item": refuse}) as aircraft:
        status, _, stderr = run(tmp_path, proxy, "start", "--item", "9")
    assert (status, coded(stderr)) == (1, [{"code": "refused", "detail": "no_item"}])
    assert [each["name"] for each in aircraft.received] == ["up.mission.item"]


def test_the_status_needs_no_control(proxy, owner, tmp_path):
    told = {
        "mission": {"id": "0123", "count": 12, "item": 3, "distance": 240.4, "is_finished": False},
        "fence": {"id": "4567", "count": 2},
    }
    with Aircraft(proxy.airborne_port, None, frame(**told)):
        status, said, _ = run(tmp_path, proxy, "status")
        assert (status, json.loads(said)["mission"]) == (0, told["mission"])
        status, said, _ = run(tmp_path, proxy, "status", UP_LOG_FORMAT="")
    assert said.splitlines()[:2] == ["mission 0123: item 3 of 12, 240 m away", "fence: 2 borders"]


def test_without_control_nothing_is_uploaded(proxy, owner, flying, tmp_path):
    status, _, stderr = run(tmp_path, proxy, "upload", written(tmp_path, MANY))
    assert (status, codes(stderr)) == (1, ["control_held"])
    assert flying.received == []
