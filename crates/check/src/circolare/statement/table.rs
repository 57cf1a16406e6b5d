//! The table `[check]` of a scene or a study.

use files::{choices, tables};
use rocking_wall::variables::Rocking;
use rocking_wall::wall::Usual;
use run::records::RecordsTable;
use scene::BarTable;
use serde::Deserialize;
use toml::Spanned;

use super::height::HeightRatio;
use super::resultants::Resultants;
use crate::ntc::floor::Mode;
use crate::ntc::grid::GridUnit;
use crate::ntc::ground::{Category, Soil, Topography};

/// The name of the code.
pub(crate) const NAME: &str = "circolare-2019";
/// FC of LC1, which applies where compression is neglected, C8.7.1.2.1.3 \[-\].
pub const LARGEST_CONFIDENCE_FACTOR: f64 = 1.35;

tables! {
    /// Check of the wall by a code, which `wall check` reads.
    #[derive(Clone, Debug)]
    pub struct CheckTable {
        /// The code: Circolare 7/2019 to NTC 2018.
        #[key(enum = vec![NAME])]
        pub code: String,
        /// The wall before it rocks: held, elastic as its law, or a beam.
        pub before_activation: Option<Activation>,
        /// E of the masonry \[Pa\], for "beam".
        #[key(exclusiveMinimum = 0)]
        pub young_modulus: Option<f64>,
        /// FC (-); below 1.35 only with `compression_considered`.
        #[key(minimum = 1, default = LARGEST_CONFIDENCE_FACTOR)]
        pub confidence_factor: Option<f64>,
        /// Level of knowledge instead of FC.
        pub knowledge_level: Option<KnowledgeLevel>,
        /// Whether the hinges are set back for compression.
        #[serde(default)]
        #[key(default = false)]
        pub compression_considered: bool,
        /// Share r of the overburden whose mass moves with a parapet (-).
        #[key(minimum = 0)]
        pub overburden_mass: Option<f64>,
        /// Where the hinge of a strip is: at the least α0, for each check where it is least favourable, or as
        /// given; by default at the least α0 where the scene has no `hinge_ratio`.
        pub hinge: Option<Hinge>,
        /// Range in which the crack of wedges of transverse walls is searched \[° from the vertical\].
        pub crack_angles: Option<[f64; 2]>,
        /// Heights above the base at which a façade may open \[m\]: the body above each is checked.
        #[key(minItems = 1, default = vec![0.0])]
        pub hinge_levels: Option<Vec<f64>>,
        /// Resultants of the weights: one on each body, or one of its own weight and each moving load.
        #[serde(default)]
        #[key(default = "body")]
        pub resultants: Resultants,
        /// Range of `hinge_ratio` in which the hinge is searched (-).
        #[key(default = HINGE_RANGE.to_vec())]
        pub hinge_range: Option<[f64; 2]>,
        /// Mean compressive strength `f_m` of the masonry in Pa, such as 1.5e6; hinges are set back for it.
        #[key(minimum = LEAST_STRENGTH)]
        pub masonry_strength: Option<f64>,
        /// γ that divides it (-).
        #[key(minimum = 1, default = 1)]
        pub masonry_gamma: Option<f64>,
        /// κ of the rectangular stress block (-).
        #[key(exclusiveMinimum = 0, maximum = 1, default = STRESS_BLOCK)]
        pub stress_block: Option<f64>,
        /// Whether FC divides it, too.
        #[key(default = true)]
        pub masonry_over_fc: Option<bool>,
        /// Sides to which the wall rocks in the static checks, in place of `rocking` of `[impact]`.
        pub rocking: Option<Rocks>,
        /// The tie in the check.
        pub tie: Option<TieTable>,
        /// q of the linear check (-).
        #[key(minimum = 1, default = 2)]
        pub behaviour_factor: Option<f64>,
        /// Soil of NTC 3.2.2.
        pub soil: Option<Soil>,
        /// Topography of NTC 3.2.2, or `S_T` (-).
        #[key(default = "T1")]
        pub topography: Option<Topography>,
        /// Use class of NTC 2.4.2; in class IV SLD decides too.
        pub use_class: Option<UseClass>,
        /// What decides: displacement, q, or runs under records.
        #[serde(default)]
        #[key(default = "nonlinear")]
        pub method: Method,
        /// `ζ_E` from which on a check passes (-): below 1 for an improvement (NTC 8.4.2, 8.4.3).
        #[key(exclusiveMinimum = 0, maximum = 1, default = 1)]
        pub target: Option<f64>,
        /// Scene of the state before an intervention, beside which the verdict stands.
        pub baseline: Option<String>,
        /// Whether SLD raises SLC, too, by analogy with SLV (C8.7.1.2.1.8).
        #[serde(default)]
        #[key(default = false)]
        pub raise_slc: bool,
        /// The site on a grid of the hazard, for limit states without `ag`.
        pub site: Option<SiteTable>,
        /// Limit state of damage.
        #[serde(rename = "SLD")]
        pub sld: Option<LimitStateTable>,
        /// Limit state of life safety.
        #[serde(rename = "SLV")]
        pub slv: Option<LimitStateTable>,
        /// Limit state of collapse.
        #[serde(rename = "SLC")]
        pub slc: Option<LimitStateTable>,
        /// Whether accelerations at a height up to T₁ are at least `a_g` S.
        #[serde(default)]
        #[key(default = "not_below_ground")]
        pub height_demand: HeightDemand,
        /// The building; none on the ground.
        pub building: Option<BuildingTable>,
        /// Records of the dynamic check, and of limit states without F0 and TC.
        pub records: Option<Spanned<RecordsTable>>,
        /// What records become in the dynamic check: their peaks `a_g` S, as they are, or scaled to the
        /// spectrum of the ground.
        #[serde(default)]
        #[key(default = "ag")]
        pub record_scale: RecordScale,
        /// Periods between which records are held against the spectrum \[s\].
        pub record_range: Option<[f64; 2]>,
        /// Signs with which each record acts.
        #[serde(default)]
        #[key(default = "both")]
        pub polarities: Polarities,
    }

    /// A tie in the check.
    #[derive(Clone, Debug, Default)]
    pub struct TieTable {
        /// What the tie does at the activation: nothing, or it pulls with its strength.
        #[serde(default)]
        #[key(default = "none")]
        pub at_activation: AtActivation,
        /// The bar, in place of `tie_stiffness`, `tie_strength` and `tie_ultimate`.
        pub bar: Option<BarTable>,
        /// Where `ultimate_strain` of the bar comes from, for the report: a certificate, tests, a code.
        pub ultimate_strain_source: Option<String>,
    }

    /// A site on a grid of the hazard that the user brings.
    #[derive(Clone, Debug)]
    pub struct SiteTable {
        /// File of the grid (CSV), or its lines: lon, lat and, for return periods T in years, `ag_T`, `F0_T`,
        /// `TC_T`.
        pub grid: String,
        /// Unit of its `a_g`.
        #[serde(default)]
        #[key(default = "g")]
        pub ag_unit: GridUnit,
        /// Latitude and longitude \[°\].
        pub coordinates: [f64; 2],
        /// Nominal life `V_N` \[years\], NTC 2.4.1.
        #[key(exclusiveMinimum = 0)]
        pub nominal_life: f64,
        /// Use coefficient `C_U` (-), NTC 2.4.3.
        #[key(exclusiveMinimum = 0)]
        pub use_coefficient: f64,
    }

    /// A limit state: its hazard, or the spectrum at the wall's place.
    #[derive(Clone, Debug, Default)]
    pub struct LimitStateTable {
        /// `a_g` on rigid ground \[g\]; that of `site` unless given.
        #[key(exclusiveMinimum = 0, maximum = 1)]
        pub ag: Option<f64>,
        /// F0 (-).
        #[serde(rename = "F0")]
        #[key(minimum = 2.2)]
        pub f0: Option<f64>,
        /// `T_C`* \[s\].
        #[serde(rename = "TC")]
        #[key(exclusiveMinimum = 0)]
        pub tc: Option<f64>,
        /// Spectrum at the wall's place: points [T, Sa] in s and g.
        pub spectrum: Option<Vec<[f64; 2]>>,
        /// Damping ratio of that spectrum (-).
        #[key(exclusiveMinimum = 0)]
        pub spectrum_damping: Option<f64>,
        /// Damping ratio of the mechanism (-): 0.05, 0.08, 0.10 unless given.
        #[key(exclusiveMinimum = 0, maximum = 0.5)]
        pub damping: Option<f64>,
        /// Damping ratio `ξ_k` of the building in this limit state (-); needed at height.
        #[key(exclusiveMinimum = 0, maximum = 0.5)]
        pub building_damping: Option<f64>,
        /// First period of the building in this limit state \[s\].
        #[key(exclusiveMinimum = 0)]
        pub building_period: Option<f64>,
        /// u of a local instability \[m\]; SLC only.
        #[key(exclusiveMinimum = 0)]
        pub displacement: Option<f64>,
    }

    /// The building at the wall's height: storeys, period and `height_ratio`, or modes.
    #[derive(Clone, Debug, Default)]
    pub struct BuildingTable {
        /// Number of storeys n.
        #[key(minimum = 1)]
        pub storeys: Option<u32>,
        /// First period T₁ \[s\].
        #[key(exclusiveMinimum = 0)]
        pub period: Option<f64>,
        /// z/H: height of the wall over that of the building (-), 0 on the ground; with several
        /// `hinge_levels` one for each.
        pub height_ratio: Option<HeightRatio>,
        /// Modes at the wall's place, the first first.
        #[key(minItems = 1)]
        pub modes: Option<Vec<Mode>>,
    }
}

impl BuildingTable {
    /// Whether it states a wall on the ground: at z/H = 0 of a building of storeys.
    pub(crate) fn is_ground(&self) -> bool {
        let is_ground = self.height_ratio.as_ref().is_some_and(HeightRatio::is_ground);
        self.storeys.is_some() && is_ground && self.modes.is_none()
    }
}

choices!(
    Activation,
    KnowledgeLevel,
    UseClass,
    Method,
    RecordScale,
    Hinge,
    Resultants,
    Rocks,
    HeightDemand,
    AtActivation,
    Polarities,
    Category,
    Soil,
    GridUnit
);

/// `hinge_range` unless given \[-\].
pub(crate) const HINGE_RANGE: [f64; 2] = [0.1, 0.9];
/// κ unless given, NTC 7.8.2.2.3 \[-\].
pub(crate) const STRESS_BLOCK: f64 = 0.85;
/// The least `f_m`; less is in another unit \[Pa\].
const LEAST_STRENGTH: f64 = 1e5;

/// Usual E of masonry: 1e8 to 5e10 Pa. NTC Tab. C8.5.I has 0.69e9 to 3.36e9 Pa.
pub(crate) const YOUNG_MODULUS: Usual = Usual {
    name: "young_modulus",
    unit: "Pa",
    range: [1e8, 5e10],
    others: &[("in MPa", 1e6), ("in GPa", 1e9)],
};
/// Usual F0: from the least of NTC 3.2.3.2.1 on; the hazard of Italy stays well below 4.
pub(crate) const F0: Usual =
    Usual { name: "F0", unit: "", range: [2.2, 4.0], others: &[("without its decimal point", 0.1)] };
/// Usual `T_C`*: the hazard of Italy has 0.15 to 0.9 s.
pub(crate) const TC: Usual = Usual { name: "TC", unit: "s", range: [0.1, 1.0], others: &[("in ms", 1e-3)] };

/// Where the hinge of a strip is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Hinge {
    /// At the least α0 of each side, C8.7.1.2.1.1.
    LeastAlpha0,
    /// Where each check of each side has its least `ζ_E`.
    Worst,
    /// `hinge_ratio` of the scene.
    Given,
}

impl Hinge {
    /// Returns the value of the key.
    pub fn name(self) -> &'static str {
        match self {
            Self::LeastAlpha0 => "least_alpha0",
            Self::Worst => "worst",
            Self::Given => "given",
        }
    }
}

/// Sides to which a wall rocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rocks {
    /// Both.
    TwoSided,
    /// u > 0.
    OneSidedPositive,
    /// u < 0.
    OneSidedNegative,
}

impl Rocks {
    /// Returns the same as a parameter of a wall.
    pub(crate) fn rocking(self) -> Rocking {
        match self {
            Self::TwoSided => Rocking::TwoSided,
            Self::OneSidedPositive => Rocking::OneSidedPositive,
            Self::OneSidedNegative => Rocking::OneSidedNegative,
        }
    }
}

/// What bounds accelerations at a height up to T₁.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HeightDemand {
    /// `a_g` S: the foot of a building moves with the ground.
    #[default]
    NotBelowGround,
    /// Nothing, as the code prints it.
    Printed,
}

/// What a tie does at the activation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AtActivation {
    /// It does no work.
    #[default]
    None,
    /// It pulls with its strength.
    Yield,
}

/// The wall before it rocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Activation {
    /// Held by transverse walls: rigid.
    Rigid,
    /// Elastic as its force law.
    Law,
    /// An elastic beam [C8.7.1.7].
    Beam,
}

/// Level of knowledge of C8.5.4.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum KnowledgeLevel {
    /// Limited, FC 1.35.
    LC1,
    /// Adequate, FC 1.20.
    LC2,
    /// Accurate, FC 1.
    LC3,
}

/// Use class of NTC 2.4.2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize)]
#[allow(missing_docs, reason = "numerals of the code")]
pub enum UseClass {
    I,
    II,
    III,
    IV,
}

/// What decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// SLV and SLC by displacement, C8.7.1.2.1.8.
    #[default]
    Nonlinear,
    /// SLV with q, C8.7.1.2.1.7.
    Linear,
    /// Runs under records, C8.7.1.2.1.9.
    Dynamic,
}

/// What the peaks of the records become in the dynamic check.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RecordScale {
    /// `a_g` S of the limit state.
    #[default]
    Ag,
    /// The peaks stay as they are.
    None,
    /// Scaled so that their mean spectrum keeps within the band of NTC 3.2.3.6.
    Spectrum,
}

/// Signs with which each record acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Polarities {
    /// Both; the worse counts.
    #[default]
    Both,
    /// That of the record.
    AsRecorded,
}
