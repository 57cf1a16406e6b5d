//! The dynamic check: its runs.

use crate::circolare::{Checked, DynamicRun, DynamicState, MEAN_COUNTS_FROM};
use crate::names::{LimitState, Side};
use ::report::escaped;

use super::spectrum::gives;

use crate::report::markup::{Calculation, formula, millimetres, result, shown, table};
use crate::report::project::as_written;

/// The section of the dynamic check, if there is one.
pub(super) fn section(case: &Checked<'_>) -> Option<String> {
    let dynamic = case.outcome.dynamic.as_ref()?;
    let factor = shown(case.statement.confidence_factor);
    let mut text = format!(
        "<p>The wall of the scene, with its damping, restitution and one-sided rocking, moves under each \
         record, with both signs unless stated otherwise. FC = {factor} divides its forces (gravity, \
         overburden, tie), not its masses. The check is passed if no run exceeds d_0 or fails by its tie, \
         and the mean of the largest |{}| over the threshold of its side (of fewer than {MEAN_COUNTS_FROM} \
         records the largest, NTC 7.3.5) is at most 1. ζ_E is the lowest factor on all records \
         that fails, searched upwards.</p>\n",
        formula("d")
    );
    for (name, state) in dynamic.states() {
        text += &one(case, name, state);
    }
    Some(text)
}

fn one(case: &Checked<'_>, name: LimitState, state: &DynamicState) -> String {
    let judged = state.judged;
    let mut lines = Calculation::default();
    let mut thresholds = Vec::new();
    for (side, _, verdict) in case.sides() {
        let Some(check) = verdict.displacement(name) else { continue };
        thresholds.push(check.d);
        let words = format!("Threshold and zero of the curve, {}", escaped(side));
        let [d, d_0] = [check.d, verdict.curve.d0].map(millimetres);
        lines.say(&words, &format!("d_{name} = <b>{d}</b> mm, d_0 = <b>{d_0}</b> mm"));
    }
    for side in [Side::Positive, Side::Negative] {
        // the runs rock as the scene does, to sides that the static checks leave out, too
        let left_out = state.thresholds[side as usize].filter(|_| case.outcome.sides.of(side).is_none());
        if let Some(d) = left_out {
            let side = escaped(side.name());
            let words =
                format!("Threshold on the side {side}, which the static checks leave out: overturning");
            lines.say(&words, &format!("{} = <b>{}</b> mm", formula("(d/u) u_ins"), millimetres(d)));
        }
    }
    let few = case.statement.records.named.len() < MEAN_COUNTS_FROM;
    let words = if few { "Largest of the maxima" } else { "Mean of the maxima" };
    lines.line([words, "NTC 7.3.5"], "d", (1e3 * judged.d, "mm"));
    // with sides of different thresholds the ratio is no quotient of these numbers
    if let [threshold] = thresholds[..]
        && gives(threshold / judged.d, judged.ratio)
    {
        lines.know(&[(&format!("d_{name}"), 1e3 * threshold), ("d", 1e3 * judged.d)]);
    }
    let words = ["Threshold over it, each side by its own", ""];
    lines.line(words, &format!("d_{name}/d"), (judged.ratio, ""));
    for (words, count) in [
        ("Runs beyond the zero of the curve", judged.beyond_d0),
        ("Runs at the strength of the tie", judged.at_strength),
    ] {
        lines.say(words, &format!("<b>{count}</b>/{}", state.runs.len()));
    }
    lines.line(["Lowest factor on all records that fails", "NTC 8.3"], "ζ_E", (state.zeta, ""));
    lines.say("Result", result(judged.passed));
    let rows: Vec<_> = state.runs.iter().map(row).collect();
    let factor = if case.statement.table.record_scale == crate::circolare::RecordScale::Ag {
        format!("factor to {}", formula("a_g S"))
    } else {
        "factor".to_owned()
    };
    let heads = ["record", &factor, "largest d, u &gt; 0 [mm]", "largest d, u &lt; 0 [mm]", "beyond d_0"];
    format!("<h3>{name}</h3>\n{}{}", lines.table(), table(&heads, &rows))
}

fn row(run: &DynamicRun) -> [String; 5] {
    let [positive, negative] = run.d.map(|d| ::report::number(1000.0 * d, 4));
    let beyond = if run.beyond_d0 { "<span class=\"fails\">yes</span>" } else { "no" };
    [
        as_written(&run.record),
        ::report::number(run.sign * run.factor, 4),
        positive,
        negative,
        beyond.to_owned(),
    ]
}
