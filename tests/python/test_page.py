"""Tests the page in a browser.

It loads without errors, its slider moves the wall and the cursors, and it fits narrow and wide windows.
"""

import subprocess
import time

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By


def make(wall, path, *arguments):
    subprocess.run([wall, "simulate", *arguments, "--html", path], check=True, capture_output=True)
    return path


@pytest.fixture(scope="module")
def parapet(wall, tmp_path_factory):
    return make(wall, tmp_path_factory.mktemp("page") / "parapet.html", "--synthetic", "--pga", "2.5")


@pytest.fixture(scope="module")
def strip(wall, tmp_path_factory):
    settings = ["--set", "mechanism=vertical_spanning", "--set", "thickness=0.2", "--set", "u_start=0.15"]
    return make(wall, tmp_path_factory.mktemp("page") / "strip.html", *settings)


@pytest.fixture(scope="module")
def fallen(wall, tmp_path_factory):
    return make(wall, tmp_path_factory.mktemp("page") / "fallen.html", "--synthetic")


def move(browser, part):
    """Moves the slider to a fraction of its range, as a user does."""
    browser.execute_script(
        "const s = document.getElementById('time'); s.value = Math.round(arguments[0] * s.max);"
        "s.dispatchEvent(new Event('input'));",
        part,
    )


def transform(browser, body):
    return browser.find_element(By.ID, body).get_attribute("transform")


def test_the_page_loads_clean(browser, parapet):
    browser.get_log("browser"), browser.get_log("performance")
    browser.get(parapet.as_uri())
    assert browser.get_log("browser") == []
    requests = [
        entry["message"]
        for entry in browser.get_log("performance")
        if "Network.requestWillBeSent" in entry["message"]
    ]
    assert not [request for request in requests if '"url":"http' in request]
    assert "parapet" in browser.title


def test_the_slider_moves_the_wall_and_the_cursors(browser, parapet):
    browser.get(parapet.as_uri())
    seen = set()
    for part in (0.0, 0.2, 0.215, 0.25):
        move(browser, part)
        cursor = browser.find_element(By.CSS_SELECTOR, "#history .cursor")
        plot = browser.find_element(By.ID, "history")
        seen.add(transform(browser, "lower"))
        shown = float(browser.find_element(By.ID, "now_0").text)
        # the plot area of the figure, and the time axis from 0 to 40 s
        left, right, _, _ = browser.execute_script("return JSON.parse(arguments[0].dataset.area)", plot)
        expected = plot.rect["x"] + plot.rect["width"] * (left + (right - left) * shown / 40.0)
        assert abs(cursor.rect["x"] - expected) < 2.0, part
    assert len(seen) == 4


def test_both_bodies_of_a_strip_turn_against_each_other(browser, strip):
    browser.get(strip.as_uri())
    angles = []
    for body in ("lower", "upper"):
        text = transform(browser, body)
        angles.append(float(text.split("rotate(")[1].split()[0]))
    assert angles[0] * angles[1] < 0


def test_play_moves_on_and_pauses(browser, parapet):
    browser.get(parapet.as_uri())
    button = browser.find_element(By.ID, "play")
    button.click()
    assert button.text == "Pause"
    deadline = time.monotonic() + 20
    while float(browser.find_element(By.ID, "now_0").text) < 0.3:
        assert time.monotonic() < deadline, "nothing moves"
        time.sleep(0.05)
    button.click()
    assert button.text == "Play"
    now = browser.find_element(By.ID, "now_0").text
    time.sleep(0.3)
    assert browser.find_element(By.ID, "now_0").text == now


@pytest.mark.parametrize("width", [420, 1600])
def test_nothing_overflows(browser, parapet, width):
    # a headless window may refuse to be narrow; the device metrics do not
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False},
    )
    browser.get(parapet.as_uri())
    inner, content = browser.execute_script(
        "return [window.innerWidth, document.documentElement.scrollWidth]"
    )
    assert inner == width
    assert content <= inner


def test_overturning_is_marked(browser, fallen):
    browser.get(fallen.as_uri())
    assert browser.find_elements(By.CSS_SELECTOR, "#history .mark")
    assert browser.find_element(By.ID, "overturned").text == ""
    move(browser, 1.0)
    assert browser.find_element(By.ID, "overturned").text.startswith("overturned at t = ")


def test_the_page_of_a_building_opens_with_its_verdict(browser, building):
    browser.get_log("browser"), browser.get_log("performance")
    browser.get(building.as_uri())
    assert browser.get_log("browser") == []
    assert not any('"url":"http' in entry["message"] for entry in browser.get_log("performance"))
    assert " falls at " in browser.find_element(By.CSS_SELECTOR, ".verdict").text
    assert float(browser.find_element(By.ID, "now_0").text) > 1.0


def test_storeys_and_walls_of_a_building_move(browser, building):
    browser.get(building.as_uri())
    seen = set()
    for part in (0.0, 0.3, 0.32, 0.34):
        move(browser, part)
        moved = browser.find_elements(By.CSS_SELECTOR, "#scene g, #scene rect.body")
        cursor = browser.find_element(By.CSS_SELECTOR, "#floors .cursor").get_attribute("style")
        seen.add((cursor, *[str(element.get_attribute("transform")) for element in moved]))
    assert len(seen) == 4


@pytest.mark.parametrize("width", [390, 1600])
def test_a_building_fits_the_window(browser, building, width):
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False},
    )
    browser.get(building.as_uri())
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width


@pytest.fixture(params=["fallen", "building"])
def moving(request):
    """A page on which walls fall."""
    return request.getfixturevalue(request.param)


def test_slider_and_histories_end_together(browser, moving):
    browser.get(moving.as_uri())
    times, ends = browser.execute_script(
        "return [JSON.parse(document.getElementById('data').textContent).t,"
        "  [...document.querySelectorAll('.cursor')]"
        "    .map(cursor => JSON.parse(cursor.parentElement.dataset.ranges)[1])]"
    )
    assert len(ends) >= 4
    for end in ends:
        # to a frame, and to the five digits of the times
        assert abs(times[-1] - end) <= times[1] + 5e-5 * end


def test_a_click_on_a_history_moves_the_wall_there(browser, moving):
    browser.get(moving.as_uri())
    plot = next(plot for plot in browser.find_elements(By.CSS_SELECTOR, ".plot.wide:has(.cursor)"))
    left, right, _, _ = browser.execute_script("return JSON.parse(arguments[0].dataset.area)", plot)
    end = browser.execute_script("return JSON.parse(arguments[0].dataset.ranges)[1]", plot)
    seen = set()
    for part in (0.3, 0.7):
        across = plot.rect["width"] * (left + (right - left) * part - 0.5)
        ActionChains(browser).move_to_element_with_offset(plot, across, 0).click().perform()
        now = float(browser.find_element(By.CSS_SELECTOR, ".now b").text)
        # two pixels and a frame
        assert abs(now - part * end) < 0.01 * end
        seen.add(browser.find_element(By.ID, "time").get_property("value"))
    assert len(seen) == 2


STUDY = """
models = ["CR", "CDR", "CDR Eq. 14"]
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 8 }
records = { synthetic = { count = 4, duration = 12, step = 0.01 } }
report = { resamples = 200 }
walls = [{ name = "3", geometry = { height = 3, thickness = 0.3 }, force_law = { a1 = 0.009 } }]
"""


@pytest.fixture(scope="module")
def study(wall, tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    (folder / "study.toml").write_text(STUDY)
    command = [wall, "study", "ida", "study.toml", "-o", "out"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return folder / "out/study.html"


@pytest.mark.parametrize("width", [420, 1600])
def test_the_page_of_a_study(browser, study, width):
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False},
    )
    browser.get_log("browser"), browser.get_log("performance")
    browser.get(study.as_uri())
    assert browser.get_log("browser") == []
    requests = [
        entry["message"]
        for entry in browser.get_log("performance")
        if "Network.requestWillBeSent" in entry["message"]
    ]
    assert not [request for request in requests if '"url":"http' in request]
    inner, content = browser.execute_script(
        "return [window.innerWidth, document.documentElement.scrollWidth]"
    )
    assert content <= inner == width
    # the collapse, the curves of three models, three fractions; each has something drawn inside its axes
    plots = browser.find_elements(By.CSS_SELECTOR, "svg")
    assert len(plots) == 1 + 3 + 3
    assert all(plot.find_elements(By.CSS_SELECTOR, "g path") for plot in plots)
    rows = [row.text for row in browser.find_elements(By.CSS_SELECTOR, ".scroll > table tbody tr")]
    # the list of collapses is folded
    assert [row.split()[0] for row in rows if row] == ["CR", "CDR", "CDR"]


def test_the_page_of_many_walls_fits_a_phone(browser, wall, tmp_path):
    rows = "".join(f"wall {k},{2 + 0.05 * k},0.3\n" for k in range(41))
    (tmp_path / "walls.csv").write_text(f"name,height,thickness\n{rows}")
    (tmp_path / "study.toml").write_text(
        'models = ["CR", "CDC"]\nlevels = { method = "step", step = 0.4, top = 2 }\n'
        "records = { synthetic = { count = 2, duration = 10, step = 0.02 } }\n"
        'report = { resamples = 100 }\nwalls = [{ table = "walls.csv" }]\n'
    )
    command = [wall, "study", "ida", "study.toml", "-o", "out"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": 390, "height": 1000, "deviceScaleFactor": 1, "mobile": False},
    )
    browser.get((tmp_path / "out/study.html").as_uri())
    assert browser.execute_script("return document.documentElement.scrollWidth") <= 390


def test_the_rocking_spectrum_loads_clean_and_shows_every_wall(browser, wall, tmp_path):
    path = tmp_path / "spectrum.html"
    ranges = ["--heights", "1:6:21", "--ratios", "5:20:16"]
    subprocess.run(
        [wall, "study", "spectrum", "--synthetic", *ranges, "--html", path], check=True, capture_output=True
    )
    browser.get_log("browser")
    browser.get(path.as_uri())
    assert browser.get_log("browser") == []
    # in one question: a thousand would take ten seconds
    cells = browser.execute_script(
        "return [...document.querySelectorAll('figure g rect')].map((cell) => ["
        "cell.querySelector('title').textContent,"
        "cell.getBoundingClientRect().x, cell.getBoundingClientRect().y]);"
    )
    assert len(cells) == 21 * 16
    titles = [title for title, _, _ in cells]
    assert any("overturns at" in title for title in titles) and any(
        "u_max/u_ins = 0." in title for title in titles
    )
    # the first cell is at the lower left, the last at the upper right
    places = [(x, y) for _, x, y in cells]
    assert places[0] == (min(x for x, _ in places), max(y for _, y in places))
    assert places[-1] == (max(x for x, _ in places), min(y for _, y in places))
    assert path.stat().st_size < 3_000_000
