//! The tables of a study, wall by wall, for CSV files and the Python package.
//!
//! ```
//! use study::tables::{COLLAPSES, FRAGILITIES, LEVELS, Names};
//!
//! let none = Names { walls: vec![], models: vec![], records: vec![], fractions: &[] };
//! let columns = [LEVELS, COLLAPSES, FRAGILITIES].map(|kind| kind.empty().columns.len());
//! assert_eq!(columns, [7, 8, 19]);
//! ```

use ground_motion::STANDARD_GRAVITY;
use report::table::{Cell, Column, Digits, Table};

use crate::fragility::Interval;
use crate::ida::Exceedance;
use crate::results::WallResults;

/// Names of the parts of a study, and its limit states.
#[derive(Clone, Debug)]
pub struct Names<'a> {
    /// Walls.
    pub walls: Vec<&'a str>,
    /// Damping models.
    pub models: Vec<&'a str>,
    /// Records.
    pub records: Vec<&'a str>,
    /// Limit states as fractions of `u_ins`.
    pub fractions: &'a [f64],
}

/// A kind of table, made wall by wall: thousands of walls need not be in memory at once.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Names of its columns, with their units, separated by commas.
    columns: &'static str,
    rows: fn(&mut Table, &Names<'_>, usize, &WallResults),
}

/// Columns that hold words.
const WORDS: [&str; 3] = ["wall", "model", "record"];

impl Kind {
    /// Returns the table without rows.
    pub fn empty(self) -> Table {
        Table::new(self.columns.split(',').map(|name| Column {
            is_text: WORDS.contains(&name),
            ..Column::number(name, "", Digits::AtMost(6))
        }))
    }

    /// Returns the rows of a wall, given its number and its results.
    pub fn of_wall(self, names: &Names<'_>, wall: usize, results: &WallResults) -> Table {
        let mut table = self.empty();
        (self.rows)(&mut table, names, wall, results);
        table
    }
}

/// Every run.
pub const LEVELS: Kind = Kind {
    name: "levels",
    columns: "wall,model,record,intensity_g,u_max_over_u_ins,overturned,overturn_time_s",
    rows: |table, names, wall, results| {
        for (index, curve) in results.all_curves().iter().enumerate() {
            for run in curve.runs() {
                let [wall, model, record] = names.of_curve(wall, index);
                table.row([
                    wall,
                    model,
                    record,
                    in_g(run.intensity).into(),
                    run.demand.into(),
                    run.overturning.is_some().into(),
                    run.overturning.into(),
                ]);
            }
        }
    },
};

/// The collapse with every model and record.
pub const COLLAPSES: Kind = Kind {
    name: "collapses",
    columns: "wall,model,record,collapse_g,standing_below_g,highest_level_g,runs,resurrections",
    rows: |table, names, wall, results| {
        for (index, curve) in results.all_curves().iter().enumerate() {
            let [wall, model, record] = names.of_curve(wall, index);
            let collapse = match curve.collapse() {
                Exceedance::At(intensity) => Some(in_g(intensity)),
                Exceedance::Above(_) => None,
            };
            table.row([
                wall,
                model,
                record,
                collapse.into(),
                in_g(curve.level_below_collapse()).into(),
                in_g(curve.top()).into(),
                curve.runs().len().into(),
                curve.resurrections().into(),
            ]);
        }
    },
};

/// The fragility of every model and limit state.
pub const FRAGILITIES: Kind = Kind {
    name: "fragilities",
    columns: "wall,model,u_max_over_u_ins,records,censored,median_g,median_low_g,median_high_g\
              ,theta_g,theta_low_g,theta_high_g,beta,beta_alone,median_ratio,median_ratio_low\
              ,median_ratio_high,theta_ratio,theta_ratio_low,theta_ratio_high",
    rows: |table, names, wall, results| {
        let interval = |interval: &Interval, unit: f64| interval.bounds(unit).map(Cell::Between);
        for (m, model) in names.models.iter().enumerate() {
            for (f, fraction) in names.fractions.iter().enumerate() {
                let summary = &results.summaries(f)[m];
                let mut cells = [names.walls[wall], model].map(|name| Cell::from(name.to_owned())).to_vec();
                cells.push(Cell::Number(*fraction));
                cells.extend([summary.records, summary.censored].map(Cell::Count));
                cells.extend(interval(&summary.median, STANDARD_GRAVITY));
                cells.extend(interval(&summary.theta, STANDARD_GRAVITY));
                let betas = [&summary.fitted, &summary.alone];
                cells.extend(betas.map(|fit| Cell::from(fit.as_ref().ok().map(|fit| fit.dispersion))));
                cells.extend(interval(&summary.median_ratio, 1.0));
                cells.extend(interval(&summary.theta_ratio, 1.0));
                table.row(cells);
            }
        }
    },
};

impl Names<'_> {
    /// Returns the first cells of a row: wall, model and record of one of the wall's curves.
    fn of_curve(&self, wall: usize, curve: usize) -> [Cell<'static>; 3] {
        let (model, record) = (curve / self.records.len(), curve % self.records.len());
        [self.walls[wall], self.models[model], self.records[record]].map(|name| name.to_owned().into())
    }
}

/// Returns an acceleration in g.
pub fn in_g(acceleration: f64) -> f64 {
    acceleration / STANDARD_GRAVITY
}
