"""runner.yml and its meaning."""

from pathlib import Path

import pytest

from up.config import ConfigErrors
from up_runner.config import RUNNER, RunnerConfig
from up_runner.places import Places, own_root
from up_runner.runner import policy_of

HERE = Path("runner.yml")


def test_the_template_holds_the_defaults():
    assert RUNNER.parse(RUNNER.template(), HERE) == RunnerConfig() == RUNNER.parse("", HERE)
    config = RunnerConfig()
    assert (config.port, config.exit_delay_s, config.mode) == (3002, 60.0, "black box")
    assert config.exit_on_connection_lost and not config.i_accept_plain


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("prot: 1\n", "did you mean 'port'?"),
        ("port: 70000\n", "port: must be a whole number between 0 and 65535"),
        ("settable: {external_modules.yml: [a]}\n", "may never set anything of"),
        ("settable: {a.yml: ['script path']}\n", "may never set a path, port or address"),
        ("settable: {a.yml: ['general port']}\n", "may never set a path, port or address"),
        ("settable: {../a.yml: [b]}\n", "is not the name of a YAML file"),
        ("dynamic ports: {a/b.yml: [c]}\n", "is not the name of a YAML file"),
        ("learned files: [.hidden.yml]\n", "is not the name of a YAML file"),
        ("autostart: {aircraft: ../x}\n", "aircraft is not a name"),
    ],
)
def test_mistakes_are_told_with_their_place(text, problem):
    with pytest.raises(ConfigErrors) as caught:
        RUNNER.parse(text, HERE)
    assert str(caught.value).startswith("runner.yml:1:")
    assert problem in str(caught.value)


def test_only_a_black_box_stops_with_its_phone_or_is_given_up():
    black_box = policy_of(RunnerConfig())
    assert black_box.exit_delay_s == 60.0 and not black_box.always_restart
    assert black_box.restarts.limit == 5
    assert policy_of(RunnerConfig(exit_on_connection_lost=False)).exit_delay_s is None
    for mode in ("flight controller", "auto"):
        policy = policy_of(RunnerConfig(mode=mode))
        assert policy.exit_delay_s is None and policy.always_restart
        assert policy.restarts.limit is None
    assert policy_of(RunnerConfig(watchdog_s=0)).watchdog_s is None


def test_places_by_default(tmp_path):
    places = Places.of(RunnerConfig(), tmp_path, {}, 7)
    assert places.base == tmp_path / "blackbox"
    assert places.profiles == tmp_path / "profiles"
    assert places.run == places.instances == Path("/tmp/up-runner-7")
    assert places.logs == Path("/tmp/up-runner-7/.logs")
    assert places.root == own_root() and places.script == own_root() / "main.py"
    assert Places.of(RunnerConfig(mode="auto"), tmp_path, {}, 7).base == tmp_path


def test_a_service_managers_folders_are_used(tmp_path):
    environ = {
        "RUNTIME_DIRECTORY": "/run/up-runner",
        "STATE_DIRECTORY": "/var/lib/up-runner",
        "LOGS_DIRECTORY": "/var/log/up-runner",
    }
    places = Places.of(RunnerConfig(), tmp_path, environ, 7)
    assert places.run == Path("/run/up-runner")
    assert places.instances == Path("/var/lib/up-runner")
    assert places.logs == Path("/var/log/up-runner")


def test_configured_places_come_first(tmp_path):
    config = RunnerConfig(
        application_root="/opt/app",
        script_path="fly.py",
        python="/usr/bin/python3",
        instance_config="base",
        profiles_folder="/srv/profiles",
        run_folder="/run/mine",
        instances_folder="/srv/instances",
        logs_folder="/srv/logs",
    )
    assert Places.of(config, tmp_path, {"STATE_DIRECTORY": "/x"}, 7) == Places(
        root=Path("/opt/app"),
        script=Path("/opt/app/fly.py"),
        python=Path("/usr/bin/python3"),
        base=tmp_path / "base",
        profiles=Path("/srv/profiles"),
        run=Path("/run/mine"),
        instances=Path("/srv/instances"),
        logs=Path("/srv/logs"),
    )


def test_the_shipped_file_is_the_template():
    shipped = Path(__file__).parents[2] / "config" / RUNNER.filename
    assert shipped.read_text("utf-8") == RUNNER.template()
