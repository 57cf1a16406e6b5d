//! The section of a page about the classes of walls: the dispersion of each limit state by its parts, and the
//! curves of the highest one.

use std::fmt::Write as _;

use crate::fragility::{CONFIDENCE, FragilityFunction, Lognormal};
use crate::tables::OF_INTENSITY;
use report::many_lines::ManyLines;
use report::table::{Cell, Column, Digits, Table};
use report::{counted, escaped};

use super::contents::Manifest;
use super::legend::looks;
use super::plots::{POINTS, SIZE};
use super::risk::Known;

/// The classes of a study.
pub(crate) struct Classes<'a> {
    manifest: &'a Manifest,
    /// Limit states: their places in the report, and their names.
    states: &'a [(usize, String)],
    table: Table,
    plots: String,
    /// Curves of the highest limit state of a class: the place of the model, θ in the unit of
    /// results, and β.
    curves: Vec<(usize, [f64; 2])>,
}

impl<'a> Classes<'a> {
    pub(crate) fn new(manifest: &'a Manifest, states: &'a [(usize, String)]) -> Self {
        let table = Table::new([
            Column::text("", "class"),
            Column::text("", "model"),
            Column::number("", "u_max/u_ins", Digits::AtMost(6)),
            Column::number("", format!("θ\n[{}]", manifest.contents.unit.name()), OF_INTENSITY),
            Column::number("", "interval", OF_INTENSITY),
            Column::number("", "β", OF_INTENSITY),
            Column::number("", "interval", OF_INTENSITY),
            Column::number("", "β of\nrecords", OF_INTENSITY),
            Column::number("", "β of\nwalls", OF_INTENSITY),
            Column::number("", "β of\nmodelling", OF_INTENSITY),
        ]);
        Self { manifest, states, table, plots: String::new(), curves: Vec::new() }
    }

    /// Adds a class of some walls with one model.
    pub(crate) fn add(
        &mut self,
        (name, walls): (&str, usize),
        model: usize,
        function: Option<&FragilityFunction>,
        known: &[Known],
    ) {
        let Manifest { contents, report, .. } = self.manifest;
        let unit = contents.unit;
        let interval = |ends: [String; 2]| -> Cell<'static> { ends.join(" … ").into() };
        for (k, (place, _)) in self.states.iter().enumerate() {
            let [_, low, high] = known[k].theta.texts(unit.size(), OF_INTENSITY);
            let [_, beta_low, beta_high] = known[k].beta.texts(1.0, OF_INTENSITY);
            let curve = function.map(|function| function.states[k]);
            self.table.row([
                name.to_owned().into(),
                contents.models[model].name.clone().into(),
                report.fractions[*place].into(),
                curve.map(|curve| unit.of(curve.median)).into(),
                interval([low, high]),
                function.map(|function| function.dispersion(k)).into(),
                interval([beta_low, beta_high]),
                curve.map(|curve| curve.beta_records).into(),
                curve.map(|curve| curve.beta_walls).into(),
                function.map(|function| function.beta_modelling).into(),
            ]);
        }
        let last = self.states.len() - 1;
        self.curves.extend(
            function
                .map(|function| (model, [unit.of(function.states[last].median), function.dispersion(last)])),
        );
        if model + 1 == contents.models.len() {
            self.draw(name, walls);
        }
    }

    /// Draws the curves of a class.
    fn draw(&mut self, name: &str, walls: usize) {
        let curves = std::mem::take(&mut self.curves);
        let end = curves.iter().map(|(_, [theta, beta])| theta * libm::exp(2.5 * beta)).fold(0.0, f64::max);
        if curves.is_empty() {
            return;
        }
        let mut plot = ManyLines::new(SIZE, [0.0, end], [0.0, 1.0]);
        let looks = looks(self.manifest);
        for (model, [median, dispersion]) in curves {
            let curve = Lognormal { median, dispersion };
            let at = |k: u32| end * f64::from(k) / f64::from(POINTS);
            let line: Vec<_> = (1..=POINTS).map(|k| [at(k), curve.probability(at(k))]).collect();
            plot.line(&line, "fit", looks[model].0);
        }
        let axis = self.manifest.contents.axis();
        let svg = plot.svg([&axis, "probability"]);
        // writing to a String cannot fail
        let _ = write!(
            self.plots,
            "<figure><figcaption>{}, {}</figcaption>{svg}</figure>",
            escaped(name),
            counted(walls, "wall")
        );
    }

    /// Returns the section; empty without classes.
    pub(crate) fn section(&self) -> String {
        if self.table.rows.is_empty() {
            return String::new();
        }
        let Self { states, manifest, .. } = self;
        let highest = manifest.report.fractions[states[states.len() - 1].0];
        let words = "β² is the sum of the squares of its parts; intervals are those of the records";
        format!(
            "<section><h2>Classes of walls</h2><p class=\"subtitle\">{words}, {:.0} %.</p><div \
             class=\"scroll\">{}</div><h3>P(u<sub>max</sub>/u<sub>ins</sub> &gt; {highest})</h3><div \
             class=\"row\">{}</div></section>\n",
            100.0 * CONFIDENCE,
            self.table.html(),
            self.plots
        )
    }
}
