"""How safe walls are that just pass the Italian check: the walls and the tables of docs/reliability.md.

    python examples/python/passing_walls.py WALL FOLDER [RECORDS]

WALL is the program, FOLDER takes the studies and their results, RECORDS is a folder of accelerograms
(`RSN*.AT2`). It writes the tables into docs/reliability.md: those of the program's own motions, and with
RECORDS those of the recorded ones. A run that is stopped goes on when it is started again.
"""

import csv
import itertools
import math
import statistics
import subprocess
import sys
from pathlib import Path

DOCUMENT = Path(__file__).parents[2] / "docs/reliability.md"
WALLS = 42  # of a kind on one soil at one place
SYNTHETIC = "synthetic = { count = 30 }"
SOILS = "ABCD"
LIMIT = 0.1  # probability of a fall above which walls are counted
FACTORS = (1.35, 1)  # FC
BETA_M = 0.3  # a β of modelling
HELD_AT_BACK = 'before_activation = "rigid"\noverburden_mass = 0'
KINDS = {
    # models, what the check states, floors in the building, ranges of height (m) and of h/b
    "parapets": ('["CR", "CDR"]', 'before_activation = "law"', "bottom = 3", (0.6, 3), (3, 12)),
    "façades": ('["CR"]', HELD_AT_BACK, "bottom = 2", (4, 12), (8, 16)),
    "strips": ('["CR", "CDR"]', 'before_activation = "law"', "bottom = 2, top = 3", (2.5, 5), (8, 16)),
}
HUNT = 'method = "hunt", first = 0.05, increase = 0.05, top = 50'
# steps of 2 % from 0.02 to 8 g
STEPS = f'method = "grid", values = {[float(f"{0.02 * 1.02**k:.6g}") for k in range(304)]}'


def walls(kind):
    """Returns the walls of a kind as CSV: evenly spread by the first three generators of the R4 sequence.

    Half of the façades have no overburden, the others up to their weight; strips have up to five times
    theirs, and their hinge at the least α0, x = 1/(1 + √(O/(2 (W + O)))), at most 0.9.
    """
    # the root of x⁵ = x + 1; M. Roberts: The unreasonable effectiveness of quasirandom sequences, 2018
    root = 1.167303978261418684256
    lines = ["name,mechanism,height,thickness,density,overburden,hinge_ratio,a1,rocking,restitution_source"]
    for k in range(1, WALLS + 1):
        x, y, z = ((0.5 + k * root**-power) % 1 for power in (1, 2, 3))
        height, slenderness = (
            low + part * (high - low) for part, (low, high) in zip((x, y), KINDS[kind][3:], strict=True)
        )
        over = {"parapets": 0.0, "façades": max(0.0, 2 * z - 1), "strips": 5 * z}[kind]
        thickness = height / slenderness
        weight = 1800 * 9.81 * height * thickness
        hinge = min(0.9, 1 / (1 + math.sqrt(over / (2 * (1 + over)))))
        mechanism, rocking, source, hinge = {
            "parapets": ("parapet", "two_sided", "", ""),
            "façades": ("parapet", "one_sided_positive", "analytic", ""),
            "strips": ("vertical_spanning", "two_sided", "", hinge),
        }[kind]
        cells = [f"{kind} {k}", mechanism, height, thickness, 1800, over * weight, hinge, 0.05, rocking]
        lines.append(",".join(map(str, [*cells, source])))
    return "\n".join(lines) + "\n"


def study(kind, soil, place, records, levels=None, more="", factor=1.35, models=None):
    """Returns the study of a kind on a soil, on the ground or in a building with T₁ = 0.3 s."""
    usual, check, supports, *_ = KINDS[kind]
    # FC below 1.35 needs hinges that are set back; this strength leaves them at the edges
    strength = "masonry_strength = 1e9\n" if factor < 1.35 else ""
    storey = "[[storeys]]\nmass = 1e5\nstiffness = 2.2e8\ndamping_ratio = 0.1\n"
    high = place == "storeys"
    damping = ", building_damping = 0.1" if high else ""
    return f"""models = {models or usual}
levels = {{ {levels or HUNT} }}
records = {{ {records} }}
intensity = {{ measure = "code" }}
report = {{ resamples = 200{more} }}
[check]
code = "circolare-2019"
{check}
confidence_factor = {factor}
{strength}\
soil = "{soil}"
SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32{damping} }}
SLC = {{ ag = 0.20, F0 = 2.45, TC = 0.33{damping} }}
{3 * storey if high else ""}[[walls]]
table = "{kind}.csv"
{f"supports = {{ {supports} }}" if high else ""}
"""


def falls(program, folder, name, text):
    """Computes a study, and returns the falls of its walls by check and model.

    Studies with the same runs share their folder, which is the part of the name before a comma.
    """
    for kind in KINDS:
        (folder / f"{kind}.csv").write_text(walls(kind), encoding="utf-8")
    file, table = folder / f"{name}.toml", folder / f"{name}.csv"
    if not table.exists() or not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")
        results = folder / name.partition(",")[0]
        subprocess.run([program, "study", "reliability", file, "-o", results], check=True)
        table.write_bytes((results / "reliability.csv").read_bytes())
    found = {}
    with table.open(encoding="utf-8") as rows:
        for row in csv.DictReader(rows):
            if row["event"] == "fall" and row["margin"]:
                keys = ("margin", "probability", "probability_low", "probability_high")
                fall = {key: float(row[key]) for key in (*keys, "ag_code_g", "theta_g", "beta")}
                found.setdefault((row["check"], row["model"]), []).append(fall)
    return found


def fractile(values, percent):
    """Returns the value that some per cent of the values do not exceed."""
    values = sorted(values)
    return values[max(1, math.ceil(percent * len(values) / 100)) - 1]


def above(probabilities):
    """Returns the share of probabilities above the limit."""
    probabilities = list(probabilities)
    return f"{100 * sum(p > LIMIT for p in probabilities) / len(probabilities):.0f} %"


def row(*cells):
    """Returns a row of a table."""
    return f"| {' | '.join(cells)} |\n"


def head(*cells):
    """Returns the first lines of a table."""
    return "\n" + row(*cells) + "|" + len(cells) * "---|" + "\n"


def shown(found):
    """Returns the cells of a table: fractiles of margins and probabilities, and the share above the limit."""
    margins, probabilities = ([fall[key] for fall in found] for key in ("margin", "probability"))
    cells = [f"{fractile(margins, percent):.2f}" for percent in (5, 50, 95)]
    cells += [f"{fractile(probabilities, percent):.3f}" for percent in (50, 95)]
    return *cells, above(probabilities)


COLUMNS = ("θ/a_g,code: 5 %", "50 %", "95 %", "P(fall): 50 %", "95 %", f"P > {LIMIT}")


def with_modelling(fall, beta):
    """Returns the probability of a fall with a β of modelling."""
    z = math.log(fall["margin"]) / math.hypot(fall["beta"], beta)
    return 0.5 * math.erfc(z / math.sqrt(2))


def tables(program, folder, records):
    """Returns the tables under some motions."""
    folder.mkdir(parents=True, exist_ok=True)
    everything = {}
    for kind, soil, place in itertools.product(KINDS, SOILS, ("ground", "storeys")):
        text = study(kind, soil, place, records)
        for key, value in falls(program, folder, f"{kind}_{soil}_{place}", text).items():
            everything[kind, place, soil, *key] = value

    def some(*wanted):
        """Returns the falls whose keys are those wanted, where these are stated."""
        values = (
            value
            for key, value in everything.items()
            if all(want in (None, own) for want, own in zip(wanted, key, strict=True))
        )
        return list(itertools.chain(*values))

    groups = {(key[0], key[1], key[3], key[4]) for key in everything}
    groups = sorted(groups, key=lambda key: (list(KINDS).index(key[0]), key[1:]))
    text = head("walls", "place", "check", "model", *COLUMNS)
    for kind, place, check, model in groups:
        text += row(kind, place, check, model, *shown(some(kind, place, None, check, model)))
    text += "\nWith CR, soil by soil:\n" + head("walls", "place", "check", "soil", *COLUMNS)
    by_soil = [group[:3] for group in groups if group[3] == "CR" and group[2] != "SLV with q"]
    for (kind, place, check), soil in itertools.product(by_soil, SOILS):
        text += row(kind, place, check, soil, *shown(some(kind, place, soil, check, "CR")))
    text += "\nStoreys over ground, medians with CR:\n"
    text += head("walls", "check", "a_g,code: A", *"BCD", "θ: A", *"BCD")
    for kind, check in dict.fromkeys((kind, check) for kind, _, check in by_soil):
        cells = []
        for key, soil in itertools.product(("ag_code_g", "theta_g"), SOILS):
            high, low = (some(kind, place, soil, check, "CR") for place in ("storeys", "ground"))
            ratios = [one[key] / other[key] for one, other in zip(high, low, strict=True)]
            cells.append(f"{fractile(ratios, 50):.2f}")
        text += row(kind, check, *cells)
    return text


def changes(program, folder, records):
    """Returns the table of what FC and a β of modelling change, of parapets on the ground, with CR."""
    folder.mkdir(parents=True, exist_ok=True)
    columns = (f"FC {factor}{words}" for factor in FACTORS for words in ("", f", β_m {BETA_M}"))
    text = head("check", "soil", *columns)
    for soil in SOILS:
        found = {}
        for factor in FACTORS:
            name = f"parapets_{soil}_ground" + (f",FC{factor}" if factor < 1.35 else "")
            of_study = study("parapets", soil, "ground", records, factor=factor)
            found[factor] = falls(program, folder, name, of_study)
        for check in ("SLC", "SLV"):
            cells = []
            for factor in FACTORS:
                own = found[factor][check, "CR"]
                middle, low, high = (
                    f"{fractile([fall[key] for fall in own], 50):.3f}"
                    for key in ("probability", "probability_low", "probability_high")
                )
                wide = [with_modelling(fall, BETA_M) for fall in own]
                cells.append(f"{middle} ({low}–{high}), {above(fall['probability'] for fall in own)}")
                cells.append(f"{fractile(wide, 50):.3f}, {above(wide)}")
            text += row(check, soil, *cells)
    return text


def searches(program, folder, records):
    """Returns the table of what the search changes, of parapets on the ground, soil B, with CR."""
    folder.mkdir(parents=True, exist_ok=True)
    kind, soil, place = "parapets", "B", "ground"
    text = head("search", "collapse", "check", *COLUMNS)
    narrow = HUNT + ", gap = 0.03"
    for words, levels, name, collapse in (
        ("hunt, gaps of 10 %", HUNT, "", "first"),
        ("hunt, gaps of 3 %", narrow, "_gap", "first"),
        ("steps of 2 %", STEPS, "_steps", "first"),
        ("steps of 2 %", STEPS, "_steps", "last"),
        ("steps of 2 %", STEPS, "_steps", "fraction"),
    ):
        own = f"{kind}_{soil}_{place}{name},{collapse}"
        more = f', collapse = "{collapse}"'
        # the first shares the runs of the other tables
        models = '["CR"]' if name else None
        text_of_study = study(kind, soil, place, records, levels, more, models=models)
        found = falls(program, folder, own, text_of_study)
        for check in ("SLC", "SLV"):
            text += row(words, collapse, check, *shown(found[check, "CR"]))
    return text


# marks of the document, and their tables under recorded motions
RECORDED = {"changes": changes, "searches": searches, "recorded": tables}


def main(program, folder, records=None):
    """Computes the tables, and writes them into the document."""
    folder = Path(folder).resolve()
    made = [("synthetic", tables, "synthetic", SYNTHETIC)]
    if records:
        files = f"files = [{str(Path(records).resolve() / 'RSN*.AT2')!r}]"
        made += [(name, table, "recorded", files) for name, table in RECORDED.items()]
    for name, table_of, motions, source in made:
        table = table_of(program, folder / motions, source)
        document = DOCUMENT.read_text(encoding="utf-8")
        before, _, rest = document.partition(f"<!-- {name} -->\n")
        _, mark, after = rest.partition(f"\n<!-- end {name} -->")
        DOCUMENT.write_text(f"{before}<!-- {name} -->\n{table}{mark}{after}", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        print(__doc__)
        sys.exit()
    main(*sys.argv[1:4])
