"""What registered cogs bring, and what happens when they are broken."""

from pathlib import Path

import pytest

from tests.support.application import importable, plan_of, write_application
from up.config import ConfigErrors
from up.loading.discovery import CogImportError

MODULE = "from up.base_module import BaseModule\nclass AModule(BaseModule):\n    pass\n"
COMMAND = (
    "from dataclasses import dataclass\nfrom typing import ClassVar\n"
    "from up.commands.command import BaseCommand\n"
    "@dataclass(frozen=True, slots=True)\nclass ACommand(BaseCommand):\n"
    "    NAME: ClassVar[str] = 'tested.cog.a'\n"
)
LISTED = "tested_cog:\n  modules:\n    - {class_name: AModule, prefix: tested_cog.modules.a}\n"


@pytest.fixture
def load(tmp_path):
    def load(files: dict[str, str], listed: str = LISTED):
        for name, text in {"__init__.py": "", "modules/__init__.py": "", **files}.items():
            path = Path(tmp_path, "cogs/tested_cog", name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        application = write_application(tmp_path / "plane", {"external_modules.yml": listed})
        return plan_of(application)

    with importable(tmp_path / "cogs", "tested_cog"):
        yield load


def test_listed_modules_and_all_commands(load):
    plan = load(
        {
            "modules/a.py": MODULE + "class NotListed(BaseModule):\n    pass\n",
            "commands/__init__.py": "",
            "commands/a.py": COMMAND,
        }
    )
    names = [module.class_name for module in plan.modules]
    assert "AModule" in names and "NotListed" not in names
    assert plan.origins["tested_cog.modules.a.AModule"] == "tested_cog"
    assert [cls.NAME for cls in plan.commands] == ["tested.cog.a"]


def test_a_cog_with_commands_only(load):
    plan = load({"commands/__init__.py": "", "commands/a.py": COMMAND}, "tested_cog: {}\n")
    assert [cls.NAME for cls in plan.commands] == ["tested.cog.a"]


def test_an_old_cog_may_list_recorders(load):
    listed = LISTED + "  recorders:\n    - {class_name: R, prefix: tested_cog.recorders.r}\n"
    assert "AModule" in [
        module.class_name for module in load({"modules/a.py": MODULE}, listed).modules
    ]


@pytest.mark.parametrize(
    ("files", "what"),
    [
        ({"modules/a.py": "x = = 1\n"}, "SyntaxError"),
        ({"modules/a.py": "raise SystemExit('out')\n"}, "SystemExit"),
        ({"modules/a.py": "import nowhere_at_all\n"}, "ModuleNotFoundError"),
        ({"modules/a.py": "pass\n"}, "AttributeError"),
        (
            {"modules/a.py": "class AModule: pass\n"},
            "not_a_module",
        ),
        (
            {"modules/a.py": MODULE, "commands/__init__.py": "x = = 1\n"},
            "SyntaxError",
        ),
        (
            {"modules/a.py": MODULE, "commands/__init__.py": "", "commands/b.py": "1 / 0\n"},
            "ZeroDivisionError",
        ),
        (
            {"modules/a.py": MODULE, "commands/__init__.py": "import nowhere_at_all\n"},
            "ModuleNotFoundError",
        ),
    ],
)
def test_a_broken_cog_stops_the_boot_with_a_sentence(load, files, what):
    with pytest.raises(CogImportError) as error:
        load(files)
    (problem,) = error.value.problems
    assert what in (problem.fields["reason"], problem.code)


@pytest.mark.parametrize(
    ("listed", "place"),
    [
        ("tested_cog: [a]\n", "external_modules.yml:1:13"),
        ("tested_cog:\n  modules:\n    - {class_name: 'A B', prefix: a}\n", ":3:20"),
        ("tested_cog:\n  modules:\n    - {class_name: A, prefix: 'a b'}\n", ":3:31"),
        ("tested_cog:\n  source: somebody\n", ":2:11"),
    ],
)
def test_mistakes_in_the_generated_list_have_their_place(load, listed, place):
    with pytest.raises(ConfigErrors, match=place):
        load({"modules/a.py": MODULE}, listed)
