"""Jars are fetched once, and only as listed; a missing one is reported in a sentence."""

from __future__ import annotations

import hashlib
import shutil
import sys

import pytest

from tests.support.android import (
    ANDROID,
    JARS,
    AndroidBuildError,
    AndroidBuildLateError,
    make,
    need_jars,
    need_jdk,
)
from tests.support.java import path_without

sys.path.insert(0, str(ANDROID / "tools"))
import fetch

JUNIT = "junit-4.13.2.jar"
HAMCREST = "hamcrest-core-1.3.jar"


@pytest.fixture
def copy(tmp_path):
    """The build without its sources, and the jars of JUnit as they were fetched."""
    need_jars("junit")
    made = tmp_path / "android"
    shutil.copytree(ANDROID / "tools", made / "tools", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("Makefile", "jars.list"):
        shutil.copy(ANDROID / name, made)
    jars = made / "build" / "jars"
    jars.mkdir(parents=True)
    for name in (JUNIT, HAMCREST):
        shutil.copy(JARS / name, jars)
    return made


def said_by(folder, *arguments, env=None):
    with pytest.raises(AndroidBuildError) as failure:
        make(*arguments, folder=folder, env=env)
    return str(failure.value)


def test_no_host_is_named():
    for name in ("Makefile", "jars.list", "tools/fetch.py"):
        # The name space of a pom is a name.
        text = (ANDROID / name).read_text().replace("http://maven.apache.org/POM", "")
        assert "://" not in text and "<repositor" not in text


def test_what_is_there_is_not_fetched_again(copy, tmp_path):
    without_maven = {"PATH": path_without(tmp_path / "bin", "mvn")}
    assert "fetch" not in make("build/jars/.junit", folder=copy, env=without_maven)


def test_what_is_missing_is_fetched_and_told(copy):
    (copy / "build" / "jars" / HAMCREST).unlink()
    assert "fetch junit: 1 jars by Maven" in make("build/jars/.junit", folder=copy)
    assert (copy / "build" / "jars" / HAMCREST).read_bytes() == (JARS / HAMCREST).read_bytes()


def test_another_sum_in_the_list_fails_and_leaves_no_jar(copy):
    listed = copy / "jars.list"
    other = hashlib.sha256(b"other").hexdigest()
    text = listed.read_text()
    (junit,) = fetch.groups(listed)["junit"][:1]
    listed.write_text(text.replace(junit.sha256, other))
    said = said_by(copy, "build/jars/.junit")
    assert JUNIT in said and junit.sha256 in said and other in said
    assert not (copy / "build" / "jars" / JUNIT).exists()


def test_a_jar_that_was_changed_fails(copy):
    with (copy / "build" / "jars" / JUNIT).open("ab") as jar:
        jar.write(b"!")
    assert JUNIT in said_by(copy, "build/jars/.junit")
    assert not (copy / "build" / "jars" / JUNIT).exists()


def test_a_jar_without_a_sum_fails_with_its_line(copy):
    listed = copy / "jars.list"
    (junit,) = fetch.groups(listed)["junit"][:1]
    listed.write_text(listed.read_text().replace(junit.sha256, ""))
    assert "jars.list:4" in said_by(copy, "build/jars/.junit")


def test_without_maven_a_missing_jar_is_a_sentence(copy, tmp_path):
    (copy / "build" / "jars" / HAMCREST).unlink()
    without_maven = {"PATH": path_without(tmp_path / "bin", "mvn")}
    said = said_by(copy, "build/jars/.junit", env=without_maven)
    assert "mvn (Debian packages maven default-jdk-headless)" in said


@pytest.mark.parametrize(
    ("target", "tool", "named"),
    [
        ("build/up-core.jar", "javac", "javac: apt-get install default-jdk-headless"),
        ("build/debian-tools", "aapt", "needs aapt: apt-get install aapt android-framework-res"),
        ("build/debian-tools", "dexdump", "needs dexdump: apt-get install aapt"),
        ("build/debian-tools", "keytool", "needs keytool: apt-get install default-jdk-headless"),
        ("build/up-core.jar", "java", "needs java: apt-get install default-jdk-headless"),
        ("build/up-core.jar", "python3", "needs python3: apt-get install python3"),
    ],
)
def test_a_missing_tool_is_a_sentence(copy, tmp_path, target, tool, named):
    path = {"PATH": path_without(tmp_path / "bin", tool)}
    assert named in said_by(copy, target, env=path)


def test_core_and_virtual_need_a_jdk_alone(copy, tmp_path):
    need_jdk()
    shutil.rmtree(copy / "build")
    for name in ("core/src", "virtual/test"):
        source = copy / name / "Nothing.java"
        source.parent.mkdir(parents=True)
        source.write_text("/** Nothing. */ public final class Nothing { }\n")
    alone = path_without(tmp_path / "bin", "mvn", "aapt", "zipalign", "apksigner", "dexdump")
    make("core", "virtual", folder=copy, env={"PATH": alone})
    assert sorted(each.name for each in (copy / "build").glob("*.jar")) == [
        "up-core.jar",
        "virtual-phone.jar",
    ]
    assert "compile" not in make("core", "virtual", folder=copy, env={"PATH": alone})


def test_no_source_is_a_sentence(copy):
    assert "build/up-core.jar" in said_by(copy, "core")


@pytest.mark.parametrize("goal", ["test", "test-app"])
def test_a_test_that_is_not_there_is_a_sentence_before_anything_is_built(copy, goal):
    said = said_by(copy, goal, "TEST=NoSuch")
    assert "NoSuch" in said and "compile" not in said


def test_what_the_projects_own_make_was_told_is_not_told_to_the_phones(copy, monkeypatch):
    monkeypatch.setenv("MAKEFLAGS", " -- TEST=tests/up")
    monkeypatch.setenv("TEST", "tests/up")
    assert "build/up-core.jar" in said_by(copy, "test")


def test_a_build_that_takes_too_long_is_ended_and_said(tmp_path):
    (tmp_path / "Makefile").write_text("all:\n\t@echo begun\n\t@sleep 1000\n")
    with pytest.raises(AndroidBuildLateError, match=r"(?s)1 s\nbegun"):
        make(folder=tmp_path, limit_s=1)


def test_what_is_not_ready_is_said_and_skipped_unless_nothing_may_be(tmp_path):
    path = {"PATH": path_without(tmp_path / "bin", "aapt", "javac")}
    where_ready = ANDROID / "tools" / "where_ready"
    makefile = tmp_path / "Makefile"
    makefile.write_text(f"all:\n\t@{where_ready} check\n")
    said = make(folder=tmp_path, env=path | {"UP_REQUIRE_TOOLS": ""})
    assert "android: skipped" in said and "default-jdk-headless aapt" in said
    said = said_by(tmp_path, env=path | {"UP_REQUIRE_TOOLS": "1"})
    assert "default-jdk-headless aapt" in said


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (
            "Plugin p or one of its dependencies could not be resolved: Failed to read artifact "
            "descriptor for p: Could not transfer artifact p from/to central (there): "
            "Connect to there failed: Connection refused -> [Help 1]",
            "Connect to there failed: Connection refused",
        ),
        ("Could not find artifact p in central (there) -> [Help 1]", "Could not find artifact p"),
        ("1 problem was encountered while building\nNon-parseable settings s.xml @1:5", "s.xml @1"),
        ("x" * 700, "x" * 300 + " ..."),
    ],
)
def test_what_matters_of_mavens_words_is_told(said, told):
    found = fetch.reason(["", *said.split("\n"), "", "To see the full stack trace"])
    assert told in found and len(found) < 310 and "Help" not in found


def test_what_stops_mavens_jvm_is_told(copy):
    (copy / "build" / "jars" / HAMCREST).unlink()
    said = said_by(copy, "build/jars/.junit", env={"MAVEN_OPTS": "-Xbogus"})
    assert "fetch_failed" in said and "exit status" not in said


def test_a_network_that_is_not_there_is_one_sentence(copy, tmp_path):
    proxy = "<proxy><id>{0}</id><protocol>{0}</protocol><host>127.0.0.1</host>"
    proxy += "<port>9</port></proxy>"
    proxies = "".join(map(proxy.format, ("http", "https")))
    (tmp_path / ".m2").mkdir()
    (tmp_path / ".m2" / "settings.xml").write_text(
        f"<settings><proxies>{proxies}</proxies></settings>"
    )
    (copy / "build" / "jars" / HAMCREST).unlink()
    nowhere = {"MAVEN_OPTS": f"-Duser.home={tmp_path}"}
    said = said_by(copy, "build/jars/.junit", env=nowhere)
    (line,) = [each for each in said.splitlines() if each.startswith("android: ")]
    assert "refused" in line and len(line) < 250, line
