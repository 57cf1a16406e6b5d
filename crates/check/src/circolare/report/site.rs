//! The site, what acts at the wall, and their spectra.

use super::figure::{Drawn, spectra};
use crate::circolare::checks::DisplacementCheck;
use crate::circolare::outcome::Checked;
use crate::circolare::statement::states::{Source, StateStatement};
use crate::circolare::statement::table::{BuildingTable, CheckTable};
use crate::code::verdict::Section;
use crate::error::CheckError;
use crate::ntc::demand::{Demand, MEAN_COUNTS_FROM};
use crate::ntc::floor::{FloorSpectrum, Mode};
use crate::ntc::ground::{GroundSpectrum, Topography};
use crate::sections::origin::Figure;
use crate::words::formulas::formula;
use crate::words::markup::{aligned, list, paragraph, table};
use crate::words::names::LimitState;
use crate::words::others::storeys;
use crate::words::{Language, Sentence, Written, above, joined, say, shown};

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
    language: Language,
    lines: Vec<[String; 2]>,
}

impl<'a> Rows<'a> {
    fn new(case: &'a Checked<'_>, language: Language) -> Self {
        let states = case.statement.demanded(&case.demands).collect();
        Self { states, language, lines: Vec::new() }
    }

    /// Adds a row: symbol, source, unit and values, unless no limit state has one.
    fn row(&mut self, [name, source, unit]: [&str; 3], value: impl Fn(&Stated<'a>) -> String) {
        let values: Vec<_> = self.states.iter().map(value).collect();
        if values.iter().any(|value| value != "–") {
            let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
            let name = format!("{}{unit} <small>{source}</small>", formula(&self.language.decimal(name)));
            self.lines.push([name, aligned(values).join("</td><td>")]);
        }
    }

    fn table(self) -> String {
        let heads = self.states.iter().map(|(given, _)| given.state.to_string());
        let heads: Vec<_> = std::iter::once(String::new()).chain(heads).collect();
        table(&heads, &self.lines)
    }
}

fn each(values: impl Iterator<Item = f64>, language: Language) -> String {
    values.map(|value| language.shown(value)).collect::<Vec<_>>().join("; ")
}

/// The section of the site: its numbers, and the spectra of its ground.
pub(in crate::circolare) fn section(
    case: &Checked<'_>,
    language: Language,
) -> Result<Vec<Section>, CheckError> {
    let mut rows = Rows::new(case, language);
    let some = |value: Option<f64>| language.or_dash(value);
    rows.row(["a_g", "NTC 3.2", "g"], |(given, _)| language.shown(given.ag));
    for (name, source, unit, value) in GROUND {
        rows.row([name, source, unit], |(_, demand)| some(demand.ground().map(value)));
    }
    rows.row(["a_g S", "[3.2.2]", "m/s²"], |(_, demand)| {
        some(demand.ground().map(|ground| ground.acceleration(0.0, 0.05)))
    });
    let nodes = list(&case.statement.site_nodes, language);
    let markup = ground_of(case, language) + &rows.table() + &nodes + &of_ground(case, language)?;
    Ok(vec![Section::new(say!("Site hazard", "Pericolosità sismica del sito"), markup)])
}

/// What acts at the place of the wall: its numbers, of several bodies at the level of each, and the spectra
/// of the level that governs.
pub(super) fn at_wall(case: &Checked<'_>, language: Language) -> Result<String, CheckError> {
    let levels = case.levels();
    let at = |level: &&Checked<'_>| {
        let head = if levels.len() > 1 { level.heading(language) } else { String::new() };
        head + &at_level(level, language)
    };
    let tables: String = levels.iter().map(at).collect();
    Ok(tables + &spectra_at_wall(case, language)?)
}

/// What acts at the level of a body.
fn at_level(case: &Checked<'_>, language: Language) -> String {
    let mut rows = Rows::new(case, language);
    let some = |value: Option<f64>| language.or_dash(value);
    rows.row(["ξ", "C8.7.1.2.1.5, .8", ""], |(given, _)| language.shown(given.damping));
    let modes = |demand: &Demand, value: fn(&FloorSpectrum, &Mode) -> f64| {
        let of = |floor: &FloorSpectrum| each(floor.modes().iter().map(|mode| value(floor, mode)), language);
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
        accelerations.map_or_else(|| "–".to_owned(), |values| each(values, language))
    });
    rows.row(["a_Z = √(Σ a_Z,k²)", "[C7.2.8]", "m/s²"], |(_, demand)| {
        some(demand.floor().map(FloorSpectrum::printed_peak))
    });
    rows.row(["A = 1.1 ξ_k^−0.5 η(ξ)", "[C7.2.9]", ""], |(given, demand)| {
        some(demand.floor().map(|floor| floor.amplification(given.damping)))
    });
    let place = place(case).map_or_else(String::new, |place| paragraph(&place, language));
    place + &rows.table()
}

/// Soil and topography.
fn ground_of(case: &Checked<'_>, language: Language) -> String {
    let CheckTable { soil: Some(soil), topography, .. } = &case.statement.table else { return String::new() };
    let topography = match topography {
        None => say!("T1 (default)", "T1 (valore predefinito)"),
        Some(Topography::Category(category)) => Sentence::same(format!("{category:?}")),
        Some(Topography::Factor(factor)) => say!("{factor}", "{factor}", factor = Written(shown(*factor))),
    };
    let soil = format!("{soil:?}");
    let said = say! {
        "Soil {soil}, topography {topography}.",
        "Sottosuolo {soil}, topografia {topography}.", soil, topography
    };
    paragraph(&said, language)
}

/// Describes where the wall stands; `None` where nothing is to be said.
fn place(case: &Checked<'_>) -> Option<Sentence> {
    let mut said = Vec::new();
    let building = case.statement.building();
    if let (Some(BuildingTable { storeys: Some(storeys), period: Some(period), .. }), Some(ratio)) =
        (building, case.height_ratio())
    {
        said.push(say! {
            "Building of {storeys} storeys with T_1 = {period} s, linear shape of its first mode, wall at \
             `z/H` = {ratio}: `γ_1 = 3n/(2n + 1)`, `ψ_1 = z/H` ([C7.2.10]); `a = 0.8` and \
             `b = 1.1` in [C7.2.6]",
            "Edificio di {storeys} piani con T_1 = {period} s, prima forma modale lineare, parete a `z/H` = \
             {ratio}: `γ_1 = 3n/(2n + 1)`, `ψ_1 = z/H` ([C7.2.10]); `a = 0,8` e `b = 1,1` \
             nella [C7.2.6]",
            storeys = storeys.to_string(), period = Written(shown(*period)), ratio = Written(shown(ratio))
        });
    } else if building.is_some() {
        said.push(say! {
            "Modes of the building as stated",
            "Modi dell'edificio come dichiarati"
        });
    } else if let Some(floors) = case.floors.as_ref().filter(|_| !case.statement.is_on_ground()) {
        let of = storeys(floors);
        said.push(say!("The motion of the ground is {of}", "Il moto del suolo è {of}", of));
    } else if case.demands.iter().flatten().any(|demand| matches!(demand, Demand::Ground(_))) {
        said.push(say!("The wall stands on the ground", "La parete poggia al suolo"));
    }
    let enough = case.statement.records.named.len() >= MEAN_COUNTS_FROM;
    for given in case.statement.states.iter().flatten() {
        let state = given.state;
        said.extend(match &given.source {
            Source::Code(_) => None,
            Source::Points(points, xi) => Some(say! {
                "{state}: spectrum at the wall's place, given by {count} points at {percent} % damping",
                "{state}: spettro alla quota della parete, fornito per {count} punti con smorzamento del \
                 {percent} %", state, count = points.len(), percent = Written(shown(100.0 * xi))
            }),
            Source::Records if enough => Some(say! {
                "{state}: mean spectrum of the records", "{state}: spettro medio degli accelerogrammi", state
            }),
            Source::Records => Some(say! {
                "{state}: envelope of the spectra of the records",
                "{state}: inviluppo degli spettri degli accelerogrammi", state
            }),
        });
    }
    let all = joined(&said, "; ");
    (!said.is_empty()).then(|| say!("{all}.", "{all}.", all))
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
fn of_ground(case: &Checked<'_>, language: Language) -> Result<String, CheckError> {
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
    let caption =
        say!("Site: `S_e(T)` at 5 % damping [3.2.2].", "Sito: `S_e(T)` con smorzamento del 5 % [3.2.2].");
    let plot = spectra(&drawn, "S_e (m/s²)", last_period(case), language)?;
    Ok(Figure { caption: caption.markup(language), plot }.html(language))
}

/// The spectra at the wall's place with the periods of the governing side.
fn spectra_at_wall(case: &Checked<'_>, language: Language) -> Result<String, CheckError> {
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
    let source = if is_of_code { Sentence::same(source) } else { say!("as given", "come fornito") };
    let place = above(say!("At the wall", "Alla parete"), case.stated_level());
    let caption = say! {
        "{place}: `{symbol}(T, ξ)` {source} at the damping of the mechanism; ▲ `T0`, T_SLV, T_SLC of the \
         governing side.",
        "{place}: `{symbol}(T, ξ)` {source} con lo smorzamento del meccanismo; ▲ `T0`, T_SLV, T_SLC del \
         verso determinante.", place, symbol, source
    };
    let plot = spectra(&drawn, &format!("{symbol} (m/s²)"), last_period(case), language)?;
    Ok(Figure { caption: caption.markup(language), plot }.html(language))
}
