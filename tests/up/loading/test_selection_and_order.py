from pathlib import Path

import pytest

from tests.support.application import context_of, plan_of, write_application
from up.loading.discovery import CogImportError
from up.loading.plan import BootError, Plan
from up.mode import Mode
from up.up_loader import UpLoader

HEAD = (
    "from up.base_module import BaseModule\n"
    "from up.needs import needs, wants\n"
    "from up.mode import WITH_BOARD, Mode\n"
    "from up.providers.up_altitude_provider import UpAltitudeProvider\n"
)


def plan(root: Path, classes: str, mode: Mode = Mode.AUTO, **files: str) -> Plan:
    files = {f"config/{name}.yml": text for name, text in files.items()}
    application = write_application(root, {"modules/all.py": HEAD + classes, **files})
    return plan_of(application, mode)


def own(found: Plan) -> list[str]:
    return [module.class_name for module in found.modules if module.path.startswith("tested_")]


def reasons(found: Plan) -> dict[str, str]:
    return {each.path.rpartition(".")[2]: each.code for each in found.rejected}


def test_load_decides_and_may_look_at_the_mode(tmp_path):
    classes = (
        "class No(BaseModule):\n    def load(self): return False\n"
        "class OnlyBox(BaseModule):\n"
        "    def load(self): return self.context.mode is Mode.BLACK_BOX\n"
        "class Flying(BaseModule):\n    MODES = WITH_BOARD\n"
    )
    flying = plan(tmp_path, classes)
    assert own(flying) == ["Flying"]
    assert reasons(flying) == {
        "No": "load_false",
        "OnlyBox": "load_false",
    }
    assert own(plan(tmp_path, classes, Mode.BLACK_BOX)) == ["OnlyBox"]


def test_what_is_not_for_the_mode_is_not_even_built(tmp_path):
    classes = (
        "class Flying(BaseModule):\n    MODES = WITH_BOARD\n"
        "    def __init__(self): raise RuntimeError\n"
    )
    assert not plan(tmp_path, classes, Mode.BLACK_BOX).problems
    assert plan(tmp_path, classes).problems


def test_a_module_of_another_board_is_left_out_with_those_that_need_it(tmp_path):
    classes = (
        "class One(BaseModule):\n    FLIGHT_CONTROLLERS = frozenset({'msp'})\n"
        "class Two(BaseModule):\n    FLIGHT_CONTROLLERS = frozenset({'arduino', 'raspberry'})\n"
        "class OfOne(BaseModule):\n    one = needs(One)\n"
        "class OfTwo(BaseModule):\n    of = needs(Two)\n"
        "class Both(BaseModule):\n    one, two = wants(One), wants(Two)\n"
    )
    found = plan(tmp_path, classes)
    assert own(found) == ["Two", "OfTwo", "Both"] and not found.problems
    assert reasons(found) == {"One": "other_board", "OfOne": "other_board"}
    found = plan(tmp_path, classes, config="flight controller: msp\n")
    assert own(found) == ["One", "OfOne", "Both"] and not found.problems


def test_the_disabled_list_holds_for_built_in_modules_too(tmp_path):
    name = "up.providers.up_altitude_provider.UpAltitudeProvider"
    found = plan(tmp_path, "", disabled_modules=f"disabled modules:\n  - {name}\n")
    assert name not in [module.path for module in found.modules]
    assert reasons(found)["UpAltitudeProvider"] == "disabled"


def test_an_extension_replaces_whatever_the_depth_of_the_chain(tmp_path):
    found = plan(
        tmp_path,
        "class Middle(UpAltitudeProvider): pass\nclass Last(Middle): pass\n",
    )
    assert own(found) == ["Last"]
    assert reasons(found) == {"UpAltitudeProvider": "replaced", "Middle": "replaced"}


def conflict(error):
    """Return the base and the modules of the one conflict."""
    (problem,) = error.value.problems
    assert problem.code == "replacement_conflict"
    return problem.fields["base"], [each.rpartition(".")[2] for each in problem.fields["modules"]]


def test_two_unrelated_replacements_are_an_error_that_names_both(tmp_path):
    classes = "class One(UpAltitudeProvider): pass\nclass Two(UpAltitudeProvider): pass\n"
    with pytest.raises(BootError) as error:
        plan(tmp_path, classes)
    assert conflict(error) == ("UpAltitudeProvider", ["One", "Two"])


def test_the_nearest_base_of_a_conflict_is_named_whatever_the_order_of_files(tmp_path):
    heirs = "class Middle(Base): pass\nclass One(Middle): pass\nclass Two(Middle): pass\n"
    files = {
        "modules/a.py": "from .z import Base\n" + heirs,
        "modules/z.py": HEAD + "class Base(BaseModule): pass\n"
        "class Fine(BaseModule): pass\nclass Finer(Fine): pass\n",
    }
    with pytest.raises(BootError) as error:
        plan_of(write_application(tmp_path, files))
    assert conflict(error) == ("Middle", ["One", "Two"])


@pytest.mark.parametrize(
    "base",
    [
        "class _Base(BaseModule): pass\n",
        "class _Base(BaseModule):\n    def load(self): return type(self) is not _Base\n",
        "class Base(BaseModule):\n    def load(self): return type(self) is not Base\n"
        "_Base = Base\n",
    ],
)
def test_a_base_that_is_never_loaded_itself_is_shared_freely(tmp_path, base):
    assert own(plan(tmp_path, base + "class A(_Base): pass\nclass B(_Base): pass\n")) == ["A", "B"]


def test_a_disabled_sibling_ends_the_conflict(tmp_path):
    classes = "class Base(BaseModule): pass\nclass One(Base): pass\nclass Two(Base): pass\n"
    files = {
        "modules/all.py": HEAD + classes,
        "config/disabled_modules.yml": "disabled modules: [tested_siblings.modules.all.Two]\n",
    }
    assert own(plan_of(write_application(tmp_path, files, "tested_siblings"))) == ["One"]


def test_what_is_needed_comes_before_and_load_order_breaks_ties(tmp_path):
    found = plan(
        tmp_path,
        "class C(BaseModule):\n    LOAD_ORDER = -5\n    pass\n"
        "class A(BaseModule): pass\n"
        "class B(BaseModule):\n    LOAD_ORDER = -9\n    a = needs(A)\n    c = wants(C)\n"
        "class D(BaseModule):\n    LOAD_ORDER = -9\n",
    )
    assert own(found) == ["D", "C", "A", "B"]
    b = found.modules[[module.class_name for module in found.modules].index("B")]
    assert (b.a.class_name, b.c.class_name) == ("A", "C")


@pytest.mark.parametrize(
    ("body", "mode", "disabled", "why"),
    [
        ("pass", Mode.AUTO, "Line", "listed in disabled_modules.yml"),
        ("MODES = WITH_BOARD", Mode.BLACK_BOX, "", "not for the mode 'black box'"),
        ("def load(self): return False", Mode.AUTO, "", "its load() returned False"),
        ("def __init__(self): raise OSError('cold')", Mode.AUTO, "", "OSError: cold"),
    ],
)
def test_a_missing_need_says_why_it_is_not_loaded(tmp_path, body, mode, disabled, why):
    name = f"tested_why_{abs(hash(body))}"
    classes = (
        f"class Wide(BaseModule, ABC):\n    @abstractmethod\n    def f(self): ...\n"
        f"class Line(Wide):\n    f = None\n    {body}\n"
        "class User(BaseModule):\n    line = needs(Line)\n"
        "class Other(BaseModule):\n    line = needs(Wide)\n"
    )
    files = {"modules/all.py": "from abc import ABC, abstractmethod\n" + HEAD + classes}
    if disabled:
        listed = f"disabled modules: [{name}.modules.all.{disabled}]\n"
        files["config/disabled_modules.yml"] = listed
    with pytest.raises(BootError) as error:
        plan_of(write_application(tmp_path, files, name), mode)
    for problem, user in zip(error.value.problems, ("User", "Other"), strict=True):
        assert problem.code == "need_missing"
        assert problem.fields["module"] == f"{name}.modules.all.{user}"
        assert problem.fields["reasons"] == [f"{name}.modules.all.Line: {why}"]


def test_a_need_that_nobody_brings_is_a_cogs(tmp_path):
    classes = "class _Absent(BaseModule): pass\nclass B(BaseModule):\n    a = needs(_Absent)\n"
    with pytest.raises(BootError) as error:
        plan(tmp_path, classes)
    (problem,) = error.value.problems
    assert (problem.code, problem.fields["reasons"]) == ("need_missing", [])


def test_a_circle_is_one_sentence(tmp_path):
    classes = (
        "class A(BaseModule): pass\nclass B(BaseModule):\n    a = needs(A)\n"
        "A.b = needs(B)\nA.b.__set_name__(A, 'b')\n"
    )
    with pytest.raises(BootError) as error:
        plan(tmp_path, classes)
    assert (error.value.code, error.value.fields["modules"]) == ("need_circle", ["A", "B", "A"])


def test_every_cog_that_cannot_be_imported_is_named_with_the_way_out(tmp_path):
    application = write_application(
        tmp_path,
        {
            "external_modules.yml": (
                "gone_cog:\n  modules:\n    - {class_name: A, prefix: gone_cog.modules.a}\n"
                "other_cog:\n  modules:\n    - {class_name: B, prefix: other_cog.modules.b}\n"
                "json:\n  modules:\n    - {class_name: JSONDecoder, prefix: json.decoder}\n"
            )
        },
    )
    with pytest.raises(CogImportError) as error:
        UpLoader(application, context_of(application)).plan()
    assert [(each.code, each.fields["cog"]) for each in error.value.problems] == [
        ("cog_import_failed", "gone_cog"),
        ("cog_import_failed", "other_cog"),
        ("not_a_module", "json"),
    ]
