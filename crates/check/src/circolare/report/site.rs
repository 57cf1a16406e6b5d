//! The site, what acts at the wall, and their spectra.

use crate::circolare::figure::{Drawn, spectra};
use crate::circolare::{
    BuildingTable, CheckTable, Checked, Demand, DisplacementCheck, FloorSpectrum, GroundSpectrum,
    MEAN_COUNTS_FROM, Mode, Source, StateStatement, Topography,
};
use crate::error::CheckError;
use crate::names::LimitState;
use crate::report::Figure;

use crate::report::markup::{formula, or_dash, shown, table};

/// A symbol with its source, its unit, and its number on the ground.
type OfGround = (&'static str, &'static str, &'static str, fn(&GroundSpectrum) -> f64);

const GROUND: [OfGround; 10] = [
    ("F0", "NTC 3.2", "", |ground| ground.f0),
    ("T_C*", "NTC 3.2", "s", |ground| ground.t_c / ground.period_factor),
    ("S_S", "Tab. 3.2.IV", "", |ground| ground.soil_factor),
    ("S_T", "Tab. 3.2.V", "", |ground| ground.s / ground.soil_factor),
    ("S = S_S S_T", "[3.2.3]", "", |ground| ground.s),
    ("C_C", "Tab. 3.2.IV", "", |ground| ground.period_factor),
    ("T_B = T_C/3", "[3.2.6]", "s", |ground| ground.t_b),
    ("T_C = C_C T_C*", "[3.2.5]", "s", |ground| ground.t_c),
    ("T_D = 4 a_g/g + 1.6", "[3.2.7]", "s", |ground| ground.t_d),
    ("T_E", "Tab. 3.2.VII", "s", |ground| ground.t_e),
];

/// A limit state that is checked, with its demand.
type Stated<'a> = (&'a StateStatement, &'a Demand);

/// Rows of numbers, one column a limit state.
struct Rows<'a> {
    states: Vec<Stated<'a>>,
    rows: Vec<[String; 2]>,
}

impl<'a> Rows<'a> {
    fn new(case: &'a Checked<'_>) -> Self {
        Self { states: case.statement.demanded(&case.demands).collect(), rows: Vec::new() }
    }

    /// Adds a row: symbol, source, unit and values, unless no limit state has one.
    fn row(&mut self, [name, source, unit]: [&str; 3], value: impl Fn(&Stated<'a>) -> String) {
        let values: Vec<_> = self.states.iter().map(value).collect();
        if values.iter().any(|value| value != "–") {
            let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
            let name = format!("{}{unit} <small>{source}</small>", formula(name));
            self.rows.push([name, values.join("</td><td>")]);
        }
    }

    fn table(self) -> String {
        let heads: Vec<_> = self.states.iter().map(|(given, _)| given.state.to_string()).collect();
        let heads: Vec<&str> = std::iter::once("").chain(heads.iter().map(String::as_str)).collect();
        table(&heads, &self.rows)
    }
}

fn some(value: Option<f64>) -> String {
    or_dash(value, shown)
}

fn each(values: impl Iterator<Item = f64>) -> String {
    values.map(shown).collect::<Vec<_>>().join("; ")
}

/// The section of the site: its numbers, and the spectra of its ground.
pub(in crate::circolare) fn section(case: &Checked<'_>) -> Result<Vec<(String, String)>, CheckError> {
    let mut rows = Rows::new(case);
    rows.row(["a_g", "[check]", "g"], |(given, _)| shown(given.ag));
    for (name, source, unit, value) in GROUND {
        rows.row([name, source, unit], |(_, demand)| some(demand.ground().map(value)));
    }
    rows.row(["a_g S", "[3.2.2]", "m/s²"], |(_, demand)| {
        some(demand.ground().map(|ground| ground.acceleration(0.0, 0.05)))
    });
    Ok(vec![("Site hazard".to_owned(), ground_of(case) + &rows.table() + &of_ground(case)?)])
}

/// What acts at the place of the wall: its numbers, and its spectra.
pub(super) fn at_wall(case: &Checked<'_>) -> Result<String, CheckError> {
    let mut rows = Rows::new(case);
    rows.row(["ξ", "C8.7.1.2.1.5, .8", ""], |(given, _)| shown(given.damping));
    let modes = |demand: &Demand, value: fn(&FloorSpectrum, &Mode) -> f64| {
        let of = |floor: &FloorSpectrum| each(floor.modes().iter().map(|mode| value(floor, mode)));
        demand.floor().map_or_else(|| "–".to_owned(), of)
    };
    rows.row(["T_k", "C7.2.3", "s"], |(_, demand)| modes(demand, |_, mode| mode.period));
    rows.row(["γ_k ψ_k", "C7.2.3", ""], |(_, demand)| modes(demand, |_, mode| mode.participation));
    rows.row(["ξ_k", "C8.7.1.2.1.4", ""], |(_, demand)| some(demand.floor().map(FloorSpectrum::damping)));
    rows.row(["S_e(T_k, ξ_k)", "[3.2.2]", "m/s²"], |(_, demand)| {
        modes(demand, |floor, mode| floor.ground().acceleration(mode.period, floor.damping()))
    });
    rows.row(["a_Z,k = S_e(T_k, ξ_k) γ_k ψ_k √(1 + 4 ξ_k²)", "[C7.2.7]", "m/s²"], |(_, demand)| {
        let accelerations = demand.floor().map(|floor| floor.mode_accelerations().iter().copied());
        accelerations.map_or_else(|| "–".to_owned(), each)
    });
    rows.row(["a_Z = √(Σ a_Z,k²)", "[C7.2.8]", "m/s²"], |(_, demand)| {
        some(demand.floor().map(FloorSpectrum::printed_peak))
    });
    rows.row(["A = 1.1 ξ_k^−0.5 η(ξ)", "[C7.2.9]", ""], |(given, demand)| {
        some(demand.floor().map(|floor| floor.amplification(given.damping)))
    });
    Ok(place(case) + &rows.table() + &spectra_at_wall(case)?)
}

/// Soil and topography.
fn ground_of(case: &Checked<'_>) -> String {
    let CheckTable { soil: Some(soil), topography, .. } = &case.statement.table else { return String::new() };
    let topography = match topography {
        None => "T1 (default)".to_owned(),
        Some(Topography::Category(category)) => format!("{category:?}"),
        Some(Topography::Factor(factor)) => shown(*factor),
    };
    format!("<p>Soil {soil:?}, topography {topography}.</p>\n")
}

/// Describes where the wall stands.
fn place(case: &Checked<'_>) -> String {
    let mut said = Vec::new();
    let building = &case.statement.table.building;
    if let Some(BuildingTable {
        storeys: Some(storeys),
        period: Some(period),
        height_ratio: Some(ratio),
        ..
    }) = building
    {
        let [period, ratio] = [*period, *ratio].map(shown);
        said.push(format!(
            "Building of {storeys} storeys with T_1 = {period} s, linear shape of its first mode, wall at \
             {} = {ratio}: {}, {} ([check] building, [C7.2.10]); {} and {} in [C7.2.6]",
            formula("z/H"),
            formula("γ_1 = 3n/(2n + 1)"),
            formula("ψ_1 = z/H"),
            formula("a = 0.8"),
            formula("b = 1.1")
        ));
    } else if building.is_some() {
        said.push("Modes of the building as given in [check.building]".into());
    } else if let Some(floors) = case.floors {
        said.push(format!("The motion of the ground is {}", ::report::escaped(&floors.note())));
    } else if case.demands.iter().flatten().any(|demand| matches!(demand, Demand::Ground(_))) {
        said.push("The wall stands on the ground".into());
    }
    for given in case.statement.states.iter().flatten() {
        let state = given.state;
        match &given.source {
            Source::Code(_) => {}
            Source::Points(points, xi) => said.push(format!(
                "{state}: spectrum at the wall's place, given by {} points at {} % damping",
                points.len(),
                shown(100.0 * xi)
            )),
            Source::Records => said.push(format!("{state}: {} of the records", combined(case))),
        }
    }
    if said.is_empty() { String::new() } else { format!("<p>{}.</p>\n", said.join("; ")) }
}

/// Describes how the spectra of the records are combined.
fn combined(case: &Checked<'_>) -> &'static str {
    let enough = case.statement.records.named.len() >= MEAN_COUNTS_FROM;
    if enough { "mean spectrum" } else { "envelope of the spectra" }
}

/// The period of the governing side in each limit state; 0 for a rigid wall, `None` without a check \[s\].
fn periods(case: &Checked<'_>) -> [Option<f64>; 3] {
    let Some(side) = case.governing() else { return [None; 3] };
    let displaced = |check: Option<DisplacementCheck>| check.map(|check| check.period);
    [side.checks.sld.map(|_| side.curve.t0), displaced(side.checks.slv), displaced(side.checks.slc)]
}

/// Where the axis of periods ends \[s\].
fn last_period(case: &Checked<'_>) -> f64 {
    (1.15 * periods(case).into_iter().flatten().fold(1.0, f64::max)).max(1.5)
}

/// The spectra of the ground; empty where none is by the code.
fn of_ground(case: &Checked<'_>) -> Result<String, CheckError> {
    let grounds: Vec<_> = case
        .statement
        .demanded(&case.demands)
        .filter_map(|(given, demand)| Some((given.state, Demand::Ground(*demand.ground()?))))
        .collect();
    let damping = LimitState::Sld.damping();
    let drawn = grounds.iter().map(|(state, demand)| Drawn { state: *state, demand, damping, period: None });
    let drawn: Vec<_> = drawn.collect();
    if drawn.is_empty() {
        return Ok(String::new());
    }
    let caption = format!("Site: {} at 5 % damping [3.2.2].", formula("S_e(T)"));
    Ok(Figure { caption, plot: spectra(&drawn, "S_e (m/s²)", last_period(case))? }.html())
}

/// The spectra at the wall's place with the periods of the governing side.
fn spectra_at_wall(case: &Checked<'_>) -> Result<String, CheckError> {
    let periods = periods(case);
    // points of another damping have no value for a check that is not made
    let drawn = case.statement.demanded(&case.demands).filter_map(|(given, demand)| {
        let (state, damping) = (given.state, given.damping);
        Some(Drawn { state, demand, damping, period: Some(periods[state as usize]?) })
    });
    let drawn: Vec<_> = drawn.collect();
    if drawn.is_empty() {
        return Ok(String::new());
    }
    let is_of_code = case.statement.demanded(&case.demands).any(|(_, demand)| demand.ground().is_some());
    let at_height = drawn.iter().any(|drawn| matches!(drawn.demand, Demand::Floor(_)));
    let (symbol, source) = if at_height { ("S_eZ", "[C7.2.5]") } else { ("S_e", "[3.2.2]") };
    let source = if is_of_code { source } else { "as given" };
    let caption = format!(
        "At the wall: {} {source} at the damping of the mechanism; ▲ {} of the governing side.",
        formula(&format!("{symbol}(T, ξ)")),
        formula("T0, T_SLV, T_SLC")
    );
    let plot = spectra(&drawn, &format!("{symbol} (m/s²)"), last_period(case))?;
    Ok(Figure { caption, plot }.html())
}
