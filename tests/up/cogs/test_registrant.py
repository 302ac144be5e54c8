"""A Registrant enters its cog's modules and creates configuration; mistakes are one sentence."""

import json
import sys
from pathlib import Path

import pytest

from tests.support.application import importable, plan_of, write_application
from tests.support.virtual_environment import REPOSITORY
from tests.up.config.samples import places
from up.cogs.cog import CogError, package_name
from up.cogs.registration import find_registrant, register, unregister
from up.cogs.registry import Registry
from up.config import ConfigErrors

TREE = REPOSITORY / "tests/fixtures/cogs/tree"
OLD = REPOSITORY / "tests/fixtures/cogs/prototype_cog"


@pytest.fixture
def application(tmp_path):
    return write_application(tmp_path / "application", {})


@pytest.fixture
def said(monkeypatch, capsys):
    """Return a function that returns the code and fields of each line since its last call."""
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    return lambda: [json.loads(line)["fields"] for line in capsys.readouterr().out.splitlines()]


@pytest.fixture
def alpha():
    with importable(TREE / "alpha_cog", "alpha_cog"):
        yield


@pytest.fixture
def prototype():
    with importable(OLD, "prototype_cog"):
        yield


@pytest.fixture
def cog(tmp_path):
    """Return a function that writes a package odd_cog and lets it be imported."""
    folder = tmp_path / "cogs" / "odd_cog"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("")

    def write(**files: str) -> Path:
        for name, text in files.items():
            (folder / name.replace("__", ".")).write_text(text)
        return folder

    with importable(folder.parent, "odd_cog"):
        yield write


REGISTRAR = "from up.cogs.up_registrant import UpRegistrant\nclass Registrant(UpRegistrant): pass\n"


def test_registering_enters_creates_and_says_so(application, alpha, said):
    register("alpha_cog", application, "manual")
    entry = Registry(application.root).entries()["alpha_cog"]
    assert [each.path for each in entry.modules] == ["alpha_cog.modules.alpha_module.AlphaModule"]
    assert entry.source == "manual"
    config = application.config_folder / "alpha.yml"
    assert "interval_s: 1.0" in config.read_text()
    assert said() == [
        {"code": "cog_registered", "cog": "alpha_cog", "changed": True},
        {"code": "created", "cog": "alpha_cog", "path": str(config)},
    ]
    assert "AlphaModule" in [module.class_name for module in plan_of(application).modules]


def test_configuration_is_never_overwritten(application, alpha, said):
    config = application.config_folder / "alpha.yml"
    config.parent.mkdir()
    config.write_text("interval_s: 5\n")
    register("alpha_cog", application, "manual")
    register("alpha_cog", application, "manual")
    assert config.read_text() == "interval_s: 5\n"
    assert [each["changed"] for each in said()] == [True, False]


def test_a_closed_pipe_is_not_a_fault_of_the_cog(application, alpha, monkeypatch):
    def write(text):
        raise BrokenPipeError

    monkeypatch.setattr(sys.stdout, "write", write)
    with pytest.raises(BrokenPipeError):
        register("alpha_cog", application, "manual")


def test_unregistering_leaves_the_configuration(application, alpha):
    register("alpha_cog", application, "manual")
    assert unregister("alpha_cog", application)
    assert not unregister("alpha_cog", application)
    assert Registry(application.root).entries() == {}
    assert (application.config_folder / "alpha.yml").exists()


def test_a_cog_of_the_prototype_registers_loads_and_works(
    application, prototype, capfd, tmp_path, monkeypatch
):
    bystander = write_application(tmp_path / "bystander", {})
    monkeypatch.chdir(bystander.root)
    register("prototype_cog", application, "manual")
    register("prototype_cog", application, "manual")
    heard = capfd.readouterr().out
    assert (
        heard.count("prototype_cog: registered") == heard.count("prototype_cog: is registered") == 1
    )
    assert (application.config_folder / "prototype.yml").read_text() == "interval: 1\n"
    assert "recorders" in heard
    assert Registry(bystander.root).entries() == {}, "where it is run from does not matter"
    plan = plan_of(application)
    assert not plan.problems
    names = [module.class_name for module in plan.modules]
    assert {"OldClockModule", "OldSwitchModule"} <= set(names)


def test_modules_of_the_prototype_live_through_all_phases(tmp_path, prototype):
    from prototype_cog.modules.old_clock_module import OldClockModule
    from prototype_cog.modules.old_switch_module import OldSwitchModule

    from up.commands.origin import INTERNAL
    from up.commands.panic_command import PanicCommand
    from up.testing import Bench

    bench = Bench(OldClockModule, OldSwitchModule, config_folder=tmp_path)
    bench.start()
    module = bench.module(OldClockModule)
    assert module.started and module.is_a("BaseStartedModule")
    bench.up.command_executor.adopt_thread()
    bench.up.command_executor.execute_command(PanicCommand(True, 150), INTERNAL)
    bench.advance(0.1)
    assert module.heard == ["up.panic"]
    assert module.telemetry_content == {"old_clock": {"heard": 1}}
    bench.stop()
    assert not module.started


def test_a_cog_without_a_name_or_a_registrar_is_one_sentence(application, cog):
    for name, code in (("nobody_cog", "not_installed"), ("odd_cog", "registrar_missing")):
        with pytest.raises(CogError) as error:
            register(name, application, "manual")
        assert error.value.code == code
    with pytest.raises(CogError):
        package_name("../up")
    assert package_name("android-cog") == "android_cog"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("x = = 1\n", "import_failed"),
        ("import not_there_at_all\n", "import_failed"),
        ("raise RuntimeError('no')\n", "import_failed"),
        ("class Registrant: pass\n", "registrant_missing"),
        (
            REGISTRAR.replace("pass", "\n    def prepare(self, application): 1 / 0"),
            "registrant_failed",
        ),
        (
            "from up.registrar import UpRegistrar\nclass Registrar(UpRegistrar):\n"
            "    def __init__(self): super().__init__('odd_cog')\n"
            "    def register(self): return False\n",
            "registrant_failed",
        ),
    ],
)
def test_a_broken_registrant_is_one_sentence(application, cog, text, code):
    cog(registrar__py=text, registered_modules__yml="modules: []\n")
    with pytest.raises(CogError) as error:
        register("odd_cog", application, "manual")
    assert error.value.code == code


def test_a_missing_manifest_is_told_with_the_way_out(application, cog):
    cog(registrar__py=REGISTRAR)
    with pytest.raises(CogError) as error:
        register("odd_cog", application, "manual")
    assert error.value.code == "manifest_missing"


def test_mistakes_in_a_manifest_have_their_place(application, cog):
    folder = cog(
        registrar__py=REGISTRAR,
        registered_modules__yml="modules:\n  - class_name: A B\n    prefix: odd_cog..x\n  - {}\n",
    )
    with pytest.raises(ConfigErrors) as errors:
        register("odd_cog", application, "manual")
    assert errors.value.problems[0].path == folder / "registered_modules.yml"
    assert [places(each) for each in errors.value.problems][:3] == [
        "2:17 bad_format modules[0].class_name",
        "3:13 bad_format modules[0].prefix",
        "4:5 bad_format modules[1].class_name",
    ]


def test_a_manifest_that_would_stop_the_boot_is_not_entered(application, cog):
    cog(
        registrar__py=REGISTRAR,
        registered_modules__yml="modules:\n  - {class_name: A, prefix: odd_cog.modules.a}\n",
    )
    with pytest.raises(CogError) as error:
        register("odd_cog", application, "manual")
    assert error.value.code == "import_failed"
    assert Registry(application.root).entries() == {}


def test_the_thesis_name_comes_before_the_prototypes(cog):
    cog(registrar__py=REGISTRAR + "class Registrar(UpRegistrant): pass\n")
    assert find_registrant("odd_cog").__name__ == "Registrant"
