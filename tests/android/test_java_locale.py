"""The phone's messages do not depend on its language, which may have other digits."""

from __future__ import annotations

import re

from tests.support.android import ANDROID

DEFAULT = re.compile(
    r"String\.format\((?!\s*Locale\.)|to(?:Upper|Lower)Case\(\)|\.printf\((?!\s*Locale\.)"
    r"|new SimpleDateFormat\([^,()]*\)|new Formatter\(|Locale\.getDefault\("
)


def of_the_default_locale(source: str) -> list[str]:
    plain = re.sub(r"java\.util\.Locale", "Locale", source)
    return DEFAULT.findall(plain)


def test_no_text_is_formatted_by_the_language_of_the_phone():
    sources = [
        path
        for folder in ("core/src", "virtual", "library", "raspilot/src")
        for path in sorted((ANDROID / folder).rglob("*.java"))
    ]
    assert len(sources) > 200
    found = {
        str(path.relative_to(ANDROID)): of_the_default_locale(path.read_text(encoding="utf-8"))
        for path in sources
    }
    assert {path: calls for path, calls in found.items() if calls} == {}


def test_the_search_knows_what_it_looks_for():
    for wrong in (
        'String.format("%d", 1)',
        'String.format(\n    "%d", 1)',
        "name.toLowerCase()",
        "name.toUpperCase()",
        'out.printf("%d", 1)',
        'new SimpleDateFormat("HH")',
    ):
        assert of_the_default_locale(wrong), wrong
    for right in (
        'String.format(Locale.ROOT, "%d", 1)',
        'String.format(java.util.Locale.ROOT,\n "%d", 1)',
        "name.toLowerCase(Locale.ROOT)",
        'new SimpleDateFormat("HH", Locale.US)',
    ):
        assert not of_the_default_locale(right), right
