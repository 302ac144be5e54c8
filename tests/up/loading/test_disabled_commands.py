"""Commands and handlers: disabled by name, broken in every way, with their messages."""

import pytest

from tests.support.application import context_of, plan_of, write_application
from up.commands.servo_command import ServoCommand
from up.loading.checking import check_application

HEAD = (
    "from dataclasses import dataclass\nfrom typing import ClassVar\n"
    "from up.base_module import BaseModule\n"
    "from up.commands.command import BaseCommand\n"
    "from up.commands.base_command_handler import BaseCommandHandler\n"
)
PING = (
    "@dataclass(frozen=True, slots=True)\nclass Ping(BaseCommand):\n"
    "    NAME: ClassVar[str] = 'tested.ping'\n"
)
NAMELESS = "@dataclass(frozen=True, slots=True)\nclass Ping(BaseCommand):\n    pass\n"
HANDLER = (
    "class Hand(BaseCommandHandler):\n    COMMAND = {command}\n    def run_action(self, c): pass\n"
)
BUILT = "    def __init__(self): raise {fault}\n"


def application_of(folder, text, disabled=()):
    name = "tested_commands"
    listed = "".join(f"  - {name}.commands.{each}\n" for each in disabled)
    files = {"commands/all.py": HEAD + text}
    if disabled:
        files["config/disabled_modules.yml"] = f"disabled modules:\n{listed}"
    return write_application(folder, files, name)


def load(folder, text, disabled=()):
    """Return the plan; the check of the application must report the same errors."""
    application = application_of(folder, text, disabled)
    plan = plan_of(application)
    findings = check_application(application, context_of(application))
    assert findings.problems == plan.problems
    assert "module_unknown" not in [warning.code for warning in findings.warnings]
    return plan


def left_out(plan):
    return {each.path.rpartition(".")[2]: each.code for each in plan.rejected}


def test_a_healthy_handler_and_a_healthy_command_can_be_disabled(tmp_path):
    text = PING + HANDLER.format(command="Ping")
    assert len(load(tmp_path, text).handlers) == 1
    plan = load(tmp_path, text, ["all.Hand"])
    assert plan.handlers == []
    assert len(plan.commands) == 1
    assert left_out(plan) == {"Hand": "disabled"}


def test_with_a_command_go_its_handlers(tmp_path):
    plan = load(tmp_path, PING + HANDLER.format(command="Ping"), ["all.Ping"])
    assert (plan.commands, plan.handlers) == ([], [])
    assert left_out(plan) == {"Ping": "disabled", "Hand": "command_not_loaded"}


def test_a_file_of_commands_can_be_disabled_broken_or_not(tmp_path):
    for number, text in enumerate((PING + HANDLER.format(command="Ping"), "x = = 1\n")):
        plan = load(tmp_path / str(number), text, ["all"])
        assert (plan.commands, plan.handlers, plan.problems) == ([], [], [])


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (NAMELESS, "Ping"),
        (PING.replace("tested.ping", "up.servo.update"), "Ping"),
        (HANDLER.format(command="5"), "Hand"),
        (HANDLER.format(command="'a.b'") + BUILT.format(fault="RuntimeError('built')"), "Hand"),
        (HANDLER.format(command="'a.b'") + BUILT.format(fault="SystemExit('out')"), "Hand"),
    ],
)
def test_a_broken_class_can_be_accepted_by_name(tmp_path, text, name):
    (problem,) = load(tmp_path, text).problems
    assert problem.name == f"tested_commands.commands.all.{name}"
    plan = load(tmp_path, text, [f"all.{name}"])
    assert plan.problems == []
    assert left_out(plan) == {name: "disabled"}


def test_a_handler_of_a_broken_command_is_no_second_problem(tmp_path):
    plan = load(tmp_path, NAMELESS + HANDLER.format(command="Ping"))
    assert [problem.name for problem in plan.problems] == ["tested_commands.commands.all.Ping"]
    assert plan.handlers == []


@pytest.mark.parametrize("command", ["5", "BaseModule", "Ping()", "['tested.ping']", "BaseCommand"])
def test_a_handler_of_what_is_no_command_is_named(tmp_path, command):
    plan = load(tmp_path, PING + HANDLER.format(command=command))
    (problem,) = plan.problems
    assert problem.name.endswith(".Hand")
    assert (problem.code, problem.file) == ("handler_invalid", "commands/all.py")
    assert plan.handlers == []


@pytest.mark.parametrize("fault", ["RuntimeError('built')", "SystemExit('built')"])
def test_whatever_building_a_handler_raises_is_named(tmp_path, fault):
    plan = load(tmp_path, HANDLER.format(command="'a.b'") + BUILT.format(fault=fault))
    assert f"{fault.partition('(')[0]}: built" in str(plan.problems[0])


def test_handlers_by_name_and_of_built_in_commands_are_fine(tmp_path):
    for number, command in enumerate(("'up.servo.update'", "'nobody.knows'")):
        plan = load(tmp_path / str(number), HANDLER.format(command=command))
        assert (len(plan.handlers), plan.problems) == (1, [])
    text = f"from {ServoCommand.__module__} import ServoCommand\n"
    plan = load(tmp_path / "class", text + HANDLER.format(command="ServoCommand"))
    assert plan.handlers[0].COMMAND is ServoCommand


def test_what_is_not_there_to_be_disabled_is_said(tmp_path):
    application = application_of(tmp_path, PING, ["all.Pong", "nowhere"])
    warnings = check_application(application, context_of(application)).warnings
    assert [each.fields["name"] for each in warnings if each.code == "module_unknown"] == [
        "tested_commands.commands.all.Pong",
        "tested_commands.commands.nowhere",
    ]
