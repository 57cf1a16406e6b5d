//! The table `[check]`, validated.

mod height;
pub(crate) mod resultants;
pub(crate) mod site;
pub(crate) mod states;
pub(crate) mod table;

use rocking_wall::wall::{ParameterError, Parameters, Usual, Warning};
use run::records::motions;
use scene::{BarTable, Floors};

use crate::error::CheckError;
use crate::file::CheckFile;
use crate::file::site::Records;
use crate::words::names::{Deciding, LimitState};
use crate::words::{Language, Sentence, say};

use crate::ntc::demand::{Demand, Demands};
use site::FromGrid;
use states::{Source, StateStatement, limit_state};
use table::{
    Activation, AtActivation, BuildingTable, CheckTable, F0, HINGE_RANGE, HeightDemand, Hinge,
    KnowledgeLevel, LARGEST_CONFIDENCE_FACTOR, Method, STRESS_BLOCK, TC, UseClass, YOUNG_MODULUS,
};

/// Fewest records, NTC 7.3.5.
const FEWEST_RECORDS: usize = 3;

/// The rule of a limit state by displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Displacements {
    /// `d_SLV` or `d_SLC` over `d_0`, C8.7.1.2.1.6 \[-\].
    pub(super) fraction: f64,
    /// Factor of π √(d/a), [C8.7.1.10] and [C8.7.1.11] \[-\].
    pub(super) period_factor: f64,
}

impl Displacements {
    /// Those of SLV and SLC.
    const OF_CODE: [Self; 2] =
        [Self { fraction: 0.40, period_factor: 1.68 }, Self { fraction: 0.60, period_factor: 1.56 }];
}

/// The table `[check]`, validated.
#[derive(Clone, Debug)]
pub struct Statement {
    /// The table.
    pub table: CheckTable,
    /// FC \[-\].
    pub confidence_factor: f64,
    /// q \[-\].
    pub behaviour_factor: f64,
    /// `ζ_E` from which on a check passes \[-\].
    pub target: f64,
    /// SLD, SLV and SLC; `None` for a check that is not made.
    pub states: [Option<StateStatement>; 3],
    /// Rules of SLV and SLC by displacement.
    pub(super) displacements: [Displacements; 2],
    /// Records of the dynamic check, and of limit states without F0 and TC.
    pub records: Records,
    /// κ `f_d` of the masonry, for which hinges are set back \[Pa\].
    pub(super) masonry: Option<f64>,
    /// Heights above the base at which the wall may open \[m\].
    pub(super) hinge_levels: Vec<f64>,
    /// Range in which the hinge of a strip is searched, of h \[-\].
    pub(super) hinge_range: [f64; 2],
    /// What is to be said of the numbers from a grid.
    pub(super) site_notes: Vec<Sentence>,
    /// The nodes of a grid around the site, with their numbers.
    pub(super) site_nodes: Vec<Sentence>,
    /// Whether it also makes what only informs: other hinges, the wall without its ties, another a₁ or E.
    pub(super) informs: bool,
}

impl Statement {
    /// Reads the table `[check]` of a file.
    ///
    /// # Errors
    /// [`CheckError`] of the first value that cannot be used, or of a record.
    pub fn read(file: &CheckFile<'_>) -> Result<Self, CheckError> {
        let mut table: CheckTable = file.table()?;
        let from_grid = site::fill(&mut table, file.folder())?;
        let mut statement = Self::new(table)?;
        let bar = statement.table.tie.as_ref().and_then(|tie| tie.bar);
        if bar.is_some() && file.states(&["tie", "bar"]) {
            let message = "the bar of the tie is stated in [tie] and in [check.tie]; leave one out";
            return Err(CheckError::value(&["tie", "bar"], message));
        }
        statement.records = file.records(statement.table.records.as_ref())?;
        if let Some(FromGrid { file, notes, nodes, warnings }) = from_grid {
            statement.records.files.extend(file);
            statement.records.warnings.extend(warnings);
            statement.site_notes = notes;
            statement.site_nodes = nodes;
        }
        let count = motions(&statement.records.named).len();
        if (1..FEWEST_RECORDS).contains(&count) {
            let copied = if count < statement.records.named.len() { " that differ" } else { "" };
            let message =
                format!("records: found {count}{copied}; at least {FEWEST_RECORDS} records (NTC 7.3.5)");
            return Err(CheckError::value(&["records"], message));
        }
        Ok(statement)
    }

    /// Checks the values against each other and the code.
    fn new(table: CheckTable) -> Result<Self, CheckError> {
        let refused = |key, message: String| Err(CheckError::value(&[key], message));
        let is_beam = table.before_activation == Some(Activation::Beam);
        if is_beam != table.young_modulus.is_some() {
            let key = if is_beam { "before_activation" } else { "young_modulus" };
            let message =
                "before_activation = \"beam\" and young_modulus, E in Pa, go together; give both or none";
            return refused(key, message.into());
        }
        if let Some(e) = table.young_modulus.filter(|e| *e < SOFTEST) {
            let doubt = YOUNG_MODULUS.warning(e).map(|doubt| format!("{doubt}; ")).unwrap_or_default();
            let message = format!("{doubt}no masonry has E below {SOFTEST:e} Pa; give young_modulus in Pa");
            return refused("young_modulus", message);
        }
        let mut states = [const { None }; 3];
        for (state, given) in LimitState::ALL.into_iter().zip([&table.sld, &table.slv, &table.slc]) {
            if let Some(given) = given {
                states[state as usize] = Some(limit_state(state, given, &table)?);
            }
        }
        // a method needs the sites of its limit states
        let [_, slv, slc] = states.each_ref().map(Option::is_some);
        if !(slv || (slc && table.method != Method::Linear)) {
            let message = "SLV needs its site: [check.SLV] with ag, F0 and TC";
            return Err(CheckError::value(&["SLV", "ag"], message));
        }
        let confidence_factor = confidence_factor(&table)?;
        let masonry = masonry(&table, confidence_factor)?;
        let hinge_range = table.hinge_range.unwrap_or(HINGE_RANGE);
        let [from, to] = hinge_range;
        if !(from >= 0.01 && to <= 0.99 && from < to) {
            let message = format!("hinge_range = [{from}, {to}] must rise, within 0.01 to 0.99");
            return refused("hinge_range", message);
        }
        if let Some(BarTable(bar)) = table.tie.as_ref().and_then(|tie| tie.bar) {
            let named = |error: ParameterError| CheckError::value(&["tie", "bar"], error.to_string());
            bar.tie(1.0).map_err(named)?;
        }
        if let Some([from, to]) =
            table.record_range.filter(|[from, to]| !(*from > 0.0 && from < to && to.is_finite()))
        {
            let message = format!("record_range = [{from}, {to}] s must rise from above 0");
            return refused("record_range", message);
        }
        let behaviour_factor = table.behaviour_factor.unwrap_or(2.0);
        let target = table.target.unwrap_or(1.0);
        let (records, displacements) = (Records::default(), Displacements::OF_CODE);
        let hinge_levels = hinge_levels(&table)?;
        Ok(Self {
            table,
            hinge_levels,
            confidence_factor,
            behaviour_factor,
            target,
            states,
            displacements,
            records,
            masonry,
            hinge_range,
            site_notes: Vec::new(),
            site_nodes: Vec::new(),
            informs: true,
        })
    }

    /// The height of a level, by its place in `hinge_levels`; `None` where none are stated \[m\].
    pub(super) fn stated_level(&self, level: usize) -> Option<f64> {
        self.table.hinge_levels.as_ref().map(|levels| levels[level])
    }

    /// Returns where the hinge of a strip is; `assumed` names the parameters that nobody stated.
    pub(super) fn hinge_of(&self, assumed: &[&str]) -> Result<Hinge, CheckError> {
        let is_given = !assumed.contains(&"hinge_ratio");
        match self.table.hinge {
            Some(Hinge::Given) if !is_given => {
                let message = "hinge = \"given\" needs hinge_ratio in [geometry]";
                Err(CheckError::value(&["hinge"], message))
            }
            Some(hinge) => Ok(hinge),
            None => Ok(if is_given { Hinge::Given } else { Hinge::LeastAlpha0 }),
        }
    }

    /// Returns what the tie does at the activation.
    pub(super) fn at_activation(&self) -> AtActivation {
        self.table.tie.as_ref().map_or(AtActivation::None, |tie| tie.at_activation)
    }

    /// Returns the parameters of a wall with the bar of the check, where it has none of its own.
    pub(super) fn with_bar(&self, parameters: &Parameters) -> Result<Parameters, CheckError> {
        let mut parameters = parameters.clone();
        let bar = self.table.tie.as_ref().and_then(|tie| tie.bar);
        if bar.is_some() && !parameters.further_ties.is_empty() {
            let message = "[check.tie] holds for all ties, and a bar belongs to each: give [tie.bar] in each \
                           [[tie]], and leave that of [check.tie] out";
            return Err(CheckError::value(&["tie", "bar"], message));
        }
        if let (Some(BarTable(bar)), None) = (bar, &parameters.bar) {
            parameters.bar = Some(bar);
            parameters.apply_bars()?;
        }
        Ok(parameters)
    }

    /// Returns whether accelerations at a height are bounded by that of the ground.
    pub(super) fn bounds_heights(&self) -> bool {
        self.table.height_demand == HeightDemand::NotBelowGround
    }

    /// Returns the building that is stated of a wall above the ground.
    pub(super) fn building(&self) -> Option<&BuildingTable> {
        self.table.building.as_ref().filter(|building| !building.is_ground())
    }

    /// Returns whether the wall is stated to stand on the ground of a building.
    pub(super) fn is_on_ground(&self) -> bool {
        self.table.building.as_ref().is_some_and(BuildingTable::is_ground)
    }

    /// Returns the rule by displacement of SLC, or that of SLV.
    pub(super) fn rules(&self, state: LimitState) -> Displacements {
        self.displacements[usize::from(state == LimitState::Slc)]
    }

    /// Returns the limit states whose checks are made, with their demands.
    pub(super) fn demanded<'a>(
        &'a self,
        demands: &'a Demands,
    ) -> impl Iterator<Item = (&'a StateStatement, &'a Demand)> {
        self.states
            .iter()
            .flatten()
            .filter_map(|given| Some((given, demands[given.state as usize].as_ref()?)))
    }

    /// Returns whether a static check decides. The runs of the dynamic method take the hinge of the checks by
    /// displacement.
    pub(super) fn decides(&self, check: Deciding) -> bool {
        match check {
            Deciding::Sld => self.table.use_class == Some(UseClass::IV),
            Deciding::SlvWithQ => self.table.method == Method::Linear,
            Deciding::Slv | Deciding::Slc => self.table.method != Method::Linear,
        }
    }

    /// Says which checks of the method decide, and where the code has them.
    pub(super) fn by_method(&self) -> (Sentence, &'static str) {
        let has = |state| self.state(state).is_some();
        let decide = match self.table.method {
            Method::Nonlinear if !has(LimitState::Slc) => {
                say!("SLV by displacement decides", "Decide lo SLV in spostamento")
            }
            Method::Nonlinear if !has(LimitState::Slv) => {
                say!("SLC by displacement decides", "Decide lo SLC in spostamento")
            }
            Method::Nonlinear => {
                say!("SLV and SLC by displacement decide", "Decidono SLV e SLC in spostamento")
            }
            Method::Linear => say!("SLV with q decides", "Decide lo SLV con q"),
            Method::Dynamic => {
                say!("The runs under records decide", "Decidono le analisi con accelerogrammi")
            }
        };
        let clause = match self.table.method {
            Method::Nonlinear => "C8.7.1.2.1.8",
            Method::Linear => "C8.7.1.2.1.7",
            Method::Dynamic => "C8.7.1.2.1.9",
        };
        (decide, clause)
    }

    /// Says which checks decide.
    pub(super) fn deciding_checks(&self) -> Sentence {
        let (decide, _) = self.by_method();
        if self.table.use_class != Some(UseClass::IV) || self.state(LimitState::Sld).is_none() {
            return decide;
        }
        let method = decide.trim_end_matches(" decides").trim_end_matches(" decide");
        let italian = decide.of(Language::It);
        Sentence::new(
            format!("{method} and SLD in use class IV decide"),
            format!("{italian} e, in classe d'uso IV, lo SLD"),
        )
    }

    /// Where runs rock as the scene does, and the static checks do not.
    pub(super) fn differs_in_rocking(&self, scene: &Parameters) -> Option<Sentence> {
        let stated = self.table.rocking?.rocking();
        (stated != scene.rocking).then(|| {
            say! {
                "the static checks take rocking = {own} of [check], the runs rocking = {of_scene} of the \
                 scene; state the same in [impact]",
                "le verifiche statiche assumono rocking = {own} di [check], le analisi dinamiche rocking = \
                 {of_scene} della scena; dichiarare lo stesso in [impact]",
                own = stated.name(), of_scene = scene.rocking.name()
            }
            .on_page(say! {
                "the static checks and the runs rock to different sides",
                "le verifiche statiche e le analisi dinamiche oscillano in versi diversi"
            })
        })
    }

    /// Finds what the engineer states that is improbable, and what may be meant.
    pub(super) fn improbable(&self, floors: Option<&Floors>) -> Vec<Warning> {
        let mut found: Vec<_> =
            self.table.young_modulus.and_then(|e| YOUNG_MODULUS.warning(e)).into_iter().collect();
        for given in self.states.iter().flatten() {
            if let Source::Code(ground) = &given.source {
                let tc = ground.t_c / ground.period_factor;
                found.extend(F0.warning(ground.f0).into_iter().chain(TC.warning(tc)));
            }
            let (name, period) = match given.building_period {
                Some(period) => ("building_period", Some(period)),
                None => {
                    ("period of the building", given.modes.iter().flatten().next().map(|mode| mode.period))
                }
            };
            found.extend(period.and_then(|period| Usual::period(name).warning(period)));
        }
        found.extend(floors.into_iter().flat_map(Floors::improbable));
        found
    }

    /// Returns the statements about a limit state; `None` where its check is not made.
    pub fn state(&self, state: LimitState) -> Option<&StateStatement> {
        self.states[state as usize].as_ref()
    }
}

/// Returns the heights at which the wall may open; the base unless others are stated \[m\].
fn hinge_levels(table: &CheckTable) -> Result<Vec<f64>, CheckError> {
    let levels = table.hinge_levels.clone().unwrap_or(vec![0.0]);
    if levels[0] < 0.0 || levels.windows(2).any(|pair| pair[0] >= pair[1]) {
        let message =
            format!("hinge_levels = {levels:?} m are heights above the base: they rise from 0 or above");
        return Err(CheckError::value(&["hinge_levels"], message));
    }
    if levels.len() > 1 && table.slc.as_ref().is_some_and(|slc| slc.displacement.is_some()) {
        let message = "SLC.displacement is the u of one body; with several hinge_levels leave it out, or \
                       check one level alone";
        return Err(CheckError::value(&["SLC", "displacement"], message));
    }
    Ok(levels)
}

/// Returns κ `f_d` = κ `f_m`/(γ FC), C8.7.1.2.1 d) and C8.7.1 \[Pa\].
fn masonry(table: &CheckTable, confidence_factor: f64) -> Result<Option<f64>, CheckError> {
    let Some(strength) = table.masonry_strength else {
        let others = table.masonry_gamma.is_some() || table.stress_block.is_some();
        if others || table.masonry_over_fc.is_some() {
            let message = "masonry_gamma, stress_block and masonry_over_fc count only with masonry_strength, \
                           f_m in Pa; give it, or leave them out";
            return Err(CheckError::value(&["masonry_strength"], message));
        }
        return Ok(None);
    };
    let (gamma, block) = (table.masonry_gamma.unwrap_or(1.0), table.stress_block.unwrap_or(STRESS_BLOCK));
    let over = if table.masonry_over_fc.unwrap_or(true) { confidence_factor } else { 1.0 };
    Ok(Some(block * strength / (gamma * over)))
}

/// The softest masonry, E; less is in another unit \[Pa\].
const SOFTEST: f64 = 1e7;

fn confidence_factor(table: &CheckTable) -> Result<f64, CheckError> {
    let factor = match (table.confidence_factor, table.knowledge_level) {
        (Some(_), Some(_)) => {
            let message = "confidence_factor and knowledge_level state the same; leave one out";
            return Err(CheckError::value(&["knowledge_level"], message));
        }
        (Some(factor), None) => factor,
        (None, Some(KnowledgeLevel::LC2)) => 1.20,
        (None, Some(KnowledgeLevel::LC3)) => 1.00,
        (None, Some(KnowledgeLevel::LC1) | None) => return Ok(LARGEST_CONFIDENCE_FACTOR),
    };
    let is_considered = table.compression_considered || table.masonry_strength.is_some();
    if factor < LARGEST_CONFIDENCE_FACTOR && !is_considered {
        let message = format!(
            "FC = {factor}: FC of LC1, 1.35, applies where compression is neglected (C8.7.1.2.1.3); set the \
             hinges back: give masonry_strength, or a3 < 1 or a smaller thickness and state \
             compression_considered = true"
        );
        let key = table.confidence_factor.map_or("knowledge_level", |_| "confidence_factor");
        return Err(CheckError::value(&[key], message));
    }
    Ok(factor)
}
