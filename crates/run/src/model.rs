//! Damping models of studies: their names, meanings and colours, and walls that have them.
//!
//! ```
//! use rocking_wall::variables::DampingModel;
//! use run::model::{EnergyLoss, Model};
//!
//! assert_eq!(Model::new(DampingModel::ConstantRatio).name, "CDR");
//! assert_eq!(EnergyLoss::named("CR"), Some(EnergyLoss::Restitution));
//! ```

use rocking_wall::variables::{DampingModel, ForceLaw, Impact};
use rocking_wall::wall::{Damping, ParameterError, Parameters, Ratio, Wall, Warning, equivalence};

/// How a damping model is called and shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label {
    /// Short name, that of the paper where it has one.
    pub name: &'static str,
    /// What the short name stands for.
    pub meaning: &'static str,
    /// Symbol of its ratio in plain letters.
    pub symbol: &'static str,
    /// Number of its colour in all figures.
    pub color: usize,
}

/// Returns how a damping model is called and shown.
pub const fn label(model: DampingModel) -> Label {
    let (name, meaning, symbol, color) = match model {
        DampingModel::None => ("none", "no energy loss", "", 7),
        DampingModel::ConstantCoefficient => ("CDC", "constant damping coefficient", "xi", 0),
        DampingModel::FreeStandingBlock => ("block", "damping of a free-standing block, Eq. (7)", "c_bar", 4),
        DampingModel::ConstantRatio => ("CDR", "constant damping ratio", "xi", 1),
        DampingModel::StiffnessProportional => ("SDR", "stiffness-proportional damping ratio", "xi_1", 2),
    };
    Label { name, meaning, symbol, color }
}

const RESTITUTION: Label = Label {
    name: "CR",
    meaning: "coefficient of restitution, applied at each impact",
    symbol: "e",
    color: 5,
};
const RIGID_RESTITUTION: Label = Label {
    name: "CR rigid",
    meaning: "coefficient of restitution on the rigid-linear force law",
    symbol: "e",
    color: 6,
};
/// Number of colours in the table: one for each model, two for restitution, one for Eq. (14).
pub const COLORS: usize = DampingModel::ALL.len() + 3;

// a model has its own colour and mark
const _: () =
    assert!(COLORS == report::palette::SERIES.len(), "palette.rs: give SERIES a colour for each model");
/// What follows the name of a model whose ratio is that of Eq. (14).
const EQUATION_14: &str = " Eq. 14";
/// Colour of CDR with the ratio of Eq. (14), the one such model in Figure 15 of the paper.
const EQUATION_14_COLOR: usize = 3;

/// Energy loss of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnergyLoss {
    /// Viscous damping, or none.
    Viscous(Damping),
    /// Viscous damping with ξ = −0.68 ln e. Makris and Konstantinidis, Eq. (14).
    Equation14(DampingModel),
    /// Restitution at each passage of u = 0, on the wall's own force law (CR).
    Restitution,
    /// Restitution on the rigid-linear law.
    RigidRestitution,
}

impl From<DampingModel> for EnergyLoss {
    /// A model with its computed ratio.
    fn from(model: DampingModel) -> Self {
        Self::Viscous(Damping::computed(model))
    }
}

impl EnergyLoss {
    /// Returns every model of energy loss, with computed ratios.
    pub fn models() -> impl Iterator<Item = Self> {
        [Self::Restitution, Self::RigidRestitution].into_iter().chain(damping_models().map(Self::from))
    }

    /// Returns every energy loss with a name of its own: none, models, and models with the ratio of Eq. (14).
    pub fn all() -> impl Iterator<Item = Self> {
        let of_equation_14 = damping_models().filter(|model| model.ratio() == Some(Ratio::Xi));
        [Self::from(DampingModel::None)]
            .into_iter()
            .chain(Self::models())
            .chain(of_equation_14.map(Self::Equation14))
    }

    /// Returns the energy loss with a name, such as `CR`, `CDC` or `CDR Eq. 14`.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|loss| loss.name() == name)
    }

    /// Returns the name, such as `CR`, `CDC`, `CDC 0.05` or `CDR Eq. 14`.
    pub fn name(self) -> String {
        let short = self.label().name;
        match self {
            Self::Viscous(Damping { ratio: Some(ratio), .. }) => format!("{short} {ratio}"),
            Self::Equation14(_) => format!("{short}{EQUATION_14}"),
            Self::Viscous(_) | Self::Restitution | Self::RigidRestitution => short.to_owned(),
        }
    }

    /// Returns how it is called and shown. A model with a ratio of its own is shown as the model itself.
    pub fn label(self) -> Label {
        match self {
            Self::Viscous(Damping { model, .. }) | Self::Equation14(model) => label(model),
            Self::Restitution => RESTITUTION,
            Self::RigidRestitution => RIGID_RESTITUTION,
        }
    }

    /// Returns the number of its colour, if it has one of its own.
    fn color(self) -> Option<usize> {
        match self {
            Self::Equation14(DampingModel::ConstantRatio) => Some(EQUATION_14_COLOR),
            Self::Equation14(_) => None,
            Self::Viscous(_) | Self::Restitution | Self::RigidRestitution => Some(self.label().color),
        }
    }
}

/// Damping models of the paper that take a ratio ξ.
pub const RATIO_MODELS: [DampingModel; 3] =
    [DampingModel::ConstantCoefficient, DampingModel::ConstantRatio, DampingModel::StiffnessProportional];

/// Returns the models with damping.
pub fn damping_models() -> impl Iterator<Item = DampingModel> {
    DampingModel::ALL.iter().copied().filter(|model| model.ratio_name().is_some())
}

/// Returns the number of the colour of each damping model of a study.
///
/// A name such as `CDC 0.05` has the number of `CDC`, unless another model of the study has it already.
///
/// ```
/// use run::model::colors;
///
/// assert_eq!(colors(&["CR", "CDR 0.05", "CDR"]), [5, 0, 1]);
/// assert_eq!(colors(&["mine", "CDC 0.05"]), [1, 0]);
/// ```
pub fn colors(names: &[&str]) -> Vec<usize> {
    let number = |name: &str| EnergyLoss::named(name).and_then(EnergyLoss::color);
    let is_free = |colors: &[Option<usize>], color: &usize| !colors.contains(&Some(*color));
    // first the models themselves, then their variants, then what has another name
    let mut colors: Vec<Option<usize>> = names.iter().map(|name| number(name)).collect();
    for (index, name) in names.iter().enumerate() {
        let model = name.split(' ').next().and_then(number);
        colors[index] = colors[index].or(model.filter(|color| is_free(&colors, color)));
    }
    for index in 0..names.len() {
        let free = || (0..=names.len()).find(|color| is_free(&colors, color));
        colors[index] = colors[index].or_else(free);
    }
    colors.into_iter().flatten().collect()
}

/// Returns the number of the colour of a damping model.
pub fn color(name: &str) -> usize {
    colors(&[name])[0]
}

/// A damping model and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name in tables and messages.
    pub name: String,
    /// Energy loss.
    pub loss: EnergyLoss,
}

impl Model {
    /// Names a model after its energy loss.
    pub fn new(loss: impl Into<EnergyLoss>) -> Self {
        let loss = loss.into();
        Self { name: loss.name(), loss }
    }

    /// Returns the models of Figure 15 of the paper: CR, CDC, CDR, SDR, and CDR with the damping of Eq. (14).
    pub fn figure_15() -> Vec<Self> {
        let losses = [
            EnergyLoss::Restitution,
            DampingModel::ConstantCoefficient.into(),
            DampingModel::ConstantRatio.into(),
            DampingModel::StiffnessProportional.into(),
            EnergyLoss::Equation14(DampingModel::ConstantRatio),
        ];
        losses.map(Self::new).into()
    }

    /// Returns the parameters of a wall with this model's damping and impact, upright and at rest. A model
    /// without a ratio of its own takes the ξ or c̄ that the wall states, and else the one that is computed.
    ///
    /// # Errors
    /// [`ParameterError`] if the ratio is that of Eq. (14) and the parameters make no wall, or one with e =
    /// 0.
    pub fn applied_to(&self, wall: &Parameters) -> Result<Parameters, ParameterError> {
        let mut parameters = Parameters {
            damping_model: DampingModel::None,
            impact: Impact::None,
            u_start: 0.0,
            u_dot_start: 0.0,
            ..wall.clone()
        };
        match self.loss {
            EnergyLoss::Viscous(Damping { model, ratio: None }) => parameters.damping_model = model,
            EnergyLoss::Viscous(damping) => parameters.set_damping(damping),
            EnergyLoss::Equation14(model) => {
                let e = Wall::new(&parameters)?.restitution().positive;
                if e <= 0.0 {
                    return Err(ParameterError::Computed { name: "xi", restitution: e });
                }
                parameters.set_damping(Damping::given(model, equivalence::makris_konstantinidis(e)));
            }
            EnergyLoss::Restitution => parameters.impact = Impact::Restitution,
            EnergyLoss::RigidRestitution => {
                parameters.impact = Impact::Restitution;
                parameters.force_law = ForceLaw::RigidLinear;
                parameters.multilinear = None;
            }
        }
        Ok(parameters)
    }

    /// Returns the warning of a ratio that walls rarely have, such as one in per cent.
    ///
    /// ```
    /// use rocking_wall::{variables::DampingModel, wall::Damping};
    /// use run::model::{EnergyLoss, Model};
    ///
    /// let with = |ratio| EnergyLoss::Viscous(Damping::given(DampingModel::ConstantRatio, ratio));
    /// let warning = Model::new(with(5.0)).unusual().unwrap();
    /// assert!(warning.to_string().starts_with("xi = 5 is unusual: 0 to 0.5 is usual"));
    /// assert_eq!(Model::new(with(0.05)).unusual(), None);
    /// ```
    pub fn unusual(&self) -> Option<Warning> {
        // the default wall has nothing unusual itself
        self.applied_to(&Parameters::default()).ok()?.unusual().next()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_takes_the_ratio_of_the_wall_where_it_has_none() {
        let wall = Parameters { xi: 0.03, c_bar: 0.2, ..Parameters::default() };
        let ratio = |name: &str| {
            let model = Model::new(EnergyLoss::named(name).unwrap());
            Wall::new(&model.applied_to(&wall).unwrap()).unwrap().damping_ratio()
        };
        assert_eq!([ratio("CDC"), ratio("CDR"), ratio("SDR")], [0.03; 3]);
        assert_eq!([ratio("CR"), ratio("none")], [0.0; 2]);
        let own = Model::new(EnergyLoss::Viscous(Damping::given(DampingModel::ConstantRatio, 0.05)));
        assert_eq!(own.applied_to(&wall).unwrap().xi, 0.05);
        let block = Model::new(DampingModel::FreeStandingBlock).applied_to(&wall).unwrap();
        assert_eq!((block.c_bar, block.damping()), (0.2, Damping::given(block.damping_model, 0.2)));
        assert!(ratio("CDR Eq. 14") != 0.03);
    }

    #[test]
    fn names_and_colours_are_told_apart() {
        let (mut names, mut colors): (Vec<_>, Vec<_>) =
            EnergyLoss::all().map(|loss| (loss.name(), loss.color())).unzip();
        let count = names.len();
        colors.retain(Option::is_some);
        colors.sort_unstable();
        // one after the other, for a palette without gaps
        assert!(colors.iter().copied().eq((0..COLORS).map(Some)), "{colors:?}");
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{names:?}");
        assert!(EnergyLoss::all().all(|loss| EnergyLoss::named(&loss.name()) == Some(loss)));
    }
}
