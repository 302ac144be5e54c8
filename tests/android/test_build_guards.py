"""A class for a newer Android is reached behind the check of the version only."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.support.android import ANDROID, need_jdk

sys.path.insert(0, str(ANDROID / "tools"))
import guards
import pack

SDK = """package android.os;
public class Build {
    public static class VERSION {
        public static final int SDK_INT = Integer.parseInt("16");
        public static final int OTHER = Integer.parseInt("99");
    }
}"""
NEW_23 = """package up.api23;
public class New {
    public static void run() {}
    public static void deeper() { New.run(); }
}"""
NEW_26 = """package up.api26;
public class Newer {
    public static int field;
    public static void run() { up.api23.New.run(); }
}"""
# The statements of a method, with x a parameter of it.
GUARDED = {
    "if": "if (SDK_INT >= 23) { New.run(); }",
    "newer": "if (SDK_INT >= 29) { New.run(); }",
    "greater": "if (SDK_INT > 22) { New.run(); }",
    "mirrored": "if (23 <= SDK_INT) { New.run(); }",
    "early": "if (SDK_INT < 23) { return; } New.run();",
    "thrown": "if (SDK_INT < 23) { throw new IllegalStateException(); } New.run();",
    "and": "if (x > 3 && SDK_INT >= 23 && x < 9) { New.run(); }",
    "or": "if (SDK_INT < 23 || x > 3) { return; } New.run();",
    "chosen": "int y = SDK_INT >= 26 ? Newer.field : 0;",
    "otherwise": "if (SDK_INT < 23) { x = 1; } else { New.run(); }",
    "equal": "if (SDK_INT == 24) { New.run(); }",
    "within": "if (SDK_INT >= 23) { for (; x < 9; x++) { New.run(); } }",
    "either": "if (SDK_INT >= 26) { x = 1; } else if (SDK_INT >= 23) { x = 2; } "
    "else { return; } New.run();",
    "switch": "switch (SDK_INT) { case 23: case 24: New.run(); break; default: x = 1; }",
    "inner": "if (SDK_INT >= 23) { up.api23.Trouble.Deeper.run(); }",
    "caught": "if (SDK_INT >= 23) { try { x /= x; } catch (RuntimeException e) { New.run(); } }",
}
UNGUARDED = {
    "bare": "New.run();",
    "older": "if (SDK_INT >= 22) { New.run(); }",
    "contrary": "if (SDK_INT < 23) { New.run(); }",
    "below": "if (SDK_INT <= 23) { New.run(); }",
    "else": "if (SDK_INT >= 23) { x = 1; } else { New.run(); }",
    "after": "if (SDK_INT >= 23) { x = 1; } New.run();",
    "or": "if (SDK_INT >= 23 || x > 3) { New.run(); }",
    "other": "if (Build.VERSION.OTHER >= 23) { New.run(); }",
    "copied": "boolean is = SDK_INT >= 23; if (is) { New.run(); }",
    "variable": "int n = 23; x = n; if (SDK_INT >= x) { New.run(); }",
    "mixed": "if ((x > 3 ? 99 : SDK_INT) >= 23) { New.run(); }",
    "unequal": "if (SDK_INT != 24) { New.run(); }",
    "default": "switch (SDK_INT) { case 16: x = 1; break; default: New.run(); }",
    "falls": "switch (SDK_INT) { case 16: x = 1; case 23: New.run(); break; default: x = 2; }",
    "level": "if (SDK_INT >= 23) { Newer.run(); }",
    "string": 'Class.forName("up.api23.New");',
    "literal": "Object o = New.class;",
    "field": "x = Newer.field;",
    "created": "new New();",
    "cast": "Object o = null; New n = (New) o;",
    "caught": "try { if (SDK_INT >= 23) { x = 1; } x /= x; } "
    "catch (RuntimeException e) { New.run(); }",
    "anonymous": "if (SDK_INT >= 23) { "
    "new Runnable() { public void run() { New.run(); } }.run(); }",
    "passed": "if (SDK_INT >= 23) { helper(); }} static void helper() { New.run();",
}
ANNOTATION_23 = """package up.api23;
@java.lang.annotation.Retention(java.lang.annotation.RetentionPolicy.RUNTIME)
public @interface Mark {}"""
TROUBLE_23 = """package up.api23;
public class Trouble extends RuntimeException {
    static final long serialVersionUID = 1;
    public static class Deeper { public static long number = 5; public static void run() {} }
}"""
DECLARED = {
    "extends": "class {} extends up.api23.New {{}}",
    "holds": "class {} {{ up.api23.New held; }}",
    "takes": "class {} {{ void take(up.api23.New given) {{}} }}",
    "gives": "class {} {{ up.api23.New give() {{ return null; }} }}",
    "annotated": "class {} {{ @up.api23.Mark int held; long large() {{ return 1L << 40; }} }}",
    "catches": "class {} {{ void run(int x) {{ "
    "try {{ x /= x; }} catch (up.api23.Trouble e) {{ x = 1; }} }} }}",
    "catches_behind": "class {} {{ void run(int x) {{ "
    "if (android.os.Build.VERSION.SDK_INT >= 23) {{ "
    "try {{ x /= x; }} catch (up.api23.Trouble e) {{ x = 1; }} }} }} }}",
}


NAMED = {"level": "api26.Newer", "field": "api26.Newer", "annotated": "names up.api23.Mark"}
NAMED |= dict.fromkeys(("catches", "catches_behind"), "catches up.api23.Trouble")


def source(name, body):
    return f"""package up;
import android.os.Build;
import static android.os.Build.VERSION.SDK_INT;
import up.api23.New;
import up.api26.Newer;
public class {name} {{
    public static void method(int x) throws Exception {{ {body} }}
}}"""


def write(folder, name, text):
    """Write a class where its package is."""
    place = folder / "src" / text.split(";")[0].removeprefix("package ").replace(".", "/")
    place.mkdir(parents=True, exist_ok=True)
    (place / f"{name}.java").write_text(text)


def packed(folder, name):
    """Return a jar of all classes that were written."""
    classes = folder / "classes"
    classes.mkdir()
    subprocess.run(
        ["javac", "-nowarn", "-d", str(classes), *map(str, (folder / "src").rglob("*.java"))],
        check=True,
    )
    pack.pack(folder / name, classes)
    return folder / name


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """The findings for each class, all compiled and read together."""
    need_jdk()
    folder = tmp_path_factory.mktemp("guards")
    sources = {"Build": SDK, "New": NEW_23, "Newer": NEW_26}
    sources |= {"Mark": ANNOTATION_23, "Trouble": TROUBLE_23}
    sources |= {f"Good_{key}": source(f"Good_{key}", body) for key, body in GUARDED.items()}
    sources |= {f"Bad_{key}": source(f"Bad_{key}", body) for key, body in UNGUARDED.items()}
    for key, text in DECLARED.items():
        sources[f"Bad_{key}"] = "package up; public " + text.format(f"Bad_{key}")
    for name, text in sources.items():
        write(folder, name, text)
    packed(folder, "all.jar")
    said = {name.split("$")[0]: [] for name in guards.inside(folder / "all.jar")}
    for fault in guards.faults_of_jar(folder / "all.jar"):
        said[fault.split()[0].rstrip(":").split("$")[0]].append(fault)
    return said


@pytest.mark.parametrize("key", GUARDED)
def test_what_is_behind_the_check_passes(found, key):
    assert found[f"up.Good_{key}"] == []


@pytest.mark.parametrize("key", [*UNGUARDED, *DECLARED])
def test_what_is_not_behind_the_check_is_named(found, key):
    faults = found[f"up.Bad_{key}"]
    needed = NAMED.get(key, "api23.New")
    assert faults and all(needed in each for each in faults)


def test_a_class_of_a_newer_level_may_use_one_of_an_older(found):
    assert found["up.api26.Newer"] == [] == found["up.api23.New"]


def test_a_component_of_the_manifest_is_there_on_every_android(tmp_path, capsys):
    manifest = tmp_path / "AndroidManifest.xml"
    manifest.write_text('<service android:name="org.raspilot.up.android.api29.Typed" />')
    assert guards.main([str(manifest)]) == 1
    assert "names org.raspilot.up.android.api29.Typed" in capsys.readouterr().err
    manifest.write_text('<service android:name="org.raspilot.up.android.BaseUpService" />')
    assert guards.main([str(manifest)]) == 0


@pytest.fixture
def manifest(tmp_path):
    need_jdk()
    written = tmp_path / "AndroidManifest.xml"
    written.write_text("<manifest />")
    return written


def test_a_class_compiled_for_a_level_is_in_its_package(tmp_path, manifest, capsys):
    write(tmp_path, "Sneak", "package up.android; public class Sneak {}")
    write(tmp_path, "New", NEW_23)
    jar = packed(tmp_path, "newer-23.jar")
    assert guards.main([str(manifest), str(jar)]) == 1
    (said,) = capsys.readouterr().err.splitlines()
    assert "up.android.Sneak" in said and ".api23" in said


def test_a_class_of_an_older_level_is_not_compiled_for_a_newer(tmp_path, manifest, capsys):
    write(tmp_path, "New", NEW_23)
    assert guards.main([str(manifest), str(packed(tmp_path, "newer-26.jar"))]) == 1
    (said,) = capsys.readouterr().err.splitlines()
    assert "up.api23.New" in said and ".api26" in said


def test_what_is_in_its_place_passes(tmp_path, manifest, capsys):
    write(tmp_path, "New", NEW_23)
    assert guards.main([str(manifest), str(packed(tmp_path, "newer-23.jar"))]) == 0
    assert capsys.readouterr().err == ""
