"""Tests the pages of `wall verify paper` and `wall study calibrate` in a browser.

They load without errors and fit narrow and wide windows.
"""

import subprocess

import pytest
from selenium.webdriver.common.by import By


@pytest.fixture(scope="module")
def calibration(wall, tmp_path_factory):
    path = tmp_path_factory.mktemp("calibrate") / "calibration.html"
    command = [wall, "study", "calibrate", "--restitution", "0.84,0.92", "--a1", "0.02,0.05", "--html", path]
    subprocess.run(command, check=True, capture_output=True)
    return path


@pytest.fixture(params=["reproduction", "calibration"])
def page(request):
    return request.getfixturevalue(request.param)


def test_the_page_loads_clean(browser, page):  # noqa: F811
    browser.get_log("browser"), browser.get_log("performance")
    browser.get(page.as_uri())
    assert browser.get_log("browser") == []
    requests = [
        entry["message"]
        for entry in browser.get_log("performance")
        if "Network.requestWillBeSent" in entry["message"]
    ]
    assert not [request for request in requests if '"url":"http' in request]
    assert page.stat().st_size < 3 * 2**20


@pytest.mark.parametrize("width", [420, 1600])
def test_nothing_overflows(browser, page, width):  # noqa: F811
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False},
    )
    browser.get(page.as_uri())
    inner, content = browser.execute_script(
        "return [window.innerWidth, document.documentElement.scrollWidth]"
    )
    assert inner == width
    assert content <= inner


def test_every_figure_is_drawn_inside_its_frame(browser, reproduction):  # noqa: F811
    browser.get(reproduction.as_uri())
    numbers = [link.text for link in browser.find_elements(By.CSS_SELECTOR, "nav a")]
    assert numbers == [str(number) for number in range(2, 16)]
    for number in numbers:
        drawings = browser.find_elements(By.CSS_SELECTOR, f"#figure-{number} figure svg")
        assert drawings, number
        # a label or a mark beyond the drawing's edge would be cut off
        outside = browser.execute_script(
            """return arguments[0].flatMap(svg => {
                const frame = svg.getBoundingClientRect();
                return [...svg.querySelectorAll("text")].filter(text => {
                    const box = text.getBoundingClientRect();
                    return box.left < frame.left - 1 || box.right > frame.right + 1
                        || box.top < frame.top - 1 || box.bottom > frame.bottom + 1;
                }).map(text => text.textContent);
            })""",
            drawings,
        )
        assert outside == [], (number, outside)


def test_each_number_stands_beside_print(browser, reproduction):  # noqa: F811
    browser.get(reproduction.as_uri())
    rows = browser.find_elements(By.XPATH, "//section[h2[starts-with(., 'Table 5')]]//tbody/tr")
    # e_an of wall 1: printed, computed with one digit more, deviation
    cells = [cell.text for cell in rows[0].find_elements(By.CSS_SELECTOR, "td.number")]
    assert cells == ["0.942", "0.9423", "0.0003"]
    # 0.030 percentage points below the printed value: CDR, which is known to disagree, is shaded
    assert [row.get_attribute("class") for row in rows[:4]] == ["", "", "", "FAIL"]
