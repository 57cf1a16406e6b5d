// The fields of the page. Names, units, defaults and choices of parameters come from the library, and so does
// which of them matter; here are their labels, the ranges of their sliders, and when fields of the motion are
// shown.
const moved = v => v.kind !== "none";
const pulse = v => ["ricker", "sine_cycle", "half_sine", "harmonic"].includes(v.kind);
const rectangle = v => v.shape === "rectangle";
const parapet = v => v.mechanism === "parapet";
const bar = v => parapet(v) && v.tie_given === "bar";
const numbers = v => parapet(v) && v.tie_given === "numbers";
const code = v => v.code === "circolare-2019";
const fractions = v => v.code === "fractions";
const high = v => code(v) && v.place === "building";
// parts of shapes that are no rectangle, as tables of a scene file
const SHAPES = {
  gable: `[[geometry.part]]
height = 2.4
thickness = 0.25
width = [6.0, 0.0]  # bottom, top
density = 1800
`,
  facade: `[[geometry.part]]
height = 9.6
thickness = 0.6
density = 1800

[[geometry.load]]
force = 12e3
height = 3.2
inside = 0.5  # from the outer face
moving_mass = 1.0

[[geometry.load]]
force = 12e3
height = 6.4
inside = 0.5
moving_mass = 1.0

[[geometry.load]]
force = 8e3
height = 9.6
inside = 0.4
moving_mass = 1.0
thrust = 1000  # outwards
`,
  chimney: `[[geometry.part]]
height = 1.5
thickness = 0.6
width = 0.6
density = 1800

[[geometry.part]]  # a cap that juts out
height = 0.1
thickness = 0.8
width = 0.8
density = 2400
outer = -0.1

[[geometry.opening]]  # the flue
base = 0.0
height = 1.5
width = 0.3
thickness = 0.3
outer = 0.15
`,
};
const CHECK = "Check by the code";
// a limit state; SLD and SLC are checked where their a_g is given
const limitState = (name, [ag, f0, tc, xi], more) => [
  { name: `${name}.ag`, label: `${name}: a_g`, unit: "g", start: ag, range: [0.02, 0.4, 0.005], more,
    when: code },
  { name: `${name}.F0`, label: `${name}: F0`, start: f0, range: [2.2, 3, 0.05], more,
    when: v => code(v) && v[`${name}.ag`] !== "" },
  { name: `${name}.TC`, label: `${name}: T_C*`, unit: "s", start: tc, range: [0.15, 0.6, 0.01], more,
    when: v => code(v) && v[`${name}.ag`] !== "" },
  { name: `${name}.building_damping`, label: `${name}: damping of the building`, start: xi,
    range: [0.02, 0.2, 0.01], more, when: v => high(v) && v[`${name}.ag`] !== "" },
];
const GROUPS = [
  ["Wall", [
    { name: "mechanism", label: "Kind",
      names: { parapet: "parapet", vertical_spanning: "strip between floors" } },
    { name: "shape", label: "Shape", start: "rectangle", page: true,
      names: { rectangle: "rectangle", gable: "gable", facade: "façade with floors",
        chimney: "hollow chimney" } },
    { name: "parts", label: "Its parts, openings and loads", start: "", lines: true, page: true,
      when: v => !rectangle(v) },
    { name: "height", label: "Height", range: [0.5, 8, 0.05], when: rectangle },
    { name: "thickness", label: "Thickness", range: [0.08, 1, 0.01], when: rectangle },
    { name: "overburden", label: "Load on top", range: [0, 100000, 500] },
    { name: "overburden_eccentricity", label: "Eccentricity of the load", range: [-0.3, 0.3, 0.01] },
    { name: "eccentricity_mode", label: "The load bears",
      names: { fixed_to_wall: "at a fixed point", follows_pivot: "towards the pivot" } },
    { name: "hinge_ratio", label: "Hinge height / height", range: [0.3, 0.9, 0.01] },
    { name: "width", label: "Width", more: true, when: rectangle },
    { name: "density", label: "Density", more: true, when: rectangle },
    { name: "gravity", label: "Gravity", more: true },
  ]],
  ["Motion", [
    { name: "kind", label: "Kind", start: "synthetic", names: { synthetic: "synthetic earthquake",
      ricker: "Ricker pulse", sine_cycle: "one cycle of a sine", half_sine: "half a cycle of a sine",
      harmonic: "harmonic", record: "your own record", none: "none: released by hand" } },
    { name: "u_start", label: "Released from u =", range: [0, 0.4, 0.005], when: v => !moved(v) },
    { name: "pga", label: "Peak acceleration", unit: "m/s²", start: "2.5", range: [0.1, 10, 0.05],
      when: v => v.kind === "synthetic" },
    { name: "seed", label: "Number (seed)", start: "1", range: [1, 50, 1],
      when: v => v.kind === "synthetic" },
    { name: "amplitude", label: "Amplitude", unit: "m/s²", start: "2.5", range: [0.1, 15, 0.05],
      when: pulse },
    { name: "frequency", label: "Frequency", unit: "Hz", start: "1", range: [0.2, 5, 0.05], when: pulse },
    { name: "centre", label: "Time of the peak", unit: "s", start: "2", when: v => v.kind === "ricker" },
    { name: "duration", label: "Duration", unit: "s", start: "5", range: [0.5, 20, 0.5],
      when: v => v.kind === "harmonic" },
    { name: "record", label: "Record: a file of an agency, CSV or text", file: true,
      start: "", when: v => v.kind === "record" },
    { name: "scale", label: "Scale", start: "1", range: [0.05, 5, 0.05], when: v => v.kind === "record" },
    { name: "unit", label: "Unit, if the file has none", start: "", when: v => v.kind === "record",
      names: { "": "that of the file", "m/s2": "m/s²", "cm/s2": "cm/s²", "mm/s2": "mm/s²", g: "g" } },
    { name: "step", label: "Step, if the file has none", unit: "s", start: "", more: true,
      when: v => v.kind === "record" },
    { name: "column", label: "Column of a table", start: "", more: true, when: v => v.kind === "record" },
    { name: "channel", label: "Channel, if several", start: "", more: true, when: v => v.kind === "record" },
  ]],
  [CHECK, [
    { name: "code", label: "Code", start: "circolare-2019",
      names: { "circolare-2019": "Circolare 7/2019", "fractions": "Capacity at fractions", "": "none" } },
    { name: "spectrum", label: "Spectrum: [[T, Sa], ...], T in s from 0 on",
      start: "[[0, 2], [0.1, 5], [0.5, 5], [1, 2.5], [2, 1.25], [4, 0.6]]", when: fractions },
    { name: "check.unit", label: "Unit of Sa", start: "m/s2", when: fractions,
      names: { "m/s2": "m/s²", g: "g" } },
    { name: "displacement_fraction", label: "Displacement capacity / zero of the force", start: "0.4",
      range: [0.1, 1, 0.05], when: fractions },
    { name: "secant_fraction", label: "Secant / displacement capacity", start: "0.4", range: [0.1, 1, 0.05],
      when: fractions },
    { name: "hinge", label: "Hinge of the check", start: "least_alpha0",
      when: v => code(v) && v.mechanism === "vertical_spanning",
      names: { least_alpha0: "at the least α0", worst: "where it is worst", given: "at the height above" } },
    { name: "before_activation", label: "Before it rocks", start: "law", when: code,
      names: { law: "free: as its force law", beam: "free: an elastic beam",
        rigid: "held by transverse walls" } },
    { name: "young_modulus", label: "E of the masonry", unit: "Pa", start: "1e9",
      when: v => code(v) && v.before_activation === "beam" },
    ...limitState("SLV", ["0.15", "2.4", "0.32", "0.1"], false),
    { name: "soil", label: "Soil", start: "B", when: code,
      names: Object.fromEntries([..."ABCDE"].map(one => [one, one])) },
    { name: "place", label: "Place", start: "ground", when: code, page: true,
      names: { ground: "on the ground", building: "in a building" } },
    { name: "building.storeys", label: "Storeys", start: "3", range: [1, 8, 1], when: high },
    { name: "building.period", label: "Period T₁", unit: "s", start: "0.3", range: [0.05, 1.5, 0.01],
      when: high },
    { name: "building.height_ratio", label: "Height z/H", start: "1", range: [0, 1, 0.05], when: high },
    { name: "target", label: "Target of ζ_E", start: "1", range: [0.1, 1, 0.05], when: code },
    { name: "confidence_factor", label: "Confidence factor FC", start: "1.35", range: [1, 1.35, 0.05],
      when: code },
    { name: "compression_considered", label: "Hinges set back for compression", start: "false",
      names: { false: "no", true: "yes" }, when: v => code(v) && Number(v.confidence_factor) < 1.35 },
    { name: "overburden_mass", label: "Part of the load's mass that moves", start: "", range: [0, 1, 0.1],
      when: v => code(v) && parapet(v) && Number(v.overburden) > 0 },
    { name: "topography", label: "Topography", start: "T1", more: true, when: code,
      names: Object.fromEntries(["T1", "T2", "T3", "T4"].map(one => [one, one])) },
    { name: "method", label: "What decides", start: "nonlinear", more: true, when: code,
      names: { nonlinear: "displacements", linear: "SLV with q" } },
    { name: "behaviour_factor", label: "q", start: "2", range: [1, 3, 0.1], more: true, when: code },
    ...limitState("SLC", ["", "2.42", "0.33", "0.15"], true),
    ...limitState("SLD", ["", "2.45", "0.28", "0.05"], true),
  ]],
  ["Force law", [
    { name: "force_law", label: "Law",
      names: { rigid_linear: "rigid", bilinear: "bilinear", trilinear: "trilinear" } },
    { name: "a1", label: "Elastic up to a1", range: [0.005, 0.2, 0.005] },
    { name: "d1", label: "Plateau d1", range: [0.3, 1, 0.01] },
    { name: "a3", label: "Force ends at a3", range: [0.5, 1, 0.01] },
    { name: "softening", label: "Softening" },
  ]],
  ["Energy loss", [
    { name: "damping_model", label: "Damping" },
    { name: "xi", label: "Damping ratio xi", range: [0, 0.2, 0.005] },
    { name: "c_bar", label: "Damping c_bar", range: [0, 0.5, 0.01] },
    { name: "impact", label: "At impacts", names: { none: "nothing", restitution: "restitution" } },
    { name: "restitution", label: "Restitution e", range: [0.5, 1, 0.005] },
    { name: "restitution_source", label: "Formula for e" },
  ]],
  ["Ties and transverse walls", [
    { name: "tie_given", label: "A tie is given by", start: "numbers", when: parapet, page: true,
      names: { numbers: "stiffness and strength", bar: "bar and anchor" } },
    { name: "tie_stiffness", label: "Stiffness of a tie", range: [0, 1000000, 5000], when: numbers },
    { name: "bar_diameter", label: "Diameter of the bar", start: "0.012", range: [0.006, 0.04, 0.001],
      when: bar },
    { name: "bar_length", label: "Its free length", start: "6", range: [0.5, 20, 0.5], when: bar },
    { name: "bar_yield_stress", label: "Its yield stress", start: "235000000", range: [1e8, 6e8, 5e6],
      when: bar },
    { name: "bar_ultimate_strain", label: "It tears at the strain", start: "0.02", range: [0.005, 0.2, 0.005],
      when: bar },
    { name: "bar_anchor_capacity", label: "Capacity of an anchor", start: "50000", range: [1000, 2e5, 1000],
      when: bar },
    { name: "bar_spacing", label: "Spacing of the bars", start: "3", range: [0.5, 10, 0.1], when: bar },
    { name: "tie_height", label: "Height of the tie", start: "3", range: [0.1, 8, 0.05] },
    { name: "tie_side", label: "It resists",
      names: { positive: "u above 0", negative: "u below 0", both: "both" } },
    { name: "tie_slack", label: "Slack of the tie", range: [0, 0.1, 0.001] },
    { name: "tie_strength", label: "Strength of the tie", range: [0, 20000, 100], when: numbers },
    { name: "tie_ultimate", label: "It stretches until it breaks; -1: elastic", range: [-1, 0.3, 0.01],
      when: numbers },
    { name: "rocking", label: "It rocks",
      names: { two_sided: "to both sides", one_sided_positive: "to u above 0",
        one_sided_negative: "to u below 0" } },
  ]],
];
for (const [title, fields] of GROUPS) {
  for (const field of fields) { field.check = title === CHECK; }
}
const FIELDS = GROUPS.flatMap(([, fields]) => fields);
