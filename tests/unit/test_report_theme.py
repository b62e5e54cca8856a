"""The colours of a report: legible, in light and in dark."""

import re

import pytest

from beal.report.theme import CSS

ROOTS = re.findall(r":root \{(.*?)\}", CSS, re.DOTALL)
THEMES = [dict(re.findall(r"--(\w+): (#\w+)", root)) for root in ROOTS]
TEXT = [("ink", "paper"), ("soft", "paper"), ("accent", "paper"), ("ink", "tint")]
VERDICTS = [("ink", "holds"), ("ink", "part"), ("ink", "fails")]


def luminance(colour):
    """Of WCAG 2."""
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    parts = [int(digits[n : n + 2], 16) / 255 for n in (0, 2, 4)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("theme", THEMES, ids=["light", "dark"])
@pytest.mark.parametrize(("ink", "paper"), [*TEXT, *VERDICTS])
def test_text_stands_out_from_what_is_behind_it(theme, ink, paper):
    dark, light = sorted((luminance(theme[ink]), luminance(theme[paper])))
    assert (light + 0.05) / (dark + 0.05) >= 4.5  # WCAG 2, level AA


def test_a_dark_theme_replaces_every_colour():
    light, dark = THEMES
    assert light.keys() == dark.keys()


def test_colours_are_those_of_the_theme_and_the_white_behind_figures():
    rest = re.sub(r":root \{.*?\}", "", CSS, flags=re.DOTALL)
    assert set(re.findall(r"#[0-9a-f]{3,6}\b", rest)) == {"#fff"}
