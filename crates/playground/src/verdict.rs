//! The result in a sentence, and its numbers.

use report::number;
use rocking_wall::solver::Yielding;
use rocking_wall::variables::{DampingModel, Impact};
use rocking_wall::wall::Wall;
use run::page::tie;
use scene::Scene;
use scene::response::{Fate, Response};
use serde_json::{Value, json};

/// Part of the static instability displacement below which the wall counts as not having moved.
const STILL: f64 = 5e-3;

/// Describes whether the wall stands and how far it moves, and what the movement is measured by.
pub(crate) fn verdict(scene: &Scene, wall: &Wall, response: &Response) -> Value {
    let summary = &response.summary;
    let peak = response.demands.displacement.largest();
    let u_ins = wall.body().instability.of(peak.value);
    let (state, headline) = match summary.fate.words(2) {
        Some(words) => ("falls", format!("The wall {words}")),
        None if summary.u_ratio_max < STILL => ("stands", "The wall stands and hardly moves".to_owned()),
        None => {
            let percent = number(100.0 * summary.u_ratio_max, 2);
            ("stands", format!("The wall stands: it reaches {percent} % of u_ins"))
        }
    };
    let [largest, u_ins] = [peak.value.abs(), u_ins].map(|metres| number(1000.0 * metres, 3));
    let detail = match summary.fate {
        Fate::Falls { .. } => format!("It overturns beyond {u_ins} mm."),
        _ => format!(
            "Largest displacement {largest} mm at {:.2} s; it overturns beyond {u_ins} mm.",
            peak.time
        ),
    } + &tie::said(response);
    let onset = wall.rocking_onset();
    let shaken = scene.excitation.as_ref().map(|excitation| {
        let peak = excitation.bottom().peak();
        format!(
            " The ground's peak of {} m/s² is {} times the static onset of rocking, {} m/s².",
            number(peak, 3),
            number(peak / onset, 2),
            number(onset, 3)
        )
    });
    json!({ "state": state, "headline": headline, "detail": detail + shaken.as_deref().unwrap_or_default() })
}

/// Lists what follows from the parameters, as names, values and units for people.
pub(crate) fn facts(scene: &Scene, wall: &Wall, response: &Response) -> Vec<[String; 2]> {
    let (body, parameters) = (wall.body(), &scene.parameters);
    let row = |name: &str, value: f64, unit: &str| [name.to_owned(), format!("{} {unit}", number(value, 3))];
    let mut rows = vec![
        row("instability displacement u_ins", 1000.0 * body.instability.positive, "mm"),
        row("rigid strength F₀", 1e-3 * body.strength.positive, "kN"),
        row("static onset of rocking", wall.rocking_onset(), "m/s²"),
        row("mass", body.mass, "kg"),
    ];
    if wall.omega1() > 0.0 {
        rows.push(row("elastic period T₁", std::f64::consts::TAU / wall.omega1(), "s"));
    }
    if parameters.damping_model != DampingModel::None && wall.damping_ratio() > 0.0 {
        rows.push(row("damping ratio ξ", 100.0 * wall.damping_ratio(), "%"));
    }
    if parameters.impact == Impact::Restitution {
        rows.push(row("coefficient of restitution e", wall.restitution().positive, ""));
    }
    for tie in &response.demands.ties {
        rows.push(row("largest force of the tie", 1e-3 * tie.force.value, "kN"));
        if let Some(reached) = tie.strength {
            rows.push(row("the tie reaches its strength at", reached.time, "s"));
        }
        if let Some(Yielding { elongation, breaks }) = tie.yielding {
            rows.push(row("largest plastic elongation of the tie", 1000.0 * elongation.most(), "mm"));
            let first = breaks.into_iter().flatten().reduce(f64::min);
            rows.extend(first.map(|time| row("the tie breaks at", time, "s")));
        }
    }
    rows.push(["half cycles of rocking".to_owned(), response.demands.half_cycles.to_string()]);
    let largest = response.demands.reaction_bottom.largest().value.abs();
    rows.push(row("largest horizontal force at the base", 1e-3 * largest, "kN"));
    rows
}
