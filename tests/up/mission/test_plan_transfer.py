"""Upload and download, between the ground's class and the aircraft's module, on a bad link."""

import itertools
from random import Random

import pytest

from tests.raspilot.mission.plans_rig import SQUARE, PlansRig, items_of, placed
from up.commands.command_link import CommandLink
from up.commands.mission_commands import MissionPartCommand, MissionRequestCommand
from up.commands.roles import Role
from up.mission.items import plan_id
from up.mission.plan_transfer import PlanTransfer
from up.mission.reliable_requests import TRIES
from up.protocols.general_message import decode, encode

LONG = [placed(300 + 100 * (each % 2), 60.0 * each) for each in range(75)]
CORNERS = [[48.0 + each / 3e5, 16.5 + each / 7e3] for each in range(100)]
FENCE = [
    *({"inside": False, "corners": CORNERS[each:]} for each in range(4)),
    {"latitude": 48.0, "longitude": 17.0, "radius": 2000.0},
]
WAY_S = 0.05


class Air:
    """The link to a real aircraft: each message is late, and some come never or twice."""

    def __init__(self, rig, loss=0.0, seed=1):
        self.rig, self.loss, self.random = rig, loss, Random(seed)
        self.up_names, self.lost, self.endings, self.progress = [], [], [], []
        self.transfer = None
        self.link = CommandLink("test", Role.OPERATOR, lambda line: self.carry(line, self.land),
                                rig.clock)  # fmt: skip
        rig.ground.send_command = self.on_answer
        self.old_beacons = 0

    def on_answer(self, command):
        self.carry(encode(command.NAME, command.data), self.land)
        return True

    def begin(self, plan="mission"):
        self.transfer = PlanTransfer(
            self.rig.clock, self.send, plan, lambda *told: self.progress.append(told),
            self.endings.append,
        )  # fmt: skip
        return self.transfer

    def send(self, command, id_):
        self.up_names.append(command.NAME)
        beacon = None
        if command.NEEDS_BEACON:
            beacon = self.rig.up.beacons.draw() if not self.old_beacons else 0
            self.old_beacons = max(0, self.old_beacons - 1)
        line = encode(command.NAME, command.data, id_, beacon)
        assert len(line) < 10_000
        self.carry(line, lambda line: self.rig.up.command_receiver.receive(decode(line), self.link))

    def land(self, line):
        self.transfer.on_message(decode(line))

    def carry(self, line, take):
        for chance in (1.0, self.loss):
            if self.random.random() < chance and self.random.random() >= self.loss:
                late_s = WAY_S * (1 + 3 * (self.random.random() < self.loss))
                self.rig.clock.callLater(late_s, take, line)

    def end(self, limit_s=600):
        """Let time pass until the transfer ends; return how."""
        passed = 0.0
        while not self.endings and passed < limit_s:
            self.rig.clock.advance(WAY_S)
            self.rig.settle()
            passed += WAY_S
        self.passed_s = passed
        (outcome,) = self.endings
        return outcome


@pytest.fixture
def rig(tmp_path):
    made = PlansRig(tmp_path)
    made.state(in_flight=False)
    made.navigation.set()
    made.frame()
    return made


def upload(air, data, plan="mission"):
    air.begin(plan).upload(items_of(data, plan))
    return air.end()


def test_a_mission_is_in_use_and_read_back(rig):
    air = Air(rig)
    outcome = upload(air, LONG)
    assert (outcome.code, outcome.items) == ("", tuple(items_of(LONG)))
    assert outcome.plan_id == rig.plans.missions.plan_id == plan_id(items_of(LONG))
    assert rig.plans.missions.items == outcome.items
    assert air.up_names.count("up.mission.part") == 4
    told = [(phase, of) for phase, done, of in air.progress if done == of]
    assert told == [("upload", 75), ("verify", 75)]
    # Three parts are on their way at a time, and three requests after the first answer.
    assert air.passed_s <= 12 * WAY_S


def test_a_fence_goes_in_parts_that_fit_a_line(rig):
    air = Air(rig)
    assert upload(air, FENCE, "fence").code == ""
    assert rig.plans.fences.items == tuple(items_of(FENCE, "fence"))
    assert air.up_names.count("up.mission.part") > 1


@pytest.mark.parametrize("seed", range(5))
def test_loss_repetition_and_reordering_cost_only_time(rig, seed):
    air = Air(rig, loss=0.05, seed=seed)
    outcome = upload(air, LONG)
    assert (outcome.code, rig.plans.missions.items) == ("", tuple(items_of(LONG)))
    air.endings.clear()
    air.begin().download()
    assert air.end().items == outcome.items


def test_without_an_aircraft_it_ends_and_nothing_is_in_use(rig):
    air = Air(rig, loss=1.0)
    outcome = upload(air, SQUARE)
    assert (outcome.code, len(air.up_names)) == ("no_answer", TRIES)
    assert 20 < air.passed_s < 30
    assert rig.plans.missions.items == ()
    assert not rig.clock.getDelayedCalls() or air.transfer._on_end is None


def test_problems_of_the_aircraft_are_collected_and_the_old_plan_stays(rig):
    air = Air(rig)
    upload(air, SQUARE)
    air.endings.clear()
    outcome = upload(air, [*SQUARE[:2], placed(40_000, 0), SQUARE[3]])
    assert (outcome.code, outcome.detail) == ("refused", "plan_invalid")
    assert (3, "too_far") in [(each.item, each.code) for each in outcome.problems]
    assert rig.plans.missions.items == tuple(items_of(SQUARE))


def test_problems_that_arrive_after_the_refusal_are_waited_for(rig):
    air = Air(rig)
    kept = []

    def hold(command):
        kept.append(command)
        rig.clock.callLater(0.5, air.on_answer, command)
        return True

    rig.ground.send_command = hold
    assert upload(air, [placed(40_000, 0)]).problems
    assert len(kept) == 1


def test_a_commit_with_an_old_beacon_is_sent_again_with_a_fresh_one(rig):
    air = Air(rig)
    rig.up.beacons.draw()
    air.old_beacons = 2
    assert upload(air, SQUARE).code == ""
    assert air.up_names.count("up.mission.commit") == 3


def test_parts_that_another_ground_replaced_are_sent_again(rig):
    air = Air(rig)
    receive = rig.up.command_receiver.receive
    others = itertools.count()

    def interfere(message, link):
        if message.name == "up.mission.commit" and next(others) == 0:
            rig.part(LONG)
        receive(message, link)

    rig.up.command_receiver.receive = interfere
    assert upload(air, SQUARE).code == ""
    assert air.up_names.count("up.mission.commit") == 2


def test_an_empty_plan_removes_the_one_in_use(rig):
    air = Air(rig)
    upload(air, SQUARE)
    air.endings.clear()
    outcome = upload(air, [])
    assert (outcome.code, outcome.plan_id, rig.plans.missions.items) == ("", "", ())
    air.endings.clear()
    air.begin().download()
    assert (air.end().code, air.endings[0].items) == ("", ())


def test_a_refused_part_ends_it_with_the_reason(rig):
    air = Air(rig)
    air.link.origin = type(air.link.origin)("test", Role.OBSERVER, 0)
    outcome = upload(air, LONG)
    assert (outcome.code, len(air.endings)) == ("forbidden", 1)


def answered(air, part):
    """Let the aircraft answer every request with one part; return how the transfer ends."""

    def receive(message, link):
        link.is_repeated(message)
        if message.name == MissionRequestCommand.NAME:
            air.on_answer(part)
        link.ack(message.id)

    air.rig.up.command_receiver.receive = receive
    air.begin().download()
    return air.end()


@pytest.mark.parametrize(
    ("part", "code"),
    [
        (MissionPartCommand("mission", "0" * 16, 4, 1, tuple(SQUARE)), "plan_changed"),
        (MissionPartCommand("mission", "0" * 16, 4, 3, tuple(SQUARE)), "unreadable"),
        (MissionPartCommand("mission", "0" * 16, 4, 1, ({"kind": "hover"},)), "unreadable"),
        (MissionPartCommand("mission", "0" * 16, 4, 1, (7,)), "unreadable"),
        (MissionPartCommand("mission", "0" * 16, 4, 1, ()), "no_content"),
        (MissionPartCommand("fence", "0" * 16, 4, 1, ()), "no_content"),
    ],
)
def test_strange_parts_end_it(rig, part, code):
    assert answered(Air(rig), part).code == code


def test_another_plan_in_use_afterwards_is_noticed(rig):
    other = SQUARE[1:]
    part = MissionPartCommand("mission", plan_id(items_of(other)), 3, 1, tuple(other))
    rig.plans.missions.part = lambda request: part
    assert upload(Air(rig), SQUARE).code == "not_equal"
