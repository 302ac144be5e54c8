"""Resources for every Android name nothing that Android 4.1 lacks; texts are string resources."""

from __future__ import annotations

import sys

import pytest

from tests.support.android import ANDROID, JARS, need_android

sys.path.insert(0, str(ANDROID / "tools"))
import resources

SPACE = 'xmlns:android="http://schemas.android.com/apk/res/android"'
GOOD = {
    "drawable/a.xml": f"<selector {SPACE}><item><shape>"
    '<solid android:color="@android:color/white"/></shape></item></selector>',
    "layout/a.xml": f'<LinearLayout {SPACE} style="?android:attr/buttonBarStyle"><TextView/>'
    '<android.widget.Space/><our.View/><include layout="@layout/b"/></LinearLayout>',
    "values/a.xml": '<resources><style name="A" parent="android:Theme.Holo">'
    '<item name="android:background">?android:selectableItemBackground</item></style></resources>',
    "values-v21/a.xml": '<resources><style name="A" parent="@android:style/Theme.Material"/>'
    "</resources>",
    "drawable-v21/a.xml": f'<ripple {SPACE} android:color="@android:color/white"/>',
}
BAD = {
    "ripple": ("drawable/b.xml", f"<ripple {SPACE}/>", "draws no <ripple>"),
    "within": ("drawable/b.xml", "<layer-list><ripple/></layer-list>", "draws no <ripple>"),
    "attribute": (
        "layout/b.xml",
        f'<View {SPACE} android:background="?android:attr/selectableItemBackgroundBorderless"/>',
        "has no ?android:attr/selectableItemBackgroundBorderless",
    ),
    "short": (
        "layout-land/b.xml",
        f'<View {SPACE} android:background="?android:colorPrimary"/>',
        "has no ?android:colorPrimary",
    ),
    "parent": (
        "values/b.xml",
        '<resources><style name="B" parent="android:Theme.Material"/></resources>',
        "has no android:Theme.Material",
    ),
    "older": (
        "values-v14/b.xml",
        '<resources><style name="B" parent="@android:style/Theme.Material"/></resources>',
        "has no @android:style/Theme.Material",
    ),
    "item": (
        "values/b.xml",
        '<resources><color name="b">@android:color/system_accent1_0</color></resources>',
        "has no @android:color/system_accent1_0",
    ),
    "private": (
        "values/b.xml",
        '<resources><color name="b">@*android:color/white</color></resources>',
        "has no @*android:color/white",
    ),
    "view": ("layout/b.xml", "<LinearLayout><TextClock/></LinearLayout>", "no view <TextClock>"),
    "words": (
        "layout/b.xml",
        f'<TextView {SPACE} android:text="Arm"/>',
        "android:text of <TextView> is not a string resource",
    ),
    "named": ("layout/b.xml", "<android.widget.Toolbar/>", "no view <android.widget.Toolbar>"),
}


@pytest.fixture(scope="module")
def stubs():
    need_android()
    return JARS / "android-4.1.1.4.jar"


@pytest.fixture
def res(tmp_path):
    for name, text in GOOD.items():
        write(tmp_path, name, text)
    return tmp_path


def write(res, name, text):
    (res / name).parent.mkdir(exist_ok=True)
    (res / name).write_text(text)


def test_what_android_4_1_has_passes(res, stubs, capsys):
    assert resources.main([str(res), str(stubs)]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("key", BAD)
def test_what_android_4_1_lacks_is_named(res, stubs, capsys, key):
    name, text, sentence = BAD[key]
    write(res, name, text)
    assert resources.main([str(res), str(stubs)]) == 1
    said = capsys.readouterr().err
    assert sentence in said and said.count("\n") == 1 and name in said


def test_those_of_the_app_pass(stubs):
    assert resources.main([str(ANDROID / "raspilot" / "res"), str(stubs)]) == 0
