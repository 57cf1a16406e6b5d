//! The symbols of a report.

use crate::report::markup::{formula, table};

/// Symbols that no heading or row of a report explains, and what they mean; displacements are positive
/// outwards.
const SYMBOLS: [(&str, &str); 19] = [
    ("u", "displacement at mid-height of a parapet, at the hinge of a strip; u > 0: outwards"),
    ("u_ins", "u at which the wall overturns, hinges at the edges"),
    ("u_0, d_0", "u and d at which the force of the wall vanishes"),
    ("d, a", "spectral displacement and acceleration of the mechanism"),
    ("S_a", "acceleration that a check of the activation demands"),
    ("d_y, a_y", "end of the elastic branch"),
    ("k_0", "slope of the line that falls to u_0"),
    ("h, b, l", "height, thickness and width of the wall"),
    ("h_1, h_2", "heights of the bodies below and above the hinge"),
    ("W, O", "own weight, overburden"),
    ("c", "eccentricity of the overburden, positive outwards (u > 0)"),
    ("r", "share of the overburden's mass that moves with the wall"),
    ("t_b, t_m, t_t", "set-backs of the hinges at the base, in the middle, at the top"),
    ("κ", "share of f_d in the rectangular stress block; in [C8.7.1.7] the factor of the mechanism"),
    ("y, i", "height of the tie, spacing of its bars"),
    ("g_0, e_p", "slack of the tie, plastic elongation at which it breaks"),
    ("a_1", "end of the elastic branch as a fraction of u_ins"),
    ("ξ, ξ_k", "damping of the mechanism, of the building"),
    ("η", "√[10/(5 + ξ)], ξ in %, at least 0.55 [3.2.4]"),
];

/// The table of symbols.
pub(in crate::circolare) fn list() -> String {
    let rows = SYMBOLS.map(|(symbol, meaning)| [formula(symbol), ::report::escaped(meaning)]);
    let said = "<p>Numbers are rounded where they are printed; results come from those that are not.</p>\n";
    table(&[], &rows) + said
}
