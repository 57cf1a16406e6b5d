"""Makes the page of coupling errors: logarithmic plots as SVG, in the style of the other pages."""

import html
import math
from pathlib import Path

WIDTH, HEIGHT = 440, 300
LEFT, RIGHT, TOP, BOTTOM = 62, 12, 12, 44
COLORS = {
    "Jacobi": "#c8440f",
    "Jacobi, loop closed": "#e08a00",
    "Gauss-Seidel": "#7b1fa2",
    "iterated": "#1f5fa8",
}
WALL_COLORS = {"strip": "#1f5fa8", "parapet": "#c8440f"}

STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.45 system-ui, sans-serif; color: #222; margin: 0 auto; max-width: 1360px; padding: 16px; }
h1 { font-size: 1.5rem; margin: .2em 0; }
h2 { font-size: 1.15rem; margin: 1.2em 0 .3em; }
p { max-width: 50em; margin: .4em 0; }
.key span { display: inline-block; margin-right: 1.4em; }
.key i { display: inline-block; width: 1.1em; height: .75em; margin-right: .4em; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 400px), 1fr));
  gap: 18px; margin-top: 6px; }
figure { margin: 0; border: 1px solid #ddd; border-radius: 6px; padding: 8px; }
figcaption { font-size: .92rem; }
svg { width: 100%; height: auto; display: block; font: 12px system-ui, sans-serif; }
@media screen and (prefers-color-scheme: dark) {
  body { color: #e8e6e3; background: #161616; }
  figure { border-color: #3d3d3d; }
  svg, .key i { filter: invert(.9) hue-rotate(180deg); }
}
"""

# how all pages print
PAPER = (Path(__file__).parents[2] / "crates/report/src/paper.css").read_text(encoding="utf-8")

INTRODUCTION = """
<h1>Walls on floors: error against communication step and run time</h1>
<p>Each point is one scheme at one communication step. The error is the largest error of any displacement over
the peak of that displacement; the reference is the same system integrated as one. Filled marks and full lines
show linear inputs, open marks and dashed lines held inputs. Lower is better. A run whose error exceeds the
peak is lost and not shown. The grey lines have the slopes of order 1 and 2.</p>
<p>Run times are processor times of the master in Python (examples/coupling) for one simulated second. Point
at a mark to see its numbers.</p>
"""


def text(rows, accident, duration):
    """Returns the page; `rows` are those of `measure`."""
    parts = ['<!doctype html>\n<html lang="en">\n<meta charset="utf-8">']
    parts.append('<meta name="viewport" content="width=device-width, initial-scale=1">')
    parts.append(f"<title>Coupling error</title>\n<style>{STYLE}{PAPER}</style>{INTRODUCTION}")
    keys = "".join(f'<span><i style="background:{color}"></i>{name}</span>' for name, color in COLORS.items())
    parts.append(f'<p class="key">{keys}</p>')
    for name in dict.fromkeys(row[0] for row in rows):
        own = [
            (s, step * 1e3, error, seconds / duration * 1e3)
            for n, s, step, error, seconds in rows
            if n == name
        ]
        lost = [
            s
            for s in dict.fromkeys(row[0] for row in own)
            if all(math.isnan(row[2]) for row in own if row[0] == s)
        ]
        note = f"<p>Lost at every step: {html.escape('; '.join(lost))}.</p>" if lost else ""
        by_step = logarithmic(
            [(s, step, error) for s, step, error, _ in own], "communication step [ms]", slopes=True
        )
        by_time = logarithmic([(s, cost, error) for s, _, error, cost in own], "run time for 1 s [ms]")
        parts.append(
            f"<h2>{html.escape(name)}</h2>{note}"
            f"<main><figure>{by_step}</figure><figure>{by_time}</figure></main>"
        )
    parts.append(fallen(*accident))
    return "\n".join(parts) + "\n</html>\n"


def decades(values):
    """Returns the decades that contain the values, at least one."""
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


class Axes:
    """Axes of a plot: they map values to positions in the drawing."""

    def __init__(self, x, y, x_label, y_label, ticks_x, ticks_y, label_x, label_y):
        self.x, self.y = x, y
        self.svg = [
            f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{y_label} against {x_label}">'
        ]
        for tick in ticks_x:
            place = self.across(tick)
            self.svg.append(
                f'<line x1="{place:.1f}" x2="{place:.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#eee"/>'
            )
            self.svg.append(
                f'<text x="{place:.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">'
                f"{label_x(tick)}</text>"
            )
        for tick in ticks_y:
            place = self.up(tick)
            self.svg.append(
                f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{place:.1f}" y2="{place:.1f}" stroke="#eee"/>'
            )
            self.svg.append(
                f'<text x="{LEFT - 6}" y="{place + 4:.1f}" text-anchor="end">{label_y(tick)}</text>'
            )
        box = f'x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{HEIGHT - TOP - BOTTOM}"'
        self.svg.append(f'<rect {box} fill="none" stroke="#999"/>')
        middle = (LEFT + WIDTH - RIGHT) / 2
        self.svg.append(f'<text x="{middle}" y="{HEIGHT - 8}" text-anchor="middle">{x_label}</text>')
        middle = (TOP + HEIGHT - BOTTOM) / 2
        self.svg.append(
            f'<text transform="translate(14 {middle}) rotate(-90)" text-anchor="middle">{y_label}</text>'
        )

    def across(self, value):
        low, high = self.x
        return LEFT + (value - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def up(self, value):
        low, high = self.y
        return HEIGHT - BOTTOM - (value - low) / (high - low) * (HEIGHT - TOP - BOTTOM)

    def line(self, points, color, dashed=False, width=1.3):
        path = " ".join(f"{self.across(x):.1f},{self.up(y):.1f}" for x, y in points)
        dashes = ' stroke-dasharray="5 3"' if dashed else ""
        self.svg.append(
            f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"{dashes}/>'
        )

    def close(self):
        return "".join(self.svg) + "</svg>"


def superscript(exponent):
    return f'10<tspan dy="-4" font-size="9">{"−" if exponent < 0 else ""}{abs(exponent)}</tspan>'


def tick_label(value):
    """Formats a number on a logarithmic axis without an exponent."""
    return f"{10**value:.6g}"


def logarithmic(points, x_label, slopes=False):
    """Plots error over the peak against x, one line for each scheme."""
    shown = [(scheme, x, error) for scheme, x, error in points if math.isfinite(error)]
    bottom, top = decades([error for _, _, error in shown])
    values = [math.log10(x) for _, x, _ in shown]
    low, high = min(values), max(values)
    margin = 0.06 * (high - low)
    ticks = [math.log10(k * 10**d) for d in range(math.floor(low), math.ceil(high) + 1) for k in (1, 2, 5)]
    ticks = [tick for tick in ticks if low - margin <= tick <= high + margin]
    axes = Axes(
        (low - margin, high + margin),
        (bottom, top),
        x_label,
        "largest error/peak",
        ticks,
        range(bottom, top + 1),
        tick_label,
        superscript,
    )
    if slopes:
        # in the lower right corner, which is free of data
        start, length, base = high - 0.35 * (high - low), 0.35 * (high - low), bottom + 0.03 * (top - bottom)
        for order in (1, 2):
            end = base + order * length
            axes.line([(start, base), (high, end)], "#aaa", width=1)
            axes.svg.append(
                f'<text x="{axes.across(high) + 4:.1f}" y="{axes.up(end) + 4:.1f}" fill="#777">{order}</text>'
            )
    for scheme in dict.fromkeys(row[0] for row in shown):
        name, _, treatment = scheme.rpartition(", ")
        color, held = COLORS[name], treatment == "held"
        own = [(math.log10(x), math.log10(error), x, error) for s, x, error in shown if s == scheme]
        axes.line([(x, y) for x, y, _, _ in own], color, dashed=held)
        for x, y, raw, error in own:
            fill = "#fff" if held else color
            words = f"{scheme}: error {error:.1e} at {raw:.3g} ms"
            axes.svg.append(
                f'<circle cx="{axes.across(x):.1f}" cy="{axes.up(y):.1f}" r="3.6" fill="{fill}" '
                f'stroke="{color}" stroke-width="1.4">'
                f"<title>{words}</title></circle>"
            )
    return axes.close()


def fallen(times, histories, events):
    """Plots the walls of a building in which one overturns."""
    who = "; ".join(f"The {name} overturned at t = {moment:.4f} s" for name, moment in events)
    axes = Axes(
        (0.0, times[-1]),
        (-1.0, 3.0),
        "time [s]",
        "u/u_ins",
        [0, 0.5, 1.0, 1.5, 2.0],
        range(-1, 4),
        lambda t: f"{t:g}",
        lambda u: f"{u}".replace("-", "−"),
    )
    for name, history in histories.items():
        points = [(t, u) for t, u in zip(times, history) if -1 <= u <= 3]
        axes.line(points, WALL_COLORS[name], width=1.5)
    for name, moment in events:
        axes.line([(moment, -1.0), (moment, 3.0)], WALL_COLORS[name], dashed=True, width=1)
    keys = "".join(
        f'<span><i style="background:{color}"></i>{name}</span>' for name, color in WALL_COLORS.items()
    )
    return (
        f"<h2>A wall overturns in the building</h2><p>{html.escape(who)}. Once a wall has left its support, "
        "its reaction is 0. The rest of the building continues.</p>"
        f'<p class="key">{keys}</p><main><figure>{axes.close()}</figure></main>'
    )
