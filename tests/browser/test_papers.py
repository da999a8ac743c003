"""Papers' pages: filters, sorting, the mechanism in motion."""

import re

import pytest


@pytest.mark.parametrize("name", ["paper", "ledger", "long-ledger"])
def test_filter_by_verdict(visit, name):
    page = visit(name)
    cards = page.locator("article.finding")
    box = page.locator(".filter[data-of='article.finding']")
    button = box.locator("button").first
    verdict, count = button.get_attribute("data-verdict"), int(button.locator(".n").inner_text())
    assert 0 < count < cards.count()
    button.click()
    assert button.get_attribute("aria-pressed") == "true"
    shown = page.locator("article.finding:visible")
    assert shown.count() == count
    assert {shown.nth(k).get_attribute("data-verdict") for k in range(count)} == {verdict}
    assert box.locator("output").inner_text() == f"{count} of {cards.count()} shown"
    # The contents follow.
    assert page.locator(".toc li[class]:visible").count() == count
    button.click()
    assert shown.count() == cards.count()


def test_search(visit):
    page = visit("paper")
    page.locator(".filter[data-of='article.finding'] input").fill("kloss")
    shown = page.locator("article.finding:visible")
    assert 0 < shown.count() < 5
    assert "Kloss" in shown.first.inner_text()


def test_printed_entries(visit):
    page = visit("paper")
    rows = page.locator("#entries-table tbody tr")
    assert rows.count() == 441
    page.locator("#entries-table th", has_text="as printed").locator("button").click()
    head = page.locator("#entries-table th[aria-sort]")
    assert head.get_attribute("aria-sort") == "ascending"
    column = head.evaluate("th => th.cellIndex")
    values = page.evaluate(
        "k => [...document.querySelectorAll('#entries-table tbody tr')].map(r => +r.cells[k].dataset.v)",
        column,
    )
    assert values == sorted(values)
    head.locator("button").click()
    assert head.get_attribute("aria-sort") == "descending"
    page.locator(".filter button[data-verdict=misprint]").click()
    assert page.locator("#entries-table tbody tr:visible").count() == 3
    assert page.locator("#findings:visible").count() == 1, "other sections stay"


def test_spark_lines(visit):
    page = visit("paper")
    lines = page.locator("table .spark polyline")
    assert lines.count() == 27
    assert len(lines.first.get_attribute("points").split()) == 49


def joint(page, label):
    return page.locator("#mechanism g[data-at]", has_text=re.compile(f"^{label}$"))


def test_slider_moves_mechanism_and_curves(visit):
    page = visit("paper")
    slider = page.locator("#drive")
    before = joint(page, "A").get_attribute("transform"), page.locator("#now-0").inner_text()
    assert page.locator("#drive-value").inner_text() == "14.426°"
    slider.focus()
    for _ in range(3):
        page.keyboard.press("PageUp")
    after = joint(page, "A").get_attribute("transform"), page.locator("#now-0").inner_text()
    assert page.locator("#drive-value").inner_text() != "14.426°"
    assert before[0] != after[0] and before[1] != after[1]
    # Half a turn: the crank's joint is on the other side of its pivot.
    place = lambda: [float(v) for v in re.findall(r"-?[\d.]+", joint(page, "A").get_attribute("transform"))]
    slider.fill("0")
    start = place()
    slider.fill("360")
    assert page.locator("#drive-value").inner_text() == "194.426°"
    pivot = [(a + b) / 2 for a, b in zip(start, place())]
    slider.fill("180")
    quarter = place()
    radius = lambda p: ((p[0] - pivot[0]) ** 2 + (p[1] - pivot[1]) ** 2) ** 0.5
    assert abs(radius(quarter) - radius(start)) < 0.1


def test_play_and_curves(visit):
    page = visit("paper")
    charts = page.locator("#courses svg[aria-label]")
    assert charts.count() == 3
    page.locator("#play").click()
    assert page.locator("#play").inner_text() == "Pause"
    page.wait_for_timeout(300)
    page.locator("#play").click()
    assert int(page.locator("#drive").input_value()) > 4
    held = page.locator("#drive").input_value()
    page.wait_for_timeout(150)
    assert page.locator("#drive").input_value() == held
    charts.first.scroll_into_view_if_needed()
    box = charts.first.bounding_box()
    page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + box["height"] / 2)
    assert 200 < float(page.locator("#drive-value").inner_text().rstrip("°")) < 320
