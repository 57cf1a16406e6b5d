"""Tests how the pages print: on A4, without the backgrounds that browsers leave out by default.

The PDF that Chromium makes shows it: colours, and what stands on which sheet.
"""

import base64
import re
import subprocess
import zlib
from collections import Counter

import pytest

from conftest import ROOT

STUDY = """
models = ["CR", "CDR", "CDR Eq. 14"]
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 8 }
records = { synthetic = { count = 2, duration = 12, step = 0.02 } }
report = { resamples = 100 }
walls = [
  { name = "3", geometry = { height = 3, thickness = 0.3 } },
  { name = "a slender wall", geometry = { height = 4, thickness = 0.3 } },
]
"""
SCENE = """
[check]
code = "fractions"
spectrum = [[0, 2], [0.1, 5], [0.4, 5], [1, 2], [2, 1], [4, 0.25]]
unit = "m/s2"
"""
# Arguments of `wall` in a folder with study.toml and scene.toml, and coloured boxes that the page has at
# least: swatches, lines of a key, intervals, shaded cells. {} is the page. Pages without arguments are those
# of other tests.
PAGES = {
    "simulate": ("simulate --synthetic --html {}", 0),
    "full rotations": ("simulate --set force_law=rigid_linear --set damping_model=none "
                       "--set impact=restitution --synthetic --html {}", 0),
    "building": (None, 10),
    "study": ("study ida study.toml -o out", 6),
    "spectrum": ("study spectrum --synthetic --heights 1:6:6 --ratios 5:20:6 --html {}", 1),
    "stability": ("verify stability --columns 2 --html {}", 0),
    "calibration": (None, 0),
    "reproduction": (None, 20),
    "check report": (f"check {ROOT / 'scenes/checked_parapet.toml'} --report {{}}", 0),
    "check": ("check scene.toml --report {}", 0),
    "accuracy": (f"verify accuracy {ROOT / 'scenes/plain_parapet.toml'} --budget 0.001 --html {{}}", 3),
    "playground": (None, 0),
}  # fmt: skip
# A4 between Chromium's margins of 1 cm, in px
WIDTH = round((210 - 20) / 25.4 * 96)


@pytest.fixture(scope="module", params=PAGES)
def page(request, browser, wall, tmp_path_factory):
    """A page in the browser that a reader in the dark is about to print, and its least coloured boxes."""
    arguments, boxes = PAGES[request.param]
    folder = tmp_path_factory.mktemp("paper")
    path = folder / ("out/study.html" if request.param == "study" else "page.html")
    if arguments is None:
        path = request.getfixturevalue(request.param)
    else:
        (folder / "study.toml").write_text(STUDY)
        (folder / "scene.toml").write_text(SCENE)
        command = [wall, *(part.format(path) for part in arguments.split())]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
    dark = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print", "features": dark})
    metrics = {"width": WIDTH, "height": 1000, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    browser.get(path.as_uri())
    browser.execute_async_script(
        "const done = arguments[0];"
        "const wait = () => window.playground?.timings.length === 0 ? setTimeout(wait, 20) : done(); wait();"
    )
    return browser, boxes


def sheets(browser, backgrounds=False):
    """Prints the page; colours from 0 to 255 of the boxes and of the texts on each sheet."""
    paper = {"paperWidth": 8.27, "paperHeight": 11.69, "printBackground": backgrounds}
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", paper)["data"])
    found = []
    for start in re.finditer(rb"stream\r?\n", pdf):
        try:
            content = zlib.decompressobj().decompress(pdf[start.end() :])
        except zlib.error:
            continue
        # sheets begin with Skia's scale from its pixels to points; fonts and symbols do not
        if content.startswith(b".23999999 0 0 -.23999999"):
            found.append(colours(content.decode("latin-1").splitlines()))
    return found


def colours(lines):
    boxes, texts, fill, saved, before = Counter(), set(), (0, 0, 0), [], ""
    for line in lines:
        if line == "q":
            saved.append(fill)
        elif line == "Q":
            fill = saved.pop()
        elif line.endswith(" rg"):
            fill = tuple(round(255 * float(part)) for part in line.split()[-4:-1])
        elif line == "f" and before.endswith(" re"):
            boxes[fill] += 1
        elif line.endswith("Tj"):
            texts.add(fill)
        before = line
    return boxes, texts


def channels(text):
    """The colour of `rgb(r, g, b)`; None where it is transparent."""
    parts = re.findall(r"[\d.]+", text)
    return None if len(parts) == 4 else tuple(map(int, parts))


def test_swatches_intervals_and_marks_are_printed(page):
    browser, least = page
    # without the drawings, whose colours are the same
    backgrounds, marks = browser.execute_script(
        "document.head.insertAdjacentHTML('beforeend', '<style id=probe>svg { visibility: hidden }</style>');"
        "const shown = query => [...document.querySelectorAll(query)].filter(one => one.checkVisibility());"
        "const isLine = one => one.matches('.line') && getComputedStyle(one).borderTopStyle === 'solid';"
        "const side = one => isLine(one) ? 'borderTopColor' : 'backgroundColor';"
        "return [shown('i.chip, tr.FAIL').map(one => getComputedStyle(one)[side(one)]),"
        "  shown('b.chip').map(one => getComputedStyle(one).color)];"
    )
    printed = sheets(browser)
    browser.execute_script("document.getElementById('probe').remove()")
    expected = Counter(color for color in map(channels, backgrounds) if color not in (None, (255, 255, 255)))
    boxes = sum((boxes for boxes, _ in printed), Counter())
    assert expected.total() >= least
    assert not expected - boxes
    assert set(map(channels, marks)) <= set().union(*(texts for _, texts in printed))


def test_captions_stay_with_their_figures(page):
    browser, _ = page
    # figure n: a box of (n, 2, 1) behind its caption, of (n, 2, 2) behind its drawing
    count = browser.execute_script(
        "document.head.insertAdjacentHTML('beforeend', '<style id=probe>svg > * { visibility: hidden }"
        "  svg { border-radius: 0 !important; filter: none !important }</style>');"
        "let n = 0;"
        "for (const figure of document.querySelectorAll('figure')) {"
        "  const drawing = [...figure.querySelectorAll('svg')].find(one => one.checkVisibility());"
        "  if (!drawing || !figure.checkVisibility()) { continue; }"
        "  const caption = figure.querySelector('figcaption');"
        "  if (caption) { caption.style.background = `rgb(${n}, 2, 1)`; }"
        "  drawing.style.background = `rgb(${n}, 2, ${caption ? 2 : 3})`;"
        "  n += 1;"
        "}"
        "return n;"
    )
    places = {}
    for sheet, (boxes, _) in enumerate(sheets(browser, backgrounds=True)):
        for color in boxes:
            places.setdefault(color, set()).add(sheet)
    assert 0 < count < 256
    for n in range(count):
        drawing = places.get((n, 2, 2)) or places[n, 2, 3]
        assert len(drawing) == 1, n
        assert (n, 2, 3) in places or places[n, 2, 1] == drawing, n


def test_nothing_is_cut_and_no_control_is_printed(page):
    browser, _ = page
    beyond, controls = browser.execute_script(
        "const name = one => `${one.tagName} ${one.id} ${one.className} ${one.textContent.slice(0, 30)}`;"
        "const all = query => [...document.querySelectorAll(query)].filter(one => one.checkVisibility());"
        "return [all('body *:not(svg *)').filter(one => one.getBoundingClientRect().right > arguments[0] + 1)"
        "    .map(name),"
        "  all('button, input[type=range], input[type=file], progress, nav, details:not([open])').map(name)]",
        WIDTH,
    )
    assert beyond == [] and controls == []
    # what is chosen is printed as text
    borders = browser.execute_script(
        "return [...document.querySelectorAll('select, input[type=text]')]"
        "  .map(one => getComputedStyle(one).borderTopWidth)"
    )
    assert set(borders) <= {"0px"}
