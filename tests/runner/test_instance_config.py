"""Base, profile and request make one configuration folder."""

import contextlib
from dataclasses import replace

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from up.config.keys_file import KEYS, add_key, revoke_key
from up_runner.instance_config import ConfigurationRefused, InstanceConfig
from up_runner.request import Request


@pytest.fixture
def config(tmp_path):
    (tmp_path / "base").mkdir()
    (tmp_path / "profiles" / "cub").mkdir(parents=True)
    return InstanceConfig(
        tmp_path / "base",
        tmp_path / "profiles",
        settable={"load_guard.yml": ("interval",), "new.yml": ("name",)},
        dynamic_ports={"android.yml": ("general port",)},
        persisted=("pids.yml",),
    )


@contextlib.contextmanager
def refused(code, part=""):
    with pytest.raises(ConfigurationRefused) as error:
        yield
    assert error.value.problem.code == code
    assert part in str(error.value)


def build(config, tmp_path, *arguments):
    folder = config.build(Request("a", *arguments), tmp_path / "a")
    return {path.name: path.read_text() for path in folder.iterdir()}


def read(text):
    return yaml.safe_load(text)


def test_without_anything_only_the_ports_are_set(config, tmp_path):
    built = build(config, tmp_path)
    assert {name: read(text) for name, text in built.items()} == {
        "android.yml": {"general port": 0}
    }


def test_an_untouched_file_is_copied_byte_for_byte(config, tmp_path):
    text = "# a comment\nremote_server: {url: 'x'}   # another\n"
    (config.base / "mission_control.yml").write_text(text)
    assert build(config, tmp_path)["mission_control.yml"] == text


def test_an_instance_reads_the_keys_where_they_are(config, tmp_path):
    """Those of its profile, of the base, or the runner's own."""
    places = tmp_path / "runner", config.base, config.profiles / "cub"
    config = replace(config, keys=places[0] / KEYS.filename)
    places[0].mkdir()
    folder = config.build(Request("a", "cub"), tmp_path / "a")
    assert KEYS.load(folder).keys == {}
    for place in places:
        key_id, _ = add_key(place, "tablet", "pilot")
        config.build(Request("a", "cub"), tmp_path / "a")
        assert list(KEYS.load(folder).keys) == [key_id]
    revoke_key(places[-1], "tablet")
    assert KEYS.load(folder).keys[key_id].revoked


def test_the_runners_values_override_base_and_profile(config, tmp_path):
    imposed = {"mission_control.yml": {"remote_server": {"url": "proxy", "port": 1}}}
    config = replace(config, imposed=imposed)
    assert read(build(config, tmp_path)["mission_control.yml"]) == imposed["mission_control.yml"]
    (config.base / "mission_control.yml").write_text("remote_server: {url: x}\nrole: pilot\n")
    (config.profiles / "cub" / "mission_control.yml").write_text("remote_server: {port: 2}\n")
    built = read(build(config, tmp_path, "cub")["mission_control.yml"])
    assert built == {**imposed["mission_control.yml"], "role": "pilot"}


def test_a_configured_port_stays(config, tmp_path):
    (config.base / "android.yml").write_text("general port: 50001\n")
    assert read(build(config, tmp_path)["android.yml"]) == {"general port": 50001}
    (config.base / "android.yml").write_text("general port:\n")
    assert read(build(config, tmp_path)["android.yml"]) == {"general port": 0}


def test_the_profile_lies_over_the_base_key_by_key(config, tmp_path):
    (config.base / "pids.yml").write_text("rate: {ailerons: {p: 1, i: 2}, elevator: {p: 3}}\n")
    (config.profiles / "cub" / "pids.yml").write_text("rate: {ailerons: {p: 9}}\n")
    (config.profiles / "cub" / "only.yml").write_text("a: 1\n")
    built = build(config, tmp_path, "cub")
    assert read(built["pids.yml"]) == {"rate": {"ailerons": {"p": 9, "i": 2}, "elevator": {"p": 3}}}
    assert built["only.yml"] == "a: 1\n"


def test_files_of_a_former_profile_are_removed(config, tmp_path):
    (config.profiles / "cub" / "only.yml").write_text("a: 1\n")
    assert "only.yml" in build(config, tmp_path, "cub")
    assert "only.yml" not in build(config, tmp_path)


def test_a_file_for_other_programs_is_left_out(config, tmp_path):
    for name in ("runner.yml", "proxy.yml", "notes.txt"):
        (config.base / name).write_text("port: 1\n")
    assert set(build(config, tmp_path)) == {"android.yml"}


def test_a_request_sets_permitted_keys(config, tmp_path):
    (config.base / "load_guard.yml").write_text("interval: 0.5\n")
    built = build(config, tmp_path, None, {"load_guard.yml": {"interval": 2}})
    assert read(built["load_guard.yml"]) == {"interval": 2}
    built = build(config, tmp_path, None, {"new.yml": {"name": "x: y # no comment"}})
    assert read(built["new.yml"]) == {"name": "x: y # no comment"}


@pytest.mark.parametrize(
    ("present", "wanted"),
    [("0.5", True), ("0.5", "1"), ("true", 1), ("word", 1), ("[1]", 1), ("{a: 1}", 1)],
)
def test_a_value_of_another_type_is_refused(config, tmp_path, present, wanted):
    (config.base / "load_guard.yml").write_text(f"interval: {present}\n")
    with refused("wrong_type", "'interval' of load_guard.yml"):
        build(config, tmp_path, None, {"load_guard.yml": {"interval": wanted}})


@pytest.mark.parametrize(
    "configuration",
    [
        {"android.yml": {"general port": 1}},
        {"load_guard.yml": {"other": 1}},
        {"../../evil.yml": {"interval": 1}},
        {"pids.yml": {}},
    ],
)
def test_an_unlisted_key_is_refused_and_nothing_is_written(config, tmp_path, configuration):
    with refused("not_settable"):
        build(config, tmp_path, None, configuration)
    assert not (tmp_path / "a").exists()


def test_a_profile_that_is_not_there_is_refused(config, tmp_path):
    with refused("unknown_profile", "ufo"):
        build(config, tmp_path, "ufo")


@pytest.mark.parametrize("text", ["a: [", "- a\n", "a: 1\n\tb: 2\n", "!!python/object:os.x {}\n"])
def test_a_file_that_cannot_be_merged_is_named(config, tmp_path, text):
    (config.base / "load_guard.yml").write_text(text)
    with refused("bad_file", "load_guard.yml"):
        build(config, tmp_path, None, {"load_guard.yml": {"interval": 1}})


def test_a_file_that_cannot_be_read_is_named(config, tmp_path):
    (config.base / "load_guard.yml").write_bytes(b"\xff\xfe")
    with refused("bad_file", "load_guard.yml"):
        build(config, tmp_path)


def test_a_persisted_file_stays_with_its_good_copy(config, tmp_path):
    (config.base / "pids.yml").write_text("p: 1\n")
    build(config, tmp_path)
    folder = tmp_path / "a" / "config"
    (folder / "pids.yml").write_text("p: 2\n")
    (folder / "pids.yml.good").write_text("p: 2\n")
    built = build(config, tmp_path)
    assert built["pids.yml"] == built["pids.yml.good"] == "p: 2\n"
    built = build(config, tmp_path, "cub")
    assert built["pids.yml"] == "p: 1\n" and "pids.yml.good" not in built


scalars = st.booleans() | st.integers(-(2**63), 2**63 - 1) | st.text(max_size=50)


@given(st.text(min_size=1, max_size=20), scalars)
def test_every_value_arrives_as_it_was_sent(tmp_path_factory, key, value):
    folder = tmp_path_factory.mktemp("c")
    config = InstanceConfig(folder, folder, settable={"a.yml": (key,)})
    built = config.build(Request("a", None, {"a.yml": {key: value}}), folder / "a")
    found = yaml.safe_load((built / "a.yml").read_text("utf-8"))
    assert found == {key: value} and type(found[key]) is type(value)
