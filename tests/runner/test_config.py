"""runner.yml and its meaning."""

from dataclasses import replace
from pathlib import Path

import pytest

from up.config import ConfigErrors
from up_runner.config import RUNNER, RunnerConfig
from up_runner.paths import Paths, own_root
from up_runner.policy import policy_of
from up_runner.pool_config import PoolConfig

HERE = Path("runner.yml")


def test_the_template_holds_the_defaults():
    assert RUNNER.parse(RUNNER.template(), HERE) == RunnerConfig() == RUNNER.parse("", HERE)
    config = RunnerConfig()
    assert (config.port, config.exit_delay_s, config.mode) == (3002, 60.0, "black box")
    assert config.exit_on_connection_lost and not config.i_accept_plain


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("prot: 1\n", "prot"),
        ("port: 70000\n", "port"),
        ("settable: {external_modules.yml: [a]}\n", "settable"),
        ("settable: {a.yml: ['script path']}\n", "settable"),
        ("settable: {a.yml: ['general port']}\n", "settable"),
        ("settable: {../a.yml: [b]}\n", "settable"),
        ("dynamic ports: {a/b.yml: [c]}\n", "dynamic ports"),
        ("learned files: [.hidden.yml]\n", "learned files"),
        ("autostart: {aircraft: ../x}\n", "autostart"),
    ],
)
def test_an_error_has_its_line_and_key(text, key):
    with pytest.raises(ConfigErrors) as caught:
        RUNNER.parse(text, HERE)
    assert str(caught.value).startswith("runner.yml:1:")
    assert key in str(caught.value)


@pytest.mark.parametrize(
    ("key", "value"),
    [("s3_bucket", "Up"), ("s3_bucket", "a/b"), ("s3_endpoint", "s3.example.org"),
     ("s3_region", "eu-north-1"), ("s3_credentials", "s3.txt"), ("s3_endpoint", "https://a/b"),
     ("s3_endpoint", "http://[::1"), ("s3_endpoint", "http://a:99999"), ("s3_endpoint", "http://.")],
)  # fmt: skip
def test_s3_needs_a_bucket_and_the_address_of_a_service(key, value):
    pool = PoolConfig(servers="nats://a", address="here", **{key: value})
    assert {name for name, _ in pool.problems()} == {key}


def test_only_a_black_box_stops_with_its_phone_or_is_given_up():
    black_box = policy_of(RunnerConfig())
    assert black_box.exit_delay_s == 60.0 and not black_box.always_restart
    assert black_box.restarts.limit == 5
    assert policy_of(RunnerConfig(exit_on_connection_lost=False)).exit_delay_s is None
    for mode in ("flight controller", "auto"):
        policy = policy_of(RunnerConfig(mode=mode))
        assert policy.exit_delay_s is None and policy.always_restart
    pool = PoolConfig(servers="nats://a", address="here")
    in_pool = RunnerConfig(pool=pool, exit_on_connection_lost=False)
    sleeper = policy_of(in_pool)
    assert (sleeper.sleeps, sleeper.exit_delay_s) == (True, 4 * 3600)
    assert not policy_of(replace(in_pool, exit_on_connection_lost=True)).sleeps
    assert not policy_of(replace(in_pool, pool=replace(pool, sleep_after_s=0))).sleeps
    for mode in ("flight controller", "auto"):
        policy = policy_of(replace(in_pool, mode=mode))
        assert not policy.sleeps and policy.exit_delay_s is None
    assert policy_of(RunnerConfig(watchdog_s=0)).watchdog_s is None


def test_paths_by_default(tmp_path):
    paths = Paths.of(RunnerConfig(), tmp_path, {}, 7)
    assert paths.base == tmp_path / "blackbox"
    assert paths.profiles == tmp_path / "profiles"
    assert paths.run == paths.instances == Path("/tmp/up-runner-7")
    assert paths.logs == Path("/tmp/up-runner-7/.logs")
    assert paths.root == own_root() and paths.script is None
    assert Paths.of(RunnerConfig(mode="auto"), tmp_path, {}, 7).base == tmp_path


def test_a_service_managers_folders_are_used(tmp_path):
    environ = {
        "RUNTIME_DIRECTORY": "/run/up-runner",
        "STATE_DIRECTORY": "/var/lib/up-runner",
        "LOGS_DIRECTORY": "/var/log/up-runner",
    }
    paths = Paths.of(RunnerConfig(), tmp_path, environ, 7)
    assert paths.run == Path("/run/up-runner")
    assert paths.instances == Path("/var/lib/up-runner")
    assert paths.logs == Path("/var/log/up-runner")


def test_configured_paths_come_first(tmp_path):
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
    assert Paths.of(config, tmp_path, {"STATE_DIRECTORY": "/x"}, 7) == Paths(
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
