//! The table `[check]` of a scene or a study.

use rocking_wall::scene::{Place, SceneError, parse_toml};
use serde::Deserialize;
use toml::Spanned;

use super::floor::Mode;

/// What the engineer states, as it is written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CheckTable {
    /// The code; [`CODE`](super::CODE).
    pub code: String,
    /// The wall before it rocks: `rigid`, `law` or `beam`.
    pub before_activation: Option<Activation>,
    /// E of the masonry \[Pa\], for `beam`.
    pub young_modulus: Option<f64>,
    /// FC \[-\].
    pub confidence_factor: Option<f64>,
    /// Level of knowledge instead of FC: `LC1`, `LC2` or `LC3`.
    pub knowledge_level: Option<KnowledgeLevel>,
    /// Whether the hinges are set back for compression.
    #[serde(default)]
    pub compression_considered: bool,
    /// r, the share of the overburden whose mass moves with a parapet \[-\].
    pub overburden_mass: Option<f64>,
    /// q of the linear check \[-\].
    pub behaviour_factor: Option<f64>,
    /// Soil, `A` to `E`.
    pub soil: Option<String>,
    /// Topography, `T1` to `T4`, or `S_T` \[-\].
    pub topography: Option<Topography>,
    /// Use class, `I` to `IV`; class IV makes SLD count.
    pub use_class: Option<UseClass>,
    /// What decides.
    #[serde(default)]
    pub method: Method,
    /// Limit state of damage.
    #[serde(rename = "SLD")]
    pub sld: Option<LimitStateTable>,
    /// Limit state of life safety.
    #[serde(rename = "SLV")]
    pub slv: Option<LimitStateTable>,
    /// Limit state of collapse.
    #[serde(rename = "SLC")]
    pub slc: Option<LimitStateTable>,
    /// The building; none on the ground.
    pub building: Option<BuildingTable>,
    /// Records of the dynamic check, and of limit states without F0 and TC.
    pub records: Option<Spanned<run::records::RecordsTable>>,
    /// What the peaks of the records become in the dynamic check.
    #[serde(default)]
    pub record_scale: RecordScale,
}

/// A limit state: the hazard or a spectrum, and the values of the building in this state.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitStateTable {
    /// `a_g` \[g\].
    pub ag: f64,
    /// F0 \[-\].
    #[serde(rename = "F0")]
    pub f0: Option<f64>,
    /// `T_C`* \[s\].
    #[serde(rename = "TC")]
    pub tc: Option<f64>,
    /// Spectrum at the wall's place instead: points `[T, Sa]` \[s, g\].
    pub spectrum: Option<Vec<[f64; 2]>>,
    /// ξ of that spectrum \[-\].
    pub spectrum_damping: Option<f64>,
    /// ξ of the mechanism \[-\].
    pub damping: Option<f64>,
    /// `ξ_k` of the building \[-\].
    pub building_damping: Option<f64>,
    /// T₁ of the building in this limit state \[s\].
    pub building_period: Option<f64>,
    /// u of a local instability \[m\]; SLC only.
    pub displacement: Option<f64>,
}

/// The building at the wall's height.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuildingTable {
    /// Number of storeys n.
    pub storeys: Option<u32>,
    /// T₁ \[s\].
    pub period: Option<f64>,
    /// z/H.
    pub height_ratio: Option<f64>,
    /// Modes instead of these three, the first first.
    pub modes: Option<Vec<Mode>>,
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

/// Topography: a category of Tab. 3.2.V or `S_T`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected \"T1\" to \"T4\", or S_T from 1 to 1.4")]
pub enum Topography {
    /// `S_T` \[-\].
    Factor(f64),
    /// `T1` to `T4`.
    Category(String),
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
}

/// The part of a scene or study that is read here.
#[derive(Deserialize)]
struct WithCheck {
    check: Option<CheckTable>,
}

/// Reads the table `[check]` of a text as this code has it; `None` without one.
///
/// # Errors
/// [`SceneError::Line`] with the line, the value, the limit and the remedy.
pub fn read_table(place: &Place<'_>) -> Result<Option<CheckTable>, SceneError> {
    let WithCheck { check } = parse_toml(place)?;
    Ok(check)
}
