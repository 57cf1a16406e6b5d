//! The table `[check]` of a scene or a study.

use rocking_wall::scene::{Described, Schema, one_of, with};
use rocking_wall::{choices, tables};
use run::records::RecordsTable;
use serde::Deserialize;
use toml::Spanned;

use super::ENTRY;
use super::floor::Mode;
use super::ground::Soil;
use super::statement::LARGEST_CONFIDENCE_FACTOR;

tables! {
    /// Check of the wall by a code, which `wall check` reads.
    #[derive(Clone, Debug)]
    pub struct CheckTable {
        /// The code: Circolare 7/2019 to NTC 2018.
        #[key(enum = vec![ENTRY.name])]
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
        /// q of the linear check (-).
        #[key(minimum = 1, default = 2)]
        pub behaviour_factor: Option<f64>,
        /// Soil of NTC 3.2.2.
        #[key(enum = Soil::ALL.map(Soil::name).to_vec())]
        pub soil: Option<String>,
        /// Topography of NTC 3.2.2, or `S_T` (-).
        #[key(default = "T1")]
        pub topography: Option<Topography>,
        /// Use class of NTC 2.4.2; in class IV SLD decides too.
        pub use_class: Option<UseClass>,
        /// What decides: displacement, q, or runs under records.
        #[serde(default)]
        #[key(default = "nonlinear")]
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
        pub records: Option<Spanned<RecordsTable>>,
        /// What the peaks of the records become in the dynamic check: `a_g` S, or as they are.
        #[serde(default)]
        #[key(default = "ag")]
        pub record_scale: RecordScale,
    }

    /// A limit state: its hazard, or the spectrum at the wall's place.
    #[derive(Clone, Debug, Default)]
    pub struct LimitStateTable {
        /// `a_g` on rigid ground \[g\].
        #[key(exclusiveMinimum = 0, maximum = 1)]
        pub ag: f64,
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
        /// z/H: height of the wall over that of the building (-).
        #[key(minimum = 0, maximum = 1)]
        pub height_ratio: Option<f64>,
        /// Modes at the wall's place, the first first.
        #[key(minItems = 1)]
        pub modes: Option<Vec<Mode>>,
    }
}

choices!(Activation, KnowledgeLevel, UseClass, Method, RecordScale);

impl Described for Topography {
    fn describe(key: &str, tables: &mut Schema) -> Schema {
        let factor = with(with(f64::describe(key, tables), "minimum", 1), "maximum", 1.4);
        let categories = one_of(CATEGORIES.map(|(name, _)| name));
        with(Schema::new(), "anyOf", vec![categories, factor])
    }
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

/// Categories of topography with their `S_T`, Tab. 3.2.V.
pub(super) const CATEGORIES: [(&str, f64); 4] = [("T1", 1.0), ("T2", 1.2), ("T3", 1.2), ("T4", 1.4)];

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
