//! The site, the building and their spectra.

use crate::circolare::figure::{DEMAND, Drawn, color, spectra};
use crate::circolare::{
    BuildingTable, CheckTable, Checked, Demand, FloorSpectrum, GroundSpectrum, LimitState, MEAN_COUNTS_FROM,
    Mode, Source, StateStatement, Topography,
};
use crate::error::CheckError;
use crate::report::Figure;
use ::report::palette::sign;

use crate::report::markup::{formula, shown, table};

/// A limit state that is checked, with its demand.
fn checked<'a>(case: &'a Checked<'_>) -> impl Iterator<Item = (&'a StateStatement, &'a Demand)> {
    let statement = case.statement;
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
pub(super) fn values(case: &Checked<'_>) -> String {
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
    let some = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), shown);
    row("a_g", "[check]", "g", &|(given, _)| shown(given.ag));
    for (name, source, unit, value) in GROUND {
        row(name, source, unit, &|(_, demand)| some(ground(demand).map(value)));
    }
    row("a_g S", "[3.2.2]", "m/s²", &|(_, demand)| {
        some(ground(demand).map(|ground| ground.acceleration(0.0, 0.05)))
    });
    row("ξ", "C8.7.1.2.1.5, .8", "", &|(given, _)| shown(given.damping));
    let each = |values: &[f64]| values.iter().copied().map(shown).collect::<Vec<_>>().join("; ");
    let modes = |demand: &Demand, value: fn(&Mode) -> f64| {
        let values = |floor: &FloorSpectrum| each(&floor.modes().iter().map(value).collect::<Vec<_>>());
        floor(demand).map_or_else(|| "–".to_owned(), values)
    };
    row("T_k", "C7.2.3", "s", &|(_, demand)| modes(demand, |mode| mode.period));
    row("γ_k ψ_k", "C7.2.3", "", &|(_, demand)| modes(demand, |mode| mode.participation));
    row("ξ_k", "C8.7.1.2.1.4", "", &|(_, demand)| some(floor(demand).map(FloorSpectrum::damping)));
    row("a_Z,k", "[C7.2.7]", "m/s²", &|(_, demand)| {
        floor(demand).map_or_else(|| "–".to_owned(), |floor| each(floor.mode_accelerations()))
    });
    row("a_Z", "[C7.2.8]", "m/s²", &|(_, demand)| some(floor(demand).map(FloorSpectrum::printed_peak)));
    row("A_k", "[C7.2.9]", "", &|(given, demand)| {
        some(floor(demand).map(|floor| floor.amplification(given.damping)))
    });
    let heads: Vec<_> = states.iter().map(|(given, _)| given.state.to_string()).collect();
    let heads: Vec<&str> = std::iter::once("").chain(heads.iter().map(String::as_str)).collect();
    place(case) + &table(&heads, &rows)
}

/// Describes where the wall stands.
fn place(case: &Checked<'_>) -> String {
    let mut said = Vec::new();
    let CheckTable { soil, topography, building, .. } = &case.statement.table;
    if let Some(soil) = soil {
        let topography = match topography {
            None => "T1 (default)".to_owned(),
            Some(Topography::Category(name)) => name.clone(),
            Some(Topography::Factor(factor)) => shown(*factor),
        };
        said.push(::report::escaped(&format!("Soil {soil}, topography {topography}")));
    }
    if let Some(BuildingTable {
        storeys: Some(storeys),
        period: Some(period),
        height_ratio: Some(ratio),
        ..
    }) = building
    {
        let [period, ratio] = [*period, *ratio].map(shown);
        said.push(format!(
            "building of {storeys} storeys with {} = {period} s, linear shape of its first mode, wall at \
             {} = {ratio}",
            formula("T_1"),
            formula("z/H")
        ));
    } else if building.is_some() {
        said.push("modes of the building as given in [check.building]".into());
    } else if let Some(floors) = case.floors {
        said.push(format!("the motion of the ground is {}", ::report::escaped(&floors.note())));
    } else if case.demands.iter().flatten().any(|demand| matches!(demand, Demand::Ground(_))) {
        said.push("the wall stands on the ground".into());
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

/// The spectra of the site, and those at the wall's place with the periods of the governing side.
pub(super) fn figures(case: &Checked<'_>) -> Result<String, CheckError> {
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
        text += &Figure { caption, plot: spectra(&of_ground, "S_e (m/s²)", last)? }.html();
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
        let plot = spectra(&at_wall, &format!("{symbol} (m/s²)"), last)?;
        text += &Figure { caption, plot }.html();
    }
    Ok(text)
}

/// The colours of spectra.
fn key(drawn: &[Drawn<'_>], has_marks: bool) -> String {
    let one = |drawn: &Drawn<'_>| {
        let color = color(drawn.state);
        let line = format!("<i class=\"chip line\" style=\"border-top:2px solid {color}\"></i>");
        let mark = if has_marks { sign(color, DEMAND) } else { String::new() };
        format!("<span>{line}{mark}{}, {} %</span>", drawn.state, shown(100.0 * drawn.damping))
    };
    format!("<span class=\"key\">{}</span>", drawn.iter().map(one).collect::<String>())
}
