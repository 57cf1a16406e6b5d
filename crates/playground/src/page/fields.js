// The fields of the page. Names, units, defaults and choices of parameters come from the library, and so does
// which of them matter; here are their labels, the ranges of their sliders, and when fields of the motion are
// shown.
const moved = v => v.kind !== "none";
const pulse = v => ["ricker", "sine_cycle", "half_sine", "harmonic"].includes(v.kind);
const parapet = v => v.mechanism === "parapet";
const GROUPS = [
  ["Wall", [
    { name: "mechanism", label: "Kind",
      names: { parapet: "parapet", vertical_spanning: "strip between floors" } },
    { name: "height", label: "Height", range: [0.5, 8, 0.05] },
    { name: "thickness", label: "Thickness", range: [0.08, 1, 0.01] },
    { name: "overburden", label: "Load on top", range: [0, 100000, 500] },
    { name: "overburden_eccentricity", label: "Eccentricity of the load", range: [-0.3, 0.3, 0.01] },
    { name: "eccentricity_mode", label: "The load bears",
      names: { fixed_to_wall: "at a fixed point", follows_pivot: "towards the pivot" } },
    { name: "hinge_ratio", label: "Hinge height / height", range: [0.3, 0.9, 0.01] },
    { name: "width", label: "Width", more: true },
    { name: "density", label: "Density", more: true },
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
    { name: "record", label: "Record: AT2, ESM, K-NET, COSMOS, CSMIP, SMC, CSV", file: true, start: "",
      when: v => v.kind === "record" },
    { name: "scale", label: "Scale", start: "1", range: [0.05, 5, 0.05], when: v => v.kind === "record" },
    { name: "unit", label: "Unit, if the file has none", start: "", when: v => v.kind === "record",
      names: { "": "that of the file", "m/s2": "m/s²", "cm/s2": "cm/s²", "mm/s2": "mm/s²", g: "g" } },
    { name: "step", label: "Step, if the file has none", unit: "s", start: "", more: true,
      when: v => v.kind === "record" },
    { name: "column", label: "Column of a table", start: "", more: true, when: v => v.kind === "record" },
    { name: "channel", label: "Channel, if several", start: "", more: true, when: v => v.kind === "record" },
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
    { name: "damping_model", label: "Damping", names: { none: "none", constant_coefficient:
      "constant coefficient", free_standing_block: "free-standing block", constant_ratio: "constant ratio",
      stiffness_proportional: "stiffness proportional" } },
    { name: "xi", label: "Damping ratio xi", range: [0, 0.2, 0.005] },
    { name: "c_bar", label: "Damping c_bar", range: [0, 0.5, 0.01] },
    { name: "impact", label: "At impacts", names: { none: "nothing", restitution: "restitution" } },
    { name: "restitution", label: "Restitution e", range: [0.5, 1, 0.005] },
    { name: "restitution_source", label: "Formula for e" },
  ]],
  ["Ties and transverse walls", [
    { name: "tie_stiffness", label: "Stiffness of a tie", range: [0, 1000000, 5000], when: parapet },
    { name: "tie_height", label: "Height of the tie", start: "3", range: [0.1, 8, 0.05] },
    { name: "tie_side", label: "It resists",
      names: { positive: "u above 0", negative: "u below 0", both: "both" } },
    { name: "tie_slack", label: "Slack of the tie", range: [0, 0.1, 0.001] },
    { name: "tie_strength", label: "Strength of the tie", range: [0, 20000, 100] },
    { name: "rocking", label: "It rocks",
      names: { two_sided: "to both sides", one_sided_positive: "to u above 0",
        one_sided_negative: "to u below 0" } },
  ]],
];
const FIELDS = GROUPS.flatMap(([, fields]) => fields);
