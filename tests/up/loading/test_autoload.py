"""A new file in a folder is enough; a bad one does not affect others and is named."""

from pathlib import Path

import pytest

from tests.support.application import plan_of, write_application
from tests.up.commands.samples import Log
from up.context import Context
from up.loading.plan import LoadProblem, Plan
from up.mode import Mode
from up.testing import StillClock
from up.up import Up

GOOD = "from up.base_module import BaseModule\n\n\nclass GoodModule(BaseModule):\n    pass\n"


@pytest.fixture
def load(tmp_path: Path):
    def load(files: dict[str, str], binary: dict[str, bytes] | None = None) -> Plan:
        files = {"modules/good.py": GOOD, **files}
        application = write_application(tmp_path, files)
        for name, data in (binary or {}).items():
            (tmp_path / name).write_bytes(data)
        plan = plan_of(application)
        assert "GoodModule" in names(plan), "a bad file must not keep a good one out"
        return plan

    return load


def names(plan: Plan) -> list[str]:
    return [module.class_name for module in plan.modules if module.path.startswith("tested_")]


def only_problem(plan: Plan) -> LoadProblem:
    (problem,) = plan.problems
    return problem


@pytest.mark.parametrize("folder", ["modules", "flight_controller", "commands"])
def test_a_new_file_is_enough(load, folder):
    plan = load({f"{folder}/new.py": GOOD.replace("Good", "New")})
    assert sorted(names(plan)) == ["GoodModule", "NewModule"]
    assert not plan.problems
    assert plan.origins[plan.modules[-1].path]


def test_a_new_command_with_its_handler_is_enough(load):
    plan = load(
        {
            "commands/ping.py": (
                "from dataclasses import dataclass\n"
                "from typing import ClassVar\n"
                "from up.commands.command import BaseCommand\n"
                "from up.commands.base_command_handler import BaseCommandHandler\n"
                "@dataclass(frozen=True, slots=True)\n"
                "class PingCommand(BaseCommand):\n"
                "    NAME: ClassVar[str] = 'tested.ping'\n"
                "class PingHandler(BaseCommandHandler):\n"
                "    COMMAND = PingCommand\n"
                "    def run_action(self, command): pass\n"
            )
        }
    )
    assert [cls.NAME for cls in plan.commands] == ["tested.ping"]
    assert [handler.COMMAND for handler in plan.handlers] == plan.commands
    assert not plan.problems


def test_two_classes_in_a_file_are_both_loaded(load):
    plan = load({"modules/two.py": GOOD.replace("Good", "A") + GOOD.replace("Good", "B")})
    assert sorted(names(plan)) == ["AModule", "BModule", "GoodModule"]


def test_helpers_beside_modules_are_left_alone(load, tmp_path):
    plan = load(
        {
            "modules/filters.py": "class LowPass:\n    alpha = 0.4\n",
            "modules/_private.py": "raise RuntimeError('nobody imports this')\n",
            "modules/inner/__init__.py": "raise RuntimeError('nobody imports this')\n",
            "modules/user.py": (
                "from up.base_module import BaseModule\n"
                "from .filters import LowPass\n"
                "class UserModule(BaseModule):\n    alpha = LowPass.alpha\n"
                "class _HiddenModule(BaseModule):\n    pass\n"
            ),
        }
    )
    assert sorted(names(plan)) == ["GoodModule", "UserModule"]
    assert not plan.problems


def test_an_imported_class_belongs_to_the_file_that_defines_it(load):
    plan = load({"modules/second.py": "from .good import GoodModule\n"})
    assert names(plan) == ["GoodModule"]


def test_an_abstract_class_is_a_base_for_others(load):
    plan = load(
        {
            "modules/sensors.py": (
                "from abc import ABC, abstractmethod\n"
                "from up.base_module import BaseModule\n"
                "class BaseSensor(BaseModule, ABC):\n"
                "    @abstractmethod\n    def read(self): ...\n"
                "class Sensor(BaseSensor):\n    def read(self): return 1\n"
            )
        }
    )
    assert sorted(names(plan)) == ["GoodModule", "Sensor"]


def test_files_that_are_not_python_are_left_alone(load, tmp_path):
    (tmp_path / "modules" / "folder.py").mkdir(parents=True)
    plan = load(
        {
            "modules/.DS_Store": "\0\1",
            "modules/.hidden.py": "raise RuntimeError\n",
            "modules/notes.txt": "not Python",
            "modules/good.py.orig": "not Python either (",
            "modules/good.pyc": "\0",
        }
    )
    assert names(plan) == ["GoodModule"]
    assert not plan.problems


def test_a_syntax_error_is_named_with_its_line(load, tmp_path):
    plan = load({"modules/broken.py": "import os\n\n\ndef f(:\n    pass\n"})
    problem = only_problem(plan)
    assert (problem.code, problem.line) == ("syntax_error", 4)
    assert problem.file == str(tmp_path / "modules/broken.py")
    assert problem.name.endswith(".modules.broken")


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("import nothing_of_that_name\n", "nothing_of_that_name"),
        ("x = 1\nx.y\n", "AttributeError"),
        ("raise RuntimeError('in the import')\n", "RuntimeError: in the import"),
        ("def f(): f()\nf()\n", "RecursionError"),
        ("import sys\nsys.exit('out')\n", "SystemExit: out"),
        ("from up.base_module import BaseModul\n", "ImportError"),
        ("class A(1): pass\n", "TypeError"),
    ],
)
def test_whatever_an_import_raises_is_named(load, tmp_path, text, what):
    plan = load({"modules/broken.py": text})
    problem = only_problem(plan)
    assert (problem.code, problem.file) == ("import_failed", str(tmp_path / "modules/broken.py"))
    assert problem.line and what in problem.what


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", b"x = '\xe9'\n", b"x = 1\0\n"])
def test_bytes_that_are_no_source_are_named(load, tmp_path, data):
    plan = load({}, {"modules/broken.py": data})
    assert str(tmp_path / "modules/broken.py") in only_problem(plan).file


def test_a_link_to_nowhere_and_a_name_that_cannot_be_imported_are_named(load, tmp_path):
    (tmp_path / "modules").mkdir()
    (tmp_path / "modules/gone.py").symlink_to(tmp_path / "nothing.py")
    plan = load({"modules/my-module.py": GOOD})
    assert {problem.name.rpartition(".")[2] for problem in plan.problems} == {"gone", "my-module"}


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ("    def __init__(self): raise RuntimeError('built')\n", "RuntimeError: built"),
        ("    def __init__(self, more): pass\n", "TypeError"),
        ("    def load(self): return 1 / 0\n", "ZeroDivisionError"),
        ("    def load(self): raise SystemExit\n", "SystemExit"),
    ],
)
def test_a_class_that_cannot_be_built_is_named(load, tmp_path, body, what):
    plan = load(
        {"modules/bad.py": f"from up.base_module import BaseModule\nclass Bad(BaseModule):\n{body}"}
    )
    assert only_problem(plan).code == "build_failed"
    assert what in only_problem(plan).what
    assert plan.problems[0].name.endswith(".modules.bad.Bad")
    assert names(plan) == ["GoodModule"]


def test_what_is_broken_is_an_arming_veto_by_name(load, tmp_path):
    plan = load({"modules/broken.py": "x = = 1\n"})
    with Log() as log:
        up = Up(plan, Context(StillClock(), Mode.AUTO, tmp_path))
    assert [veto for veto in up.vetoes.own if ".modules.broken" in veto]
    (event,) = log.of("load_problem")
    assert (event["reason"], event["line"]) == ("syntax_error", 1)
    assert event["file"] == str(tmp_path / "modules/broken.py")


def test_a_broken_file_can_be_accepted_by_name(tmp_path):
    files = {
        "modules/broken.py": "x = = 1\n",
        "config/disabled_modules.yml": "disabled modules:\n  - accepting.modules.broken\n",
    }
    assert plan_of(write_application(tmp_path, files, "accepting")).problems == []


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("class Nameless(BaseCommand):\n    pass\n", "has no NAME"),
        (
            "class Again(BaseCommand):\n    NAME: ClassVar[str] = 'up.altitude.change'\n",
            "up.altitude.change",
        ),
        (
            "class Odd(BaseCommand):\n    NAME: ClassVar[str] = 'a.b'\n    x: 'Nowhere' = 1\n",
            "Nowhere",
        ),
    ],
)
def test_a_command_that_cannot_be_registered_is_named(load, text, what):
    head = (
        "from dataclasses import dataclass\nfrom typing import ClassVar\n"
        "from up.commands.command import BaseCommand\n@dataclass(frozen=True)\n"
    )
    plan = load({"commands/bad.py": head + text})
    assert only_problem(plan).code == "command_invalid"
    assert what in only_problem(plan).what
    assert plan.commands == []
