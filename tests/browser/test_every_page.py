"""What holds of every page: room at each width, contrast in both schemes, no word in the console."""

from pathlib import Path
from urllib.parse import urlsplit

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import PAGES

WIDTHS = [360, 768, 1280]


@pytest.mark.parametrize("width", WIDTHS)
def test_no_overflow(page, width):
    page.set_viewport_size({"width": width, "height": 900})
    page.wait_for_timeout(300)
    extent = page.evaluate("document.documentElement.scrollWidth")
    assert extent <= width


# Of rows and sections that look alike (elements, classes, styles) two of each parent stay: each text costs
# axe-core a look at all that lies under it.
LOOKS = """() => {
  const look = (e) => e.tagName + e.className + (e.getAttribute("style") || "");
  for (const kind of ["tr", "li", "section"]) {
    for (const parent of new Set([...document.querySelectorAll(kind)].map((e) => e.parentElement))) {
      const seen = {};
      for (const child of [...parent.children].filter((e) => e.matches(kind))) {
        const key = [child, ...child.querySelectorAll("*")].map(look).join();
        seen[key] = (seen[key] || 0) + 1;
        if (seen[key] > 2) child.remove();
      }
    }
  }
}"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", PAGES)
def test_contrast_and_access(visit, name, scheme):
    """axe-core: 4.5 for text and 3 for large text (WCAG 2 AA); in one scheme names of controls, order of headings."""
    page = visit(name, scheme=scheme)
    page.wait_for_timeout(300)
    page.evaluate(LOOKS)
    rules = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] if scheme == "light" else ["color-contrast"]
    results = Axe().run(page, options={"runOnly": rules, "resultTypes": ["violations"]})
    judged = results.response["passes"] + results.response["violations"]
    assert "color-contrast" in {rule["id"] for rule in judged}
    assert results.violations_count == 0, results.generate_report()


def test_size_and_title(page):
    assert Path(urlsplit(page.url).path).stat().st_size < 2_000_000
    assert page.locator("h1").count() == 1
    assert page.title()


@pytest.mark.parametrize("name", PAGES)
def test_without_scripts_the_text_is_there(visit, name):
    page = visit(name, java_script_enabled=False)
    assert len(page.locator("main").inner_text()) > 1500
    assert page.locator(".js:visible").count() == 0


@pytest.mark.parametrize("name", PAGES)
def test_theme_switch(visit, name):
    page = visit(name, scheme="light")
    background = lambda: page.evaluate("getComputedStyle(document.body).backgroundColor")
    light = background()
    button = page.locator("#theme")
    button.focus()
    page.keyboard.press("Enter")
    assert button.inner_text() == "Colours: light" and background() == light
    page.keyboard.press("Enter")
    assert button.inner_text() == "Colours: dark" and background() != light
    page.reload()
    assert background() != light, "the choice is kept"


def test_no_text_for_the_mouse_alone(page):
    assert page.locator("main [title]").count() == 0


def test_columns_are_explained(page):
    """Every head of a table that is not a name from outside has an entry on the page."""
    heads = page.locator("main table:not(.entries) thead th:not(.given)").count()
    entries = page.locator("#columns ~ details dt code")
    assert heads == 0 or entries.count() > 3
    assert page.locator(".units li").count() in (0, 3)


def test_on_a_phone_rows_are_cards(page):
    page.set_viewport_size({"width": 390, "height": 900})
    page.wait_for_timeout(200)
    wide = page.evaluate(
        "[...document.querySelectorAll('main table.stack')].filter(t => t.offsetParent)"
        ".filter(t => t.scrollWidth > t.parentElement.clientWidth + 1).length"
    )
    assert wide == 0, "a table is wider than the phone"
    rows = page.locator("main section.method h3[id^=cases-] + .scroll tbody tr")
    # The reason and the command are as long as the numbers and paths in them, but take the whole width of the card;
    # the figures above them take three lines or fewer.
    cards = rows.evaluate_all(
        """all => all.filter(r => r.offsetParent).map(r => [r, r.querySelector("td.wrap")])
            .map(([r, words]) => [r.offsetHeight - words.offsetHeight, words.offsetWidth / r.offsetWidth])"""
    )
    assert max((figures for figures, _ in cards), default=0) <= 100, cards
    assert min((width for _, width in cards), default=1) >= 0.9, cards
    signs = page.locator("main table.stack .sign").evaluate_all(
        "all => all.filter(e => e.offsetParent).map(e => e.getBoundingClientRect().right)"
    )
    assert max(signs, default=0) <= 390


def test_print(page):
    page.emulate_media(media="print", color_scheme="dark")
    assert not page.locator(".bar").is_visible()
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    page.emulate_media(media="screen", color_scheme="light")


def test_every_link_of_the_contents_leads_somewhere(page):
    lost = page.evaluate(
        "[...document.querySelectorAll('.toc a')].map(a => a.hash.slice(1))"
        ".filter(id => document.querySelectorAll(`[id='${CSS.escape(id)}']`).length !== 1)"
    )
    assert page.locator(".toc a").count() > 2 and lost == []
