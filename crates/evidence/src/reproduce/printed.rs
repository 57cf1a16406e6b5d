//! Numbers that the paper prints in its tables, captions and text. Those of Eqs. (20)–(23) are in
//! [`study::calibration`].
//!
//! U. Tomassetti, F. Graziotti, L. Sorrentino, A. Penna, *Modelling rocking response via equivalent viscous
//! damping*.

use rocking_wall::variables::{DampingModel, Mechanism};

/// a₁ of Table 3 \[-\].
pub const TABLE_3_A1: f64 = 0.03;
/// Measured e of Table 3 \[-\], the smaller one first: single leaf, cavity wall.
pub const TABLE_3_RESTITUTION: [[f64; 2]; 2] = [[0.84, 0.87], [0.61, 0.74]];
/// Table 3: damping model, number of its equation, and for the single leaf and the cavity wall the ratio
/// calibrated on tests and those predicted from the two measured e \[-\].
pub const TABLE_3: [(DampingModel, u8, [[f64; 3]; 2]); 3] = [
    (DampingModel::ConstantCoefficient, 20, [[0.045, 0.024, 0.019], [0.060, 0.068, 0.041]]),
    (DampingModel::ConstantRatio, 21, [[0.060, 0.047, 0.038], [0.100, 0.134, 0.082]]),
    (DampingModel::StiffnessProportional, 22, [[0.070, 0.075, 0.060], [0.150, 0.213, 0.132]]),
];

/// A row of Table 4: a tested parapet.
pub struct Table4 {
    /// Specimen.
    pub specimen: &'static str,
    /// CR: a₁ and e from tests \[-\].
    pub restitution: [f64; 2],
    /// CDR: a₁ and ξ from tests, ξ of Eq. (21) \[-\].
    pub constant_ratio: [f64; 3],
    /// SDR: a₁ and ξ₁ from tests, ξ₁ of Eq. (22) \[-\].
    pub stiffness_proportional: [f64; 3],
}

/// Height, thickness and width of the parapets of Table 4 \[m\].
pub const TABLE_4_SIZE: [f64; 3] = [1.18, 0.23, 1.2];
/// F₀ of the parapets of Table 4 \[N\].
pub const TABLE_4_STRENGTH: f64 = 1240.0;
/// a₃ of the parapets of Table 4 \[-\].
pub const TABLE_4_A3: f64 = 0.95;
/// Table 4.
pub const TABLE_4: [Table4; 2] = [
    Table4 {
        specimen: "P4-(B)",
        restitution: [0.072, 0.935],
        constant_ratio: [0.072, 0.016, 0.019],
        stiffness_proportional: [0.074, 0.018, 0.024],
    },
    Table4 {
        specimen: "P7-(C)",
        restitution: [0.070, 0.922],
        constant_ratio: [0.070, 0.022, 0.023],
        stiffness_proportional: [0.069, 0.026, 0.029],
    },
];

/// A row of Table 5: a wall of the incremental dynamic analyses.
pub struct Table5 {
    /// Number.
    pub number: u8,
    /// Mechanism.
    pub mechanism: Mechanism,
    /// h and b \[m\].
    pub size: [f64; 2],
    /// a₁ \[-\].
    pub a1: f64,
    /// `e_an` and `e_exp` \[-\].
    pub restitution: [f64; 2],
    /// ξ of Eqs. (20), (21), (22) and (14) \[%\].
    pub damping: [f64; 4],
}

/// h₁/h of the strip walls of Table 5: not printed, but their `e_an` follows from Eq. (3) with this value
/// only.
pub const TABLE_5_HINGE: f64 = 0.58;

const fn parapet(number: u8, size: [f64; 2], a1: f64, restitution: [f64; 2], damping: [f64; 4]) -> Table5 {
    Table5 { number, mechanism: Mechanism::Parapet, size, a1, restitution, damping }
}

const fn strip(number: u8, size: [f64; 2], restitution: [f64; 2], damping: [f64; 4]) -> Table5 {
    Table5 { number, mechanism: Mechanism::VerticalSpanning, size, a1: 0.02, restitution, damping }
}

/// Table 5.
pub const TABLE_5: [Table5; 9] = [
    parapet(1, [6.00, 1.20], 0.0048, [0.942, 0.895], [0.67, 2.64, 6.83, 7.53]),
    parapet(2, [1.50, 0.30], 0.0012, [0.942, 0.895], [0.36, 2.38, 8.95, 7.53]),
    parapet(3, [3.00, 0.30], 0.0090, [0.985, 0.935], [0.53, 1.65, 3.62, 4.51]),
    parapet(4, [12.00, 1.20], 0.0360, [0.985, 0.935], [1.00, 1.83, 2.76, 4.51]),
    parapet(5, [3.00, 0.60], 0.0024, [0.942, 0.895], [0.49, 2.50, 7.82, 7.53]),
    parapet(6, [6.00, 0.60], 0.0180, [0.985, 0.935], [0.73, 1.74, 3.16, 4.51]),
    strip(7, [5.00, 0.30], [0.979, 0.881], [1.46, 3.35, 5.92, 8.62]),
    strip(8, [3.75, 0.24], [0.976, 0.878], [1.49, 3.43, 6.06, 8.82]),
    strip(9, [3.40, 0.36], [0.935, 0.842], [1.98, 4.55, 8.04, 11.70]),
];

/// The strip of Figures 5 and 6: h, b, h₁ \[m\], a₁, d₁ \[-\].
pub const FIGURE_5_WALL: [f64; 5] = [2.68, 0.10, 1.54, 0.04, 0.85];
/// ξ of Figure 5 for CDC, CDR, SDR \[-\].
pub const FIGURE_5_RATIOS: [f64; 3] = [0.015, 0.027, 0.044];
/// `C_CDC` of Figure 5, "≈ 300 kg/s" \[N s/m\].
pub const FIGURE_5_COEFFICIENT: f64 = 300.0;
/// u₀/`u_ins` of Figures 2, 5, 6 and 9 to 12 \[-\].
pub const START: f64 = 0.9;
/// e and the ξ of CDR that matches it in Figure 6 \[-\].
pub const FIGURE_6: [f64; 2] = [0.875, 0.035];
/// e of the parapet and of the strip of Figure 2 \[-\].
pub const FIGURE_2_RESTITUTION: [f64; 2] = [0.985, 0.955];
/// h and b of Figures 2 and 7 to 12 \[m\].
pub const FIGURE_WALL: [f64; 2] = [4.0, 0.4];
/// e of Figure 7 \[-\] and the impacts that Eq. (13) counts for it.
pub const FIGURE_7: [(f64, u32); 2] = [(0.985, 4), (0.85, 3)];
/// u₀/`u_ins` of Figure 7 \[-\].
pub const FIGURE_7_START: f64 = 0.8;
