"""Audits' pages: what is clicked opens, sorts, toggles and is copied."""

import re

import pytest
from playwright.sync_api import expect


def dialog(page):
    box = page.locator("#case")
    assert box.is_visible()
    return box


def command(page):
    return dialog(page).locator(".command code").inner_text()


def figures(page):
    page.locator("[data-figures]").first.scroll_into_view_if_needed()
    page.locator("[data-figures] figure").first.wait_for()
    return page.locator("[data-figures]").first


def point(page, svg, x, y):
    """Points at a share of a drawing's width and height, once figures drawn above it have moved it to its place."""
    box = svg.bounding_box()
    svg.hover(position={"x": x * box["width"], "y": y * box["height"]})


def press(page):
    """A click where the pointer is."""
    page.mouse.down()
    page.mouse.up()


def test_overview(visit):
    page = visit("audit")
    rows = page.locator("#overview-table tbody tr")
    assert rows.count() == page.locator("section.method").count() > 20
    page.locator("#overview-table th", has_text="worst ulps").locator("button").click()
    values = page.evaluate(
        "[...document.querySelectorAll('#overview-table tbody tr')].map(r => +r.cells[4].dataset.v)"
    )
    assert values == sorted(values)
    name = rows.first.locator("a").inner_text()
    rows.first.locator("td.strip button").first.click()
    assert dialog(page).locator("h2").inner_text().startswith(name)
    assert command(page).startswith(f"mechaudit audit {name} --")
    page.keyboard.press("Escape")
    assert not page.locator("#case").is_visible()


@pytest.mark.parametrize("name", ["method", "candidate"])
def test_cell_opens_the_case_of_its_region(visit, name):
    page = visit(name)
    row = page.locator("table.regions tbody tr", has_text="near-zeros").first
    row.locator("button").nth(1).click()
    assert dialog(page).locator("h2").inner_text() == "faddeeva, near-zeros"
    assert "--region near-zeros --seed 1 --case " in command(page)


def test_open_case_in_full(visit):
    page = visit("candidate")
    page.locator("button.open").last.click()
    text = dialog(page).inner_text()
    for part in ["over budget", "Re z", "0x1.", "due", "got", "reference:", "decided at", "--exec"]:
        assert part in text, part


@pytest.mark.parametrize("grants", [["clipboard-read", "clipboard-write"], []])
def test_copy_the_command(visit, grants):
    page = visit("candidate", permissions=grants)
    page.locator("button.open").first.click()
    due = command(page)
    button = page.locator("button.copy")
    button.click()
    page.locator("button.copy", has_text=re.compile("copied|selected")).wait_for()
    assert page.evaluate("getSelection().toString()") == due
    if grants:
        assert button.inner_text() == "copied"
        assert page.evaluate("navigator.clipboard.readText()") == due


def test_histogram_reads_and_opens(visit):
    page = visit("candidate")
    figure = figures(page).locator("figure").first
    point(page, figure.locator("svg"), 0.5, 0.5)
    expect(figure.locator("output")).to_have_text(re.compile(r"ulps.*: \d+ values"))
    press(page)
    assert "mechaudit audit faddeeva --" in command(page)


def test_histogram_by_keyboard(visit):
    page = visit("method")
    svg = figures(page).locator("figure svg").first
    svg.focus()
    page.keyboard.press("ArrowRight")
    read = figures(page).locator("figure output").first
    assert read.inner_text().startswith("exact: ")
    page.keyboard.press("ArrowRight")
    assert "ulps: " in read.inner_text()
    page.keyboard.press("Enter")
    assert command(page)


def test_histograms_share_their_axis(visit):
    page = visit("candidate")
    ticks = lambda k: figures(page).locator("figure svg").nth(k).locator("text").all_text_contents()
    powers = lambda k: [t for t in ticks(k) if re.fullmatch("2⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+", t)]
    assert len(powers(0)) > 3 and powers(0) == powers(1)


def test_error_against_an_input(visit):
    page = visit("candidate")
    box = figures(page)
    plot = box.locator("figure", has_text="against Re z")
    svg = plot.locator("svg")
    assert svg.locator("circle").count() > 100
    svg.focus()
    page.keyboard.press("ArrowRight")
    assert re.match(r"Re z = .*: .*, [\w-]+$", plot.locator("output").inner_text())
    page.keyboard.press("Enter")
    assert "--" in command(page)
    page.keyboard.press("Escape")
    box.locator("select").select_option(label="Im W")
    assert box.locator("figure", has_text="Im W against Re z").count() == 1


def test_map(visit):
    page = visit("method")
    figures(page)
    map_ = page.locator("figure.wide")
    map_.wait_for()
    assert map_.locator("image").count() == 1
    point(page, map_.locator("svg"), 0.7, 0.4)
    assert re.match(r"z = -?\d.*i: at most .* ulps", map_.locator("output").inner_text())
    press(page)
    assert re.search(r"--at -?[\d.]+,-?[\d.]+$", command(page))
    page.keyboard.press("Escape")
    for word in ["worst cases", "beside zeros", "beside seams", "formulas"]:
        button = map_.locator(".marks button", has_text=word)
        before = button.get_attribute("aria-pressed")
        hidden = map_.locator("svg [visibility=hidden]").count()
        button.click()
        assert button.get_attribute("aria-pressed") != before
        assert map_.locator("svg [visibility=hidden]").count() != hidden


def test_print_has_the_figures(visit):
    page = visit("method")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    figures_ = page.locator(".figures figure svg")
    assert figures_.count() > 4
    assert all(figures_.nth(k).is_visible() for k in range(figures_.count()))
    assert page.locator("h3[id^=figures-]").first.is_visible()


def test_a_region_says_what_it_is(visit):
    page = visit("method")
    meanings = page.locator("table.regions .meaning")
    assert meanings.count() == page.locator("table.regions tbody tr").count()
    page.locator("table.regions button.heat").first.click()
    assert meanings.first.inner_text() in dialog(page).inner_text()


def test_names_are_text(visit):
    page = visit("candidate")
    assert "<script>alert(1)</script>" in page.locator("main").inner_text()


@pytest.mark.parametrize("width", [360, 768])
def test_dialog_fits(visit, width):
    page = visit("candidate", width)
    page.locator("button.open").first.click()
    box = dialog(page).bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= width
    assert page.evaluate("document.getElementById('case').scrollWidth <= document.getElementById('case').clientWidth")


def test_comparison(visit):
    page = visit("comparison")
    rows = page.locator("#comparison-table tbody tr")
    assert rows.count() > 20 and "★" in rows.first.inner_text()
    page.locator("#comparison-table th", has_text="ours").locator("button").click()
    head = page.locator("#comparison-table th[aria-sort=ascending]")
    assert head.count() == 1
    page.locator("section.method").nth(0).locator("button.open").first.click()
    assert "--exec" in command(page)
    page.keyboard.press("Escape")
    page.locator("section.method").nth(1).locator("button.open").first.click()
    assert "--exec" not in command(page)
