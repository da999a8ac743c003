"""Linkages' pages: the slider moves the figure, the values and the marks in the charts."""

import csv
import io
import subprocess

import pytest
from conftest import MOVED, PROGRAM, ROOT


def figure(page):
    return page.evaluate(
        "[...document.querySelectorAll('#mechanism [data-points]')].map(e => e.getAttribute('points'))"
        ".concat([...document.querySelectorAll('#mechanism [data-at]')].map(e => e.getAttribute('transform')))"
    )


def values(page):
    return page.locator(".now dd").all_inner_texts()


@pytest.mark.parametrize("name", ["linkage", "linkage-arc", *MOVED])
def test_linkage_moves(visit, name):
    page = visit(name)
    page.wait_for_selector("#courses svg")
    before = figure(page), values(page), page.locator("#drive-value").inner_text()
    slider = page.locator("#drive")
    last = int(slider.get_attribute("max"))
    assert last > 100
    # To the middle of what there is.
    slider.fill(str((int(slider.input_value()) + last // 2) % last))
    after = figure(page), values(page), page.locator("#drive-value").inner_text()
    assert all(a != b for a, b in zip(before, after))
    assert "NaN" not in "".join(after[0]) and "undefined" not in "".join(after[0])
    marks = page.locator("#courses .cursor")
    assert marks.count() == page.locator("#courses svg[aria-label]").count() > 0
    for width in (360, 768, 1280):
        page.set_viewport_size({"width": width, "height": 900})
        page.wait_for_timeout(50)
        assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_values_are_those_of_the_rows(visit):
    rows = [PROGRAM, "linkage", "examples/quick-return.toml", "--reactions", "--step-deg", "0.5"]
    done = subprocess.run(rows, cwd=ROOT, capture_output=True, text=True, check=True)
    row = list(csv.DictReader(io.StringIO(done.stdout)))[240]
    page = visit("linkage")
    page.locator("#drive").fill("240")
    assert page.locator("#drive-value").inner_text() == "120.000°"
    shown = [float(v.split()[0]) for v in values(page)]
    due = [float(v) for v in list(row.values())[2:]]
    assert len(shown) == len(due) > 20
    assert all(abs(a - b) <= 6e-5 * abs(b) + 1e-12 for a, b in zip(shown, due))


def test_linkage_charts_are_chosen_and_moved_by_keyboard(visit):
    page = visit("linkage", width=360)
    charts = page.locator("#courses svg[aria-label]")
    n = charts.count()
    button = page.locator("button[data-course='0']")
    button.focus()
    page.keyboard.press("Enter")
    assert charts.count() == n + 1 and button.get_attribute("aria-pressed") == "true"
    page.locator("#drive").focus()
    page.keyboard.press("ArrowRight")
    assert page.locator("#drive-value").inner_text() == "0.500°"


def test_linkage_arc_runs_to_and_fro(visit):
    page = visit("linkage-arc")
    slider = page.locator("#drive")
    slider.fill(slider.get_attribute("max"))
    end = float(page.locator("#drive-value").inner_text().rstrip("°"))
    page.locator("#play").click()
    page.wait_for_timeout(300)
    page.locator("#play").click()
    back = float(page.locator("#drive-value").inner_text().rstrip("°"))
    assert end - 40 < back < end


def test_linkage_in_print(visit):
    page = visit("linkage", scheme="dark")
    page.emulate_media(media="print")
    assert page.locator("#mechanism").is_visible() and page.locator("#values ~ .scroll").first.is_visible()
    assert not page.locator("#drive").is_visible()
