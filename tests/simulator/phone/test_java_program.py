"""The Java phone is found, built where its sources are newer, and done without where it must be."""

import os
import shutil
import zipfile

import pytest

from tests.simulator.program import Program
from tests.support.java import java_program, path_without
from up_simulator.harness.participants import CrewError
from up_simulator.phone.choice import IN_JAVA, IN_PYTHON, choose_phone
from up_simulator.phone.java_program import (
    ANDROID,
    JavaUnavailableError,
    find_java_program,
)

CORE = "package one;\n/** One. */\npublic final class One {\n    private One() {}\n}\n"


@pytest.fixture
def android(tmp_path):
    """A project of two classes with the real Makefile."""
    java_program()
    folder = tmp_path / "android"
    (folder / "core" / "src").mkdir(parents=True)
    (folder / "virtual" / "src").mkdir(parents=True)
    shutil.copy(ANDROID / "Makefile", folder)
    shutil.copytree(ANDROID / "tools", folder / "tools")
    (folder / "core" / "src" / "One.java").write_text(CORE)
    (folder / "virtual" / "src" / "Two.java").write_text(CORE.replace("One", "Two"))
    return folder


def built_ns(program):
    return [jar.stat().st_mtime_ns for jar in program.jars]


def test_it_is_built_once_and_anew_when_a_source_is_newer_or_gone(android):
    first = built_ns(find_java_program(android=android))
    program = find_java_program(android=android)
    assert built_ns(program) == first
    source = android / "virtual" / "src" / "Two.java"
    newer_ns = max(first) + 2_000_000_000
    os.utime(source, ns=(newer_ns, newer_ns))
    second = built_ns(find_java_program(android=android))
    assert all(new > old for new, old in zip(second, first, strict=True))
    (android / "core" / "src" / "One.java").rename(android / "core" / "src" / "Other.java")
    (android / "core" / "src" / "Other.java").write_text(CORE.replace("One", "Other"))
    assert built_ns(find_java_program(android=android)) != second


def test_a_jar_that_is_none_is_built_anew(android):
    program = find_java_program(android=android)
    for jar in program.jars:
        jar.write_bytes(b"what a full disk left")
    assert all(map(zipfile.is_zipfile, find_java_program(android=android).jars))


def test_what_does_not_compile_is_the_compilers_sentence(android):
    (android / "core" / "src" / "One.java").write_text(CORE.replace("class", "clasp"))
    with pytest.raises(JavaUnavailableError) as caught:
        find_java_program(android=android)
    said = str(caught.value)
    assert said.startswith("the Java phone does not compile: ")
    assert "One.java:3: error:" in said and "\n" not in said


def test_without_a_compiler_what_was_built_flies_and_it_is_said(android, tmp_path, monkeypatch):
    find_java_program(android=android)
    newer_s = (android / "build" / "up-core.jar").stat().st_mtime + 2
    os.utime(android / "core" / "src" / "One.java", (newer_s, newer_s))
    monkeypatch.setenv("PATH", path_without(tmp_path / "bin", "javac"))
    said = []
    find_java_program(said.append, android)
    (sentence,) = said
    assert "was built before and is not built anew" in sentence and "needs javac" in sentence
    shutil.rmtree(android / "build")
    with pytest.raises(JavaUnavailableError, match=r"needs javac \(Debian packages make default"):
        find_java_program(android=android)


def test_without_sources_or_java_there_is_a_sentence(tmp_path, monkeypatch):
    java_program()
    with pytest.raises(JavaUnavailableError, match="the Java phone's sources are not here"):
        find_java_program(android=tmp_path / "nowhere")
    monkeypatch.setenv("PATH", path_without(tmp_path / "bin", "java"))
    with pytest.raises(JavaUnavailableError, match=r"there is no java \(Debian package default"):
        find_java_program()


def test_auto_is_java_where_it_can_be_had_and_else_python_with_the_reason(tmp_path, monkeypatch):
    java_program()
    assert choose_phone().java == choose_phone("java").java == find_java_program()
    assert choose_phone().title == IN_JAVA
    assert choose_phone("python").java is None and choose_phone("python").title == IN_PYTHON
    monkeypatch.setenv("PATH", path_without(tmp_path / "bin", "java"))
    choice = choose_phone()
    assert choice.java is None
    assert choice.title == f"{IN_PYTHON}: there is no java (Debian package default-jdk-headless)"
    with pytest.raises(CrewError, match="the phone cannot be the Java one: there is no java"):
        choose_phone("java")


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [("auto", f"the phone is {IN_JAVA}\n"), ("python", f"the phone is {IN_PYTHON}\n")],
)
def test_the_aircraft_says_what_its_phone_is(kind, sentence):
    java_program()
    with Program("--no-board", "--phone", kind, "--general-port", "1") as program:
        program.wait_for(sentence)
        assert program.end()[0] == 0


def test_an_aircraft_without_java_says_so_and_flies_the_stand_in(tmp_path):
    path = {"PATH": path_without(tmp_path / "bin", "java")}
    with Program("--no-board", "--general-port", "1", environment=path) as program:
        program.wait_for(f"the phone is {IN_PYTHON}: there is no java")
        program.wait_for("phone: no connection to 127.0.0.1:1")
        assert program.end()[0] == 0
    with Program("--no-board", "--phone", "java", environment=path) as program:
        assert program.process.wait(60) == 1
        assert program.error().startswith("up-sim: the phone cannot be the Java one: there is no")
