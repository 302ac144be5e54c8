"""Checks that resources for every Android use only what API 16 has.

``resources.py RES STUBS``: ``aapt`` knows the resources of a newer Android, too, and what an older
one lacks ends the app there when it is drawn. It checks the XML files of all folders except those
of newer versions (``values-v21``): names of the system's resources, elements of drawables, views of
layouts. It does not check names of attributes: an older Android ignores unknown ones. A displayed
text that is not a string resource, which has no translation, is an error, too.
"""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

LEAST = 16
VERSION = re.compile(r"-v(\d+)(?:-|$)")
SYSTEM = re.compile(r"([@?])(\+|\*)?android:(?:(\w+)/)?([\w.]+)")
CONSTANT = re.compile(r"^  public static final int(?:\[\])? (\w+);$")
CLASS = re.compile(r"class android\.R\$(\w+) ")
VIEWS = ("android/view/", "android/widget/", "android/webkit/")
ANDROID = "{http://schemas.android.com/apk/res/android}"
DISPLAYED = ("contentDescription", "dialogMessage", "hint", "label", "summary", "text", "title")
LAYOUT_WORDS = {"include", "merge", "requestFocus"}
DRAWABLES = {
    *("animation-list", "bitmap", "clip", "color", "inset", "item", "layer-list", "level-list"),
    *("nine-patch", "rotate", "animated-rotate", "scale", "selector", "transition"),
    *("shape", "corners", "gradient", "padding", "size", "solid", "stroke"),
}


@dataclass(frozen=True, slots=True)
class Offer:
    """The resources of the minimum Android as (type, name), and its classes by their paths."""

    resources: frozenset[tuple[str, str]]
    classes: frozenset[str]


def offer(stubs: Path) -> Offer:
    """Read the jar of the public stubs of the minimum Android."""
    with zipfile.ZipFile(stubs) as opened:
        classes = [each for each in opened.namelist() if each.endswith(".class")]
    kinds = [each[:-6].replace("/", ".") for each in classes if each.startswith("android/R$")]
    command = ["javap", "-J-XX:TieredStopAtLevel=1", "-cp", str(stubs), *kinds]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    resources = set()
    kind = ""
    for line in said.splitlines():
        if found := CLASS.search(line):
            kind = found[1]
        elif found := CONSTANT.match(line):
            resources.add((kind, found[1]))
    return Offer(frozenset(resources), frozenset(each[:-6] for each in classes))


def names(element: ElementTree.Element) -> Iterator[tuple[str, str, str]]:
    """Yield the text, type and name of each resource of the system that is named here."""
    for text in (*element.attrib.values(), element.text or ""):
        for found in SYSTEM.finditer(text.strip()):
            usual = "attr" if found[1] == "?" else ""
            yield found[0], "" if found[2] == "*" else found[3] or usual, found[4]
    parent = element.get("parent", "")
    if element.tag == "style" and parent.startswith("android:"):
        yield parent, "style", parent.removeprefix("android:").removeprefix("style/")


def is_view(tag: str, offered: Offer) -> bool:
    """Return whether a layout may have an element: one of ours, or one of the minimum Android."""
    if "." in tag:
        return not tag.startswith("android.") or tag.replace(".", "/") in offered.classes
    return tag in LAYOUT_WORDS or any(each + tag in offered.classes for each in VIEWS)


def faults(file: Path, offered: Offer) -> Iterator[str]:
    """Yield the errors of one file, a sentence each."""
    kind = file.parent.name.split("-")[0]
    for element in ElementTree.parse(file).iter():
        for name in DISPLAYED:
            if element.get(f"{ANDROID}{name}", "@")[:1] not in ("@", "?"):
                yield f"{file}: android:{name} of <{element.tag}> is not a string resource"
        for written, type_, name in names(element):
            if (type_, name.replace(".", "_")) not in offered.resources:
                yield f"{file}: Android {LEAST} has no {written}"
        if kind == "drawable" and element.tag not in DRAWABLES:
            yield f"{file}: Android {LEAST} draws no <{element.tag}>"
        if kind == "layout" and not is_view(element.get("class", element.tag), offered):
            yield f"{file}: Android {LEAST} has no view <{element.tag}>"


def files(res: Path) -> Iterator[Path]:
    """Yield the XML files of all folders that the minimum Android reads."""
    for folder in sorted(res.iterdir()):
        found = VERSION.search(folder.name)
        if not found or int(found[1]) <= LEAST:
            yield from sorted(folder.glob("*.xml"))


def main(arguments: list[str]) -> int:
    """Check the folder of resources against the jar of stubs; return the exit status."""
    res, stubs = map(Path, arguments)
    offered = offer(stubs)
    found = [fault for file in files(res) for fault in faults(file, offered)]
    for each in found:
        print(each, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
