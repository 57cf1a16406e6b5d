//! The site, the building and their spectra.

use crate::circolare::figure::{DEMAND, Drawn, color, spectra};
use crate::circolare::{
    Demand, FloorSpectrum, GroundSpectrum, LimitState, MEAN_COUNTS_FROM, Mode, Source, StateStatement,
};
use crate::error::CheckError;
use ::report::palette::sign;
use ::report::plot::Plot;

use super::Case;
use super::markup::{formula, number, table};

/// Width of a figure on a phone \[px\].
const NARROW: f64 = 390.0;

/// A limit state that is checked, with its demand.
fn checked<'a>(case: &'a Case<'_>) -> impl Iterator<Item = (&'a StateStatement, &'a Demand)> {
    let statement = case.report.statement;
    LimitState::ALL
        .into_iter()
        .zip(&case.demands)
        .filter_map(|(state, demand)| Some((statement.state(state)?, demand.as_ref()?)))
}

/// The ground below a demand of the code.
fn ground(demand: &Demand) -> Option<&GroundSpectrum> {
    match demand {
        Demand::Ground(ground) => Some(ground),
        Demand::Floor(floor) => Some(floor.ground()),
        Demand::Points(..) | Demand::Records(_) => None,
    }
}

/// The spectrum of a floor of the building, if the demand is one.
fn floor(demand: &Demand) -> Option<&FloorSpectrum> {
    match demand {
        Demand::Floor(floor) => Some(floor),
        _ => None,
    }
}

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

/// The numbers of the site and of the building, one column a limit state.
pub(super) fn values(case: &Case<'_>) -> String {
    let states: Vec<_> = checked(case).collect();
    let mut rows = Vec::new();
    let mut row =
        |name: &str, source: &str, unit: &str, value: &dyn Fn(&(&StateStatement, &Demand)) -> String| {
            let values: Vec<_> = states.iter().map(value).collect();
            if values.iter().any(|value| value != "–") {
                let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
                let name = format!("{}{unit} <small>{source}</small>", formula(name));
                rows.push([name, values.join("</td><td>")]);
            }
        };
    let some = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
    row("a_g", "[check]", "g", &|(given, _)| number(given.ag));
    for (name, source, unit, value) in GROUND {
        row(name, source, unit, &|(_, demand)| some(ground(demand).map(value)));
    }
    row("a_g S", "[3.2.2]", "m/s²", &|(_, demand)| {
        some(ground(demand).map(|ground| ground.acceleration(0.0, 0.05)))
    });
    row("ξ", "C8.7.1.2.1.5, .8", "", &|(given, _)| number(given.damping));
    let modes = |demand: &Demand, value: fn(&FloorSpectrum, &Mode) -> f64| {
        let Some(floor) = floor(demand) else { return "–".to_owned() };
        let values = floor.modes().iter().map(|mode| number(value(floor, mode)));
        values.collect::<Vec<_>>().join("; ")
    };
    row("T_k", "C7.2.3", "s", &|(_, demand)| modes(demand, |_, mode| mode.period));
    row("γ_k ψ_k", "C7.2.3", "", &|(_, demand)| modes(demand, |_, mode| mode.participation));
    row("ξ_k", "C8.7.1.2.1.4", "", &|(_, demand)| some(floor(demand).map(FloorSpectrum::damping)));
    row("a_Z,k", "[C7.2.7]", "m/s²", &|(_, demand)| modes(demand, FloorSpectrum::mode_acceleration));
    row("a_Z", "[C7.2.8]", "m/s²", &|(_, demand)| some(floor(demand).map(FloorSpectrum::peak_acceleration)));
    row("A_k", "[C7.2.9]", "", &|(given, demand)| {
        some(floor(demand).map(|floor| floor.amplification(given.damping)))
    });
    let heads: Vec<_> = states.iter().map(|(given, _)| given.state.to_string()).collect();
    let heads: Vec<&str> = std::iter::once("").chain(heads.iter().map(String::as_str)).collect();
    place(case) + &table(&heads, &rows)
}

/// Describes where the wall stands.
fn place(case: &Case<'_>) -> String {
    let mut said = Vec::new();
    let given = &case.given;
    if let Some(soil) = given.text(&["soil"]) {
        let topography = given.text(&["topography"]).unwrap_or_else(|| "T1 (default)".into());
        said.push(format!("Soil {soil}, topography {topography}"));
    }
    let of = |key: &str| given.text(&["building", key]);
    if let (Some(storeys), Some(period), Some(ratio)) = (of("storeys"), of("period"), of("height_ratio")) {
        said.push(format!(
            "building of {storeys} storeys with {} = {period} s, linear shape of its first mode, wall at \
             {} = {ratio}",
            formula("T_1"),
            formula("z/H")
        ));
    } else if case.report.statement.has_building {
        said.push("modes of the building as given in [check.building]".into());
    } else if let Some(floors) = case.report.subject.floors {
        said.push(format!("the motion of the ground is {}", ::report::escaped(&floors.note())));
    } else if case.demands.iter().flatten().any(|demand| matches!(demand, Demand::Ground(_))) {
        said.push("the wall stands on the ground".into());
    }
    for given in case.report.statement.states.iter().flatten() {
        let state = given.state;
        match &given.source {
            Source::Code(_) => {}
            Source::Points(points, xi) => said.push(format!(
                "{state}: spectrum at the wall's place, given by {} points at {} % damping",
                points.len(),
                number(100.0 * xi)
            )),
            Source::Records => said.push(format!("{state}: {} of the records", combined(case))),
        }
    }
    if said.is_empty() { String::new() } else { format!("<p>{}.</p>\n", said.join("; ")) }
}

/// Describes how the spectra of the records are combined.
fn combined(case: &Case<'_>) -> &'static str {
    let enough = case.report.records.named().len() >= MEAN_COUNTS_FROM;
    if enough { "mean spectrum" } else { "envelope of the spectra" }
}

/// The spectra of the site, and those at the wall's place with the periods of the governing side.
pub(super) fn figures(case: &Case<'_>) -> Result<String, CheckError> {
    let Some(side) = case.governing() else { return Ok(String::new()) };
    let period = |state: LimitState| match state {
        LimitState::Sld => side.sld.map(|_| side.t0),
        LimitState::Slv => side.slv.map(|check| check.period),
        LimitState::Slc => side.slc.map(|check| check.period),
    };
    let last = LimitState::ALL.into_iter().filter_map(period).fold(1.0, f64::max);
    let last = (1.15 * last).max(1.5);
    let (mut of_ground, mut at_wall) = (Vec::new(), Vec::new());
    let grounds: Vec<_> = checked(case)
        .filter_map(|(given, demand)| Some((given.state, Demand::Ground(*ground(demand)?))))
        .collect();
    for (state, demand) in &grounds {
        of_ground.push(Drawn { state: *state, demand, damping: LimitState::Sld.damping(), period: None });
    }
    for (given, demand) in checked(case) {
        let state = given.state;
        // points of another damping have no value for a check that is not made
        if let Some(period) = period(state) {
            at_wall.push(Drawn { state, demand, damping: given.damping, period: Some(period) });
        }
    }
    let mut text = String::new();
    if !of_ground.is_empty() {
        let caption =
            format!("Site: {} at 5 % damping [3.2.2]. {}", formula("S_e(T)"), key(&of_ground, false));
        text += &figure(&caption, &spectra(&of_ground, "S_e (m/s²)", last)?);
    }
    if !at_wall.is_empty() {
        let at_height = at_wall.iter().any(|drawn| matches!(drawn.demand, Demand::Floor(_)));
        let (symbol, source) = if at_height { ("S_eZ", "[C7.2.5]") } else { ("S_e", "[3.2.2]") };
        let source = if of_ground.is_empty() { "as given" } else { source };
        let caption = format!(
            "At the wall: {} {source} at the damping of the mechanism; {} of the governing side. {}",
            formula(&format!("{symbol}(T, ξ)")),
            formula("T0, T_SLV, T_SLC"),
            key(&at_wall, true)
        );
        text += &figure(&caption, &spectra(&at_wall, &format!("{symbol} (m/s²)"), last)?);
    }
    Ok(text)
}

/// The colours of spectra.
fn key(drawn: &[Drawn<'_>], has_marks: bool) -> String {
    let one = |drawn: &Drawn<'_>| {
        let color = color(drawn.state);
        let line = format!("<i class=\"chip line\" style=\"border-top:2px solid {color}\"></i>");
        let mark = if has_marks { sign(color, DEMAND) } else { String::new() };
        format!("<span>{line}{mark}{}, {} %</span>", drawn.state, number(100.0 * drawn.damping))
    };
    format!("<span class=\"key\">{}</span>", drawn.iter().map(one).collect::<String>())
}

/// A figure with its form for phones.
pub(super) fn figure(caption: &str, plot: &Plot) -> String {
    let narrow = Plot { size: [NARROW, 300.0], ..plot.clone() };
    format!(
        "<figure><figcaption>{caption}</figcaption><div class=\"plot wide\">{}</div><div class=\"plot \
         narrow\">{}</div></figure>\n",
        plot.svg(),
        narrow.svg()
    )
}
