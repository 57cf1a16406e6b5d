"""The options of a study: dictionaries with the keys of the tables of a study file.

Written by `cargo xtask generate python` from the schema of studies.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, Required, TypedDict, is_typeddict

from numpy.random import Generator


class Check(TypedDict, total=False):
    """Check of the wall by a code, which wall check reads.

    - SLC: Limit state of collapse.
    - SLD: Limit state of damage.
    - SLV: Limit state of life safety.
    - baseline: Scene of the state before an intervention, beside which the verdict stands.
    - before_activation: The wall before it rocks: held, elastic as its law, or a beam.
    - behaviour_factor: q of the linear check (-), at least 1; default 2.
    - building: The building; none on the ground.
    - code: The code: Circolare 7/2019 to NTC 2018.
    - compression_considered: Whether the hinges are set back for compression; default False.
    - confidence_factor: FC (-); below 1.35 only with compression_considered, at least 1; default 1.35.
    - crack_angles: Range in which the crack of wedges of transverse walls is searched [° from the vertical].
    - height_demand: Whether accelerations at a height up to T₁ are at least a_g S; default
      "not_below_ground".
    - hinge: Where the hinge of a strip is: at the least α0, for each check where it is least favourable, or
      as given; by default at the least α0 where the scene has no hinge_ratio.
    - hinge_levels: Heights above the base at which a façade may open [m]: the body above each is checked;
      default [0.0].
    - hinge_range: Range of hinge_ratio in which the hinge is searched (-); default [0.1, 0.9].
    - knowledge_level: Level of knowledge instead of FC.
    - masonry_gamma: γ that divides it (-), at least 1; default 1.
    - masonry_over_fc: Whether FC divides it, too; default True.
    - masonry_strength: Mean compressive strength f_m of the masonry in Pa, such as 1.5e6; hinges are set back
      for it, at least 100000.
    - method: What decides: displacement, q, or runs under records; default "nonlinear".
    - overburden_mass: Share r of the overburden whose mass moves with a parapet (-), at least 0.
    - polarities: Signs with which each record acts; default "both".
    - raise_slc: Whether SLD raises SLC, too, by analogy with SLV (C8.7.1.2.1.8); default False.
    - record_range: Periods between which records are held against the spectrum [s].
    - record_scale: What records become in the dynamic check: their peaks a_g S, as they are, or scaled to the
      spectrum of the ground; default "ag".
    - records: Records of the dynamic check, and of limit states without F0 and TC.
    - resultants: Resultants of the weights: one on each body, or one of its own weight and each moving load;
      default "body".
    - rocking: Sides to which the wall rocks in the static checks, in place of rocking of [impact].
    - site: The site on a grid of the hazard, for limit states without ag.
    - soil: Soil of NTC 3.2.2.
    - stress_block: κ of the rectangular stress block (-), above 0, at most 1; default 0.85.
    - target: ζ_E from which on a check passes (-): below 1 for an improvement (NTC 8.4.2, 8.4.3), above 0, at
      most 1; default 1.
    - tie: The tie in the check.
    - topography: Topography of NTC 3.2.2, or S_T (-); default "T1".
    - use_class: Use class of NTC 2.4.2; in class IV SLD decides too.
    - young_modulus: E of the masonry [Pa], for "beam", above 0.
    """

    SLC: LimitState
    SLD: LimitState
    SLV: LimitState
    baseline: str
    before_activation: Literal["rigid", "law", "beam"]
    behaviour_factor: float
    building: Building
    code: Required[Literal["circolare-2019"]]
    compression_considered: bool
    confidence_factor: float
    crack_angles: Sequence[float]
    height_demand: Literal["not_below_ground", "printed"]
    hinge: Literal["least_alpha0", "worst", "given"]
    hinge_levels: Sequence[float]
    hinge_range: Sequence[float]
    knowledge_level: Literal["LC1", "LC2", "LC3"]
    masonry_gamma: float
    masonry_over_fc: bool
    masonry_strength: float
    method: Literal["nonlinear", "linear", "dynamic"]
    overburden_mass: float
    polarities: Literal["both", "as_recorded"]
    raise_slc: bool
    record_range: Sequence[float]
    record_scale: Literal["ag", "none", "spectrum"]
    records: Records
    resultants: Literal["body", "each"]
    rocking: Literal["two_sided", "one_sided_positive", "one_sided_negative"]
    site: Site
    soil: Literal["A", "B", "C", "D", "E"]
    stress_block: float
    target: float
    tie: Tie
    topography: Literal["T1", "T2", "T3", "T4"] | float
    use_class: Literal["I", "II", "III", "IV"]
    young_modulus: float


class LimitState(TypedDict, total=False):
    """A limit state: its hazard, or the spectrum at the wall's place.

    - F0: F0 (-), at least 2.2.
    - TC: T_C* [s], above 0.
    - ag: a_g on rigid ground [g]; that of site unless given, above 0, at most 1.
    - building_damping: Damping ratio ξ_k of the building in this limit state (-); needed at height, above 0,
      at most 0.5.
    - building_period: First period of the building in this limit state [s], above 0.
    - damping: Damping ratio of the mechanism (-): 0.05, 0.08, 0.10 unless given, above 0, at most 0.5.
    - displacement: u of a local instability [m]; SLC only, above 0.
    - spectrum: Spectrum at the wall's place: points [T, Sa] in s and g.
    - spectrum_damping: Damping ratio of that spectrum (-), above 0.
    """

    F0: float
    TC: float
    ag: float
    building_damping: float
    building_period: float
    damping: float
    displacement: float
    spectrum: Sequence[Sequence[float]]
    spectrum_damping: float


class Building(TypedDict, total=False):
    """The building at the wall's height: storeys, period and height_ratio, or modes.

    - height_ratio: z/H: height of the wall over that of the building (-), 0 on the ground; with several
      hinge_levels one for each.
    - modes: Modes at the wall's place, the first first.
    - period: First period T₁ [s], above 0.
    - storeys: Number of storeys n, at least 1.
    """

    height_ratio: float | Sequence[float]
    modes: Sequence[Mode]
    period: float
    storeys: int


class Mode(TypedDict, total=False):
    """A mode of the building at the place of a wall.

    - participation: γ_k ψ_k(z): participation times shape there (-).
    - period: T_k [s], above 0.
    """

    participation: Required[float]
    period: Required[float]


class Records(TypedDict, total=False):
    """Records from files, and synthetic ones after them.

    - channel: Channel of records with several, by its number.
    - column: Column of tables (CSV or text).
    - component: Which of the two horizontal components of a list is taken; by default both, as two records,
      at least 1, at most 2.
    - files: Files, folders and patterns with * and ?, relative to the study file.
    - format: Format of the files, if their content does not tell.
    - pause: Time between the records of a sequence [s], at least 0, at most 1e+06; default 10.0.
    - selection: A list of records with scale factors and weights, as selectors write it: a table, or its
      folder.
    - sequences: Sequences of records that follow each other, such as a main shock and an aftershock: each a
      list of files, or of tables with options of their own. A list of one is a single record among them.
    - step: Time between samples [s], likewise.
    - synthetic: Synthetic motions.
    - unit: Unit: m/s2, cm/s2, mm/s2 or g, for files that do not state theirs.
    """

    channel: str
    column: str
    component: int
    files: Sequence[str]
    format: str
    pause: float
    selection: str
    sequences: Sequence[str | Record | Sequence[str | Record]]
    step: float
    synthetic: SyntheticRecords
    unit: str


class Record(TypedDict, total=False):
    """A record with options of its own.

    - channel: Channel of a record with several, by its number.
    - column: Column of a table (CSV or text).
    - fingerprint: Fingerprint of the record file, FNV-1a-128 in hexadecimal; a file that differs is refused.
    - format: Format of the record, found from its content if none is given.
    - pga: Peak acceleration to scale to, in m/s² or as a text with its unit, such as "0.3g".
    - record: Record file, beside the file that names it.
    - scale: Factor on the motion (-).
    - step: Time between samples (s), for a record that does not state it.
    - unit: Unit of the record: m/s2, cm/s2, mm/s2 or g (9.80665 m/s²); an AT2 file states its own.
    """

    channel: str
    column: str
    fingerprint: str
    format: str
    pga: float | str
    record: Required[str]
    scale: float
    step: float
    unit: str


class SyntheticRecords(TypedDict, total=False):
    """The project's synthetic motions, of consecutive seeds.

    - count: Number of records, at least 1, at most 10000.
    - duration: Length [s].
    - seed: Seed of the first one, at least 0.
    - step: Step [s].
    """

    count: Required[int]
    duration: float
    seed: int | Generator
    step: float


class Site(TypedDict, total=False):
    """A site on a grid of the hazard that the user brings.

    - ag_unit: Unit of its a_g; default "g".
    - coordinates: Latitude and longitude [°].
    - grid: File of the grid (CSV), or its lines: lon, lat and, for return periods T in years, ag_T, F0_T,
      TC_T.
    - nominal_life: Nominal life V_N [years], NTC 2.4.1, above 0.
    - use_coefficient: Use coefficient C_U (-), NTC 2.4.3, above 0.
    """

    ag_unit: Literal["g", "g/10", "m/s2"]
    coordinates: Required[Sequence[float]]
    grid: Required[str]
    nominal_life: Required[float]
    use_coefficient: Required[float]


class Tie(TypedDict, total=False):
    """A tie in the check.

    - at_activation: What the tie does at the activation: nothing, or it pulls with its strength; default
      "none".
    - bar: The bar, in place of tie_stiffness, tie_strength and tie_ultimate.
    - ultimate_strain_source: Where ultimate_strain of the bar comes from, for the report: a certificate,
      tests, a code.
    """

    at_activation: Literal["none", "yield"]
    bar: Bar
    ultimate_strain_source: str


class Bar(TypedDict, total=False):
    """The bar, in place of tie_stiffness, tie_strength and tie_ultimate.

    - anchor_capacity: Force at which an anchor fails, without warning; by default it is stronger than the bar
      [N], above 0.
    - diameter: Diameter of the bar [m], above 0.
    - length: Free length between the anchors [m], above 0.
    - spacing: Distance between bars along the wall; by default one bar holds its width [m], above 0.
    - ultimate_strain: Strain at which the bar tears, above 0; where none is given, the tie stays elastic.
    - yield_stress: Stress at which the bar yields [Pa], above 0.
    - young_modulus: Young's modulus of the bar; 210e9 Pa by default [Pa], above 0.
    """

    anchor_capacity: float
    diameter: Required[float]
    length: Required[float]
    spacing: float
    ultimate_strain: float
    yield_stress: Required[float]
    young_modulus: float


class Fractions(TypedDict, total=False):
    """Check of the wall's capacity curve over a spectrum, which wall check reads.

    - code: The code: capacity at fractions.
    - column: Name of the column with Sa, for a file with several.
    - damping: Damping ratio of the spectrum (-): that of the column's name, or 0.05 unless given, above 0.
    - displacement_fraction: Displacement capacity over the displacement at which the force of the wall
      vanishes (-), above 0, at most 1; default 0.4.
    - records: The demand: the median spectrum of these records, felt on the floor of a wall on storeys.
    - secant_fraction: Displacement of the secant period over the displacement capacity (-), above 0, at most
      1; default 0.4.
    - spectrum: The demand: a file with columns T and Sa, or points [T, Sa], T in s from 0 on.
    - unit: Unit of Sa, where the file does not state its own.
    """

    code: Required[Literal["fractions"]]
    column: str
    damping: float
    displacement_fraction: float
    records: Records
    secant_fraction: float
    spectrum: str | Sequence[Sequence[float]]
    unit: str


class Class(TypedDict, total=False):
    """A class of walls that risk engines see as one.

    - name: Name, of no wall.
    - walls: Names of its walls; by default all walls of the study.
    - weights: Weight of each wall, of any sum; by default equal.
    """

    name: Required[str]
    walls: Sequence[str]
    weights: Sequence[float]


class Hazard(TypedDict, total=False):
    """Annual rates at which intensities of the study's measure are exceeded, and what is asked of them.

    - file: A file instead of points: CSV with a measure and annual_rate, or hazard curves of OpenQuake.
    - points: Points: intensity and annual rate of exceedance [1/year]; intensities rise, rates fall.
    - site: Number of the site in a file of OpenQuake, from 1, at least 1.
    - target: Annual rate that each limit state should not exceed [1/year], such as 1/475, above 0, at most 1.
    - unit: Unit of points and of two columns, as that of levels; by default that of the results.
    - years: Years of the probabilities, above 0; default 50.0.
    """

    file: str
    points: Sequence[Sequence[float]]
    site: int
    target: float
    unit: str
    years: float


class Intensity(TypedDict, total=False):
    """Intensity measure by which records are scaled; spectral ones at 5 % damping.

    - compare: Measures that the runs compare, by the names of measure; Sa has its period in s, as "Sa(0.5)".
    - measure: The measure.
    - period: Period of Sa [s].
    - periods: Periods of AvgSA and of code [s]; by default 0.2, 0.4 to 1.4 s, and 0.2, 0.3 to 2 s.
    - records_table: With compare: a table (CSV) with a column record, and magnitude, distance_km or both.
    - select: With code: takes so many of the records, those whose spectra fit that of the site best, at least
      1.
    """

    compare: Sequence[str]
    measure: Required[Literal["PGA", "PGV", "PGD", "Sa", "AvgSA", "Arias", "CAV", "Housner", "code"]]
    period: float
    periods: Sequence[float]
    records_table: str
    select: int


class Levels(TypedDict, total=False):
    """Levels of intensity: hunt, step (to the first overturning), grid, cloud (each record once), or stripes
    (each with its own records).

    - first: First level and first step of a hunt.
    - gap: Largest gap between levels of a hunt, as a part of the collapse intensity; default 0.1.
    - increase: Increase of each step of a hunt.
    - method: How levels are chosen.
    - resolution: Largest bracket of the collapse in a hunt, as a part of the collapse intensity; default
      0.01.
    - scale: Factor on the records of a cloud, above 0; default 1.
    - step: Distance between levels of step and grid.
    - stripe: Stripes, from the lowest on.
    - top: Highest level.
    - unit: Unit of the levels: of an acceleration m/s2, cm/s2, mm/s2 or g; of PGV and Arias cm/s, m/s or
      mm/s; of PGD and Housner cm, m or mm; of CAV g s, m/s or cm/s. By default that of the results.
    - values: Levels of a grid.
    """

    first: float
    gap: float
    increase: float
    method: Required[Literal["hunt", "step", "grid", "cloud", "stripes"]]
    resolution: float
    scale: float
    step: float
    stripe: Sequence[Stripe]
    top: float
    unit: str
    values: Sequence[float]


class Stripe(TypedDict, total=False):
    """A level with its own records, which are run as their list scales them.

    - intensity: Level.
    - selection: List of its records: a table, or its folder.
    """

    intensity: Required[float]
    selection: Required[str]


class Model(TypedDict, total=False):
    """A model.

    - c_bar: Damping constant of a free-standing block; -1: computed from restitution (Eq. 23), at least -1,
      at most 100; where damping_model = free_standing_block; default -1.0.
    - name: Name in tables; by default that of the model.
    - xi: Damping ratio on the elastic branch; -1: computed from a1 and restitution (Eqs. 20 to 22), at least
      -1, at most 10; where damping_model = constant_coefficient, constant_ratio or stiffness_proportional;
      default -1.0.
    """

    c_bar: float
    model: Required[Literal["CDC", "block", "CDR", "SDR"]]
    name: str
    xi: float


class Reliability(TypedDict, total=False):
    """What a study of reliability asks.

    - probability: Probability of a fall, of a wall that just passes, for which the numbers of the code are
      sought, above 0, below 1; default 0.1.
    """

    probability: float


class Report(TypedDict, total=False):
    """What the results show.

    - beta: Dispersions: one for each limit state (own), one for all (common), or one for each with which
      curves do not cross (ordered); default "own".
    - collapse: Which exceedance of a record counts where a wall stands again above it: the first, the last,
      or at each level the fraction of the records; by default the fraction on a grid, else the first.
    - fractions: Limit states as fractions of u_ins; default [0.1, 0.4, 0.6, 1.0].
    - given: Fractions of u_ins: fragilities of the last shock are told for the walls whose |u| has exceeded
      each in the shocks before.
    - loss_ratios: Loss as a part of the value of a wall, for each of the fractions (-).
    - modelling_uncertainty: Dispersion due to modelling, in all probabilities that are taken from fragilities
      [-], at least 0, at most 2; default 0.
    - reference: Model by whose medians the others are divided; by default the first.
    - resamples: Number of resamples of the bootstrap, at least 100, at most 100000; default 1000.
    - seed: Seed of the resamples, at least 0; default 1.
    - small_sample: Whether β is multiplied by 4n/(4n − 3), n records, which removes its bias; default False.
    """

    beta: Literal["own", "common", "ordered"]
    collapse: Literal["first", "last", "fraction"]
    fractions: Sequence[float]
    given: Sequence[float]
    loss_ratios: Sequence[float]
    modelling_uncertainty: float
    reference: str
    resamples: int
    seed: int | Generator
    small_sample: bool


class Uncertain(TypedDict, total=False):
    """Parameters of the walls that are not known: each wall stands for samples of them.

    - correlation: Two parameters and Spearman's correlation of their ranks, as lists.
    - parameters: Distributions of parameters by their names.
    - samples: Number of samples of each wall, at least 2, at most 100000; default 100.
    - seed: Seed of the samples, at least 0; default 1.
    """

    correlation: Sequence[Sequence[object]]
    parameters: Required[Mapping[str, Distribution]]
    samples: int
    seed: int | Generator


class Distribution(TypedDict, total=False):
    """The distribution of a parameter: one of normal to values, within limits.

    - lognormal: Median and standard deviation of the logarithm.
    - normal: Mean and standard deviation.
    - triangular: Lower end, mode and upper end.
    - uniform: Lower and upper end.
    - values: Values that are taken.
    - weights: Weights of the values; by default equal.
    - within: Limits, lower and upper.
    """

    lognormal: Sequence[float]
    normal: Sequence[float]
    triangular: Sequence[float]
    uniform: Sequence[float]
    values: Sequence[float]
    weights: Sequence[float]
    within: Sequence[float]


_told = [f"{name}: {kind.__doc__}" for name, kind in list(globals().items()) if is_typeddict(kind)]
__doc__ = "\n\n".join([__doc__, *_told])
__all__: list[str] = []
"""Empty, since `help` would tell with each class what every dictionary has."""
