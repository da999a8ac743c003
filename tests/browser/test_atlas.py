"""The atlas's page: maps, their two measures, the diagram, the filter of claims."""


def test_maps(visit):
    page = visit("atlas")
    maps = page.locator("#atlas-maps figure")
    assert maps.count() > 20
    image = lambda: maps.nth(5).locator("image").get_attribute("href")
    norm = image()
    page.get_by_role("button", name="of each part").click()
    assert image() != norm
    assert page.locator("#atlas-keys span").count() > 8
    svg = maps.first.locator("svg")
    svg.focus()
    page.keyboard.press("ArrowRight")
    assert "at most 10" in maps.first.locator("output").inner_text() or "e-" in maps.first.locator("output").inner_text()


def test_work(visit):
    page = visit("atlas")
    figures = page.locator("#atlas-work figure")
    assert figures.count() == 3
    svg = figures.first.locator("svg")
    svg.focus()
    page.keyboard.press("ArrowRight")
    assert " ns, " in figures.first.locator("output").inner_text()


def test_claims_are_filtered(visit):
    page = visit("atlas")
    claims = page.locator(".claim")
    whole = claims.count()
    page.locator("button[data-verdict='refuted']").click()
    shown = [claims.nth(k).is_visible() for k in range(whole)]
    assert 0 < sum(shown) < whole
