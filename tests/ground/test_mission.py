import json

import pytest

from tests.ground.aircraft import Aircraft, coded, codes, frame, ground
from tests.ground.flying import Flying
from tests.up.mission.plans import document, row, rows, simple, waypoint
from up.mission.items import plan_id
from up.mission.plan_forms import read_plan
from up_ground.main import main

CIRCLE = {"circle": {"center": [50.08, 14.43], "radius": 900.0}, "inclusion": True, "version": 1}
MANY = document(*(waypoint(each, 50.08 + each / 1e4) for each in range(1, 46)), circles=[CIRCLE])


@pytest.fixture
def flying(proxy, tmp_path):
    with Flying(proxy.airborne_port, tmp_path) as aircraft:
        yield aircraft


def written(folder, given, name="field.plan"):
    path = folder / name
    path.write_text(given if isinstance(given, str) else json.dumps(given))
    return str(path)


@pytest.fixture
def offline(monkeypatch, capsys):
    """Run the program here: (status, stdout, stderr)."""

    def run(*words, output="json"):
        monkeypatch.setenv("UP_LOG_FORMAT", output)
        try:
            status = main(["mission", *words])
        except SystemExit as error:
            status = error.code
        return (status, *capsys.readouterr())

    return run


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
    assert again.home == (50.07, 14.4, 210.0), "the aircraft's, of its telemetry"
    status, said, _ = run(tmp_path, proxy, "clear", "mission", UP_LOG_FORMAT="")
    assert (status, said) == (0, "mission: 0 items in use\n")
    assert flying.stores["mission"].items == ()
    assert flying.stores["fence"].items == plan.borders


def test_only_the_fence_of_a_file_is_uploaded(proxy, flying, tmp_path):
    status, said, _ = run(tmp_path, proxy, "upload", written(tmp_path, MANY), "--fence-only")
    assert (status, list(json.loads(said))) == (0, ["fence"])
    assert (len(flying.stores["fence"].items), flying.stores["mission"].items) == (1, ())


def test_a_download_overwrites_nothing(offline, tmp_path):
    path = written(tmp_path, MANY)
    status, _, stderr = offline("download", path)
    assert (status, codes(stderr)) == (1, ["file_unsuitable"])
    assert read_plan((tmp_path / "field.plan").read_text(), "").items


def test_a_file_of_waypoints_has_no_place_for_a_fence(offline, tmp_path):
    status, _, stderr = offline("download", str(tmp_path / "copy.waypoints"), "--fence-only")
    assert (status, codes(stderr)) == (1, ["file_unsuitable"])


def test_problems_of_the_aircraft_name_the_items_of_the_file(proxy, flying, tmp_path):
    flying.problems = {"mission": [{"item": 2, "code": "too_far", "text": "9000 m from home"}]}
    path = written(tmp_path, rows(row(1, 189), *(row(n, 16, *PLACE) for n in (2, 3))), "a.txt")
    status, said, stderr = run(tmp_path, proxy, "upload", path)
    assert (status, codes(stderr)) == (1, ["left_out", "refused", "too_far", "untold"])
    (problem,) = json.loads(said)["mission"]["problems"]
    assert (problem["item"], problem["number"], problem["code"]) == (2, 3, "too_far")
    assert flying.stores["mission"].items == ()


@pytest.mark.parametrize("is_fenced", [True, False])
def test_a_refused_mission_leaves_the_fence_that_was_in_use(proxy, flying, tmp_path, is_fenced):
    other = document(circles=[{**CIRCLE, "circle": {**CIRCLE["circle"], "radius": 700.0}}])
    if is_fenced:
        assert run(tmp_path, proxy, "upload", written(tmp_path, other, "other.plan"))[0] == 0
    before = flying.stores["fence"].items
    assert len(before) == is_fenced
    flying.problems = {"mission": [{"item": 2, "code": "too_far", "text": "9000 m from home"}]}
    flying.received.clear()
    status, said, stderr = run(tmp_path, proxy, "upload", written(tmp_path, MANY))
    assert (status, codes(stderr)) == (1, ["refused", "too_far", "untold", "plan_restored"])
    assert flying.stores["fence"].items == before
    assert flying.stores["mission"].items == ()
    told = json.loads(said)
    assert (told["fence"]["restored"], told["fence"]["plan_id"]) == (True, plan_id(before))
    assert told["mission"]["detail"] == "plan_invalid"
    commits = [each["data"]["plan"] for each in flying.received if "commit" in each["name"]]
    assert commits == ["fence", "mission", "fence"]


def test_a_fence_that_cannot_be_restored_is_reported(proxy, flying, tmp_path):
    flying.problems = {"mission": [{"item": 1, "code": "too_far", "text": "9000 m from home"}]}
    flying.refused_ids = {plan_id(())}
    status, said, stderr = run(tmp_path, proxy, "upload", written(tmp_path, MANY))
    assert (status, codes(stderr)[-1]) == (1, "not_restored")
    assert len(flying.stores["fence"].items) == 1
    assert json.loads(said)["fence"]["restored"] is False


PLACE = (0, 0, 0, 0, 50.08, 14.43, 60)


def test_a_wrong_file_is_not_uploaded(offline, tmp_path):
    path = written(tmp_path, document(waypoint(1), simple(2, 84), simple(3, 9999)))
    status, said, stderr = offline("upload", path)
    assert (status, stderr) == (1, "")
    assert [(each["item"], each["code"]) for each in json.loads(said)["problems"]] == [
        (2, "command_unsupported"),
        (3, "command_unknown"),
    ]


def test_a_file_is_checked_offline(offline, tmp_path):
    path = written(tmp_path, MANY)
    status, said, stderr = offline("check", path)
    told = json.loads(said)
    assert (status, stderr) == (0, "")
    assert (told["form"], told["items"], told["borders"]) == ("plan", 45, 1)
    path = written(tmp_path, json.dumps(MANY)[:-9])
    status, said, _ = offline("check", path)
    assert (status, [each["code"] for each in json.loads(said)["problems"]]) == (1, ["not_json"])
    status, said, stderr = offline("check", path, output="text")
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
def test_mistakes_are_found_before_a_connection(offline, words, status, code):
    ended, said, stderr = offline(*words)
    assert (ended, said, codes(stderr)) == (status, "", [code])


def test_bytes_and_empty_plans_are_refused(offline, tmp_path):
    path = tmp_path / "a.plan"
    path.write_bytes(b"{\xff")
    assert codes(offline("check", str(path))[2]) == ["not_text"]
    empty = written(tmp_path, document())
    assert codes(offline("upload", empty)[2]) == ["nothing_to_upload"]


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
    first, second, _ = said.splitlines()
    assert (first, second[-1]) == ("mission 0123: item 3 of 12, 240 m away", "2")


def test_without_control_nothing_is_uploaded(proxy, owner, flying, tmp_path):
    status, _, stderr = run(tmp_path, proxy, "upload", written(tmp_path, MANY))
    assert (status, codes(stderr)) == (1, ["control_held"])
    assert flying.received == []
