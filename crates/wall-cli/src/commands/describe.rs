//! `wall describe`: what follows from a wall's parameters.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use report::table::significant;
use rocking_wall::solver::Method;
use rocking_wall::wall::{Fact, Parameters, TieNumbers, TiePart, Wall, usage};

use crate::args::{SceneArguments, apply_set, svg_file};
use crate::output::{self, Console};
use run::capacity::{Capacity, with_curve};
use run::drawing;

/// Difference of a coefficient of restitution from that by impulses which is worth saying.
const LARGEST_DIFFERENCE: f64 = 0.05;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Limit states as fractions of `u_ins` to show secant periods at, instead of the scene's
    /// [default: 0.1,0.4,0.6,1]
    #[arg(long, value_name = "FRACTIONS", value_delimiter = ',')]
    thresholds: Option<Vec<f64>>,
    /// Write the corners and limit states of the capacity curve as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw the capacity curve with its secants, as SVG
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    plot: Option<PathBuf>,
    /// Draw the wall to scale with its hinges, openings, loads and tie, as SVG
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    drawing: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn outputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.csv.iter().chain(&self.plot).chain(&self.drawing)
    }
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load(console)?;
    apply_set(&arguments.scene.set, &mut scene)?;
    console.check_distinct(arguments.scene.inputs(&scene), arguments.outputs())?;
    scene.set_output(None, None, arguments.thresholds.clone()).context("--thresholds")?;
    let parameters = &scene.parameters;
    let wall = arguments.scene.named(Wall::new(parameters))?;
    let method = Method::new(parameters, &wall, parameters.tolerance)?;
    let capacity = Capacity::new(&wall, &scene.thresholds);
    console.save(arguments.plot.as_ref(), || with_curve(capacity.plot(), scene.curve.as_ref()).picture())?;
    console.save(arguments.csv.as_ref(), || capacity.table().csv())?;
    console.save(arguments.drawing.as_ref(), || drawing::svg(&wall, parameters))?;
    let facts = wall.facts();
    let warnings = scene.warnings_of(&wall).map(ToString::to_string);
    let warnings = warnings.chain(disagreement(parameters, &wall));
    let law = if parameters.multilinear.is_some() { "multilinear" } else { parameters.force_law.name() };
    let words = [
        ("title", scene.title.clone()),
        ("mechanism", parameters.mechanism.name().to_owned()),
        ("kinematics", parameters.kinematics.name().to_owned()),
        ("force_law", law.to_owned()),
        ("damping_model", parameters.damping_model.name().to_owned()),
        ("impact", parameters.impact.name().to_owned()),
        ("solver", method_name(&method).to_owned()),
    ];
    let curve = scene.curve.iter().map(|curve| ("curve".to_owned(), curve.note()));
    let words = words.map(|(name, value)| (name.to_owned(), value)).into_iter();
    let words = words.chain(curve).chain(ties(parameters));
    if arguments.json {
        let words = words.map(|(name, value)| (name, value.into()));
        let facts = facts.iter().map(|fact| (fact.name.to_string(), fact.value.into()));
        let mut object: serde_json::Map<_, _> = words.chain(facts).collect();
        let backbone: Vec<_> = wall.backbone().into_iter().map(|(u, force)| [u, force]).collect();
        object.insert("backbone".into(), serde_json::to_value(backbone)?);
        object.insert("capacity".into(), capacity.json());
        object.insert("warnings".into(), warnings.collect::<Vec<_>>().into());
        return console.json(&object.into());
    }
    let mut text = String::new();
    let width = facts.iter().map(|fact| fact.name.len()).max().unwrap_or_default() + 2;
    for (name, value) in words {
        let _ = writeln!(text, "{name:<width$}{value}");
    }
    text.push('\n');
    for Fact { name, symbol, value, unit } in facts {
        let _ = writeln!(text, "{name:<width$}{symbol:<10}{:>13} {unit}", significant(value, 6));
    }
    text.push('\n');
    text.push_str(&capacity.table().text());
    for warning in warnings {
        let _ = writeln!(text, "\nwarning: {warning}");
    }
    text += &output::written("\nwritten ", arguments.outputs());
    console.print(&text)
}

/// Says which part of a tie gives way first, and of several ties which side each holds.
fn ties(parameters: &Parameters) -> Vec<(String, String)> {
    let weaker = |tie: &TieNumbers| {
        tie.weaker_part(parameters.width).map(|part| match part {
            TiePart::Bar => "of its bar, which yields first",
            TiePart::Anchor => "of its anchor, which breaks before the bar yields",
        })
    };
    let ties: Vec<_> = parameters.ties().collect();
    if let [one] = &ties[..] {
        return weaker(one).map(|words| ("tie".to_owned(), words.to_owned())).into_iter().collect();
    }
    let words = |(tie, number): (&TieNumbers, usize)| {
        let side = std::iter::once(tie.side.name()).chain(weaker(tie)).collect::<Vec<_>>();
        (format!("tie_{number}_side"), side.join(", "))
    };
    ties.iter().zip(1..).map(words).collect()
}

/// Says where a formula of restitution that counts is far from the impulses of the impact.
fn disagreement(parameters: &Parameters, wall: &Wall) -> Option<String> {
    let counts = usage(parameters).any(|usage| usage.name == "restitution_source" && usage.matters);
    let (e, impulses) = (wall.restitution().positive, wall.body().impulses?.positive);
    let is_far = counts && wall.free_side().is_none() && (e - impulses).abs() > LARGEST_DIFFERENCE;
    is_far.then(|| {
        let source = parameters.restitution_source.name();
        format!(
            "restitution_source = {source} gives e = {e:.3}, the impulses of an impact {impulses:.3}; \
             docs/model.md says which of them tests support"
        )
    })
}

/// The solver in words.
pub(crate) fn method_name(method: &Method) -> &'static str {
    match method {
        Method::Exact => "exact",
        Method::Adaptive { .. } => "adaptive",
        Method::Newmark { .. } => "newmark",
    }
}
