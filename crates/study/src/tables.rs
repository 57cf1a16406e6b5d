//! The tables of a study, row by row, for CSV files and the Python package.
//!
//! ```
//! use study::tables::{COLLAPSES, FRAGILITIES, LEVELS};
//!
//! assert_eq!([LEVELS, COLLAPSES, FRAGILITIES].map(|table| table.columns.split(',').count()), [7, 8, 19]);
//! ```

use ground_motion::STANDARD_GRAVITY;
use report::table::Cell;

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

/// A table.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// Its name.
    pub name: &'static str,
    /// Names of its columns, with their units, separated by commas.
    pub columns: &'static str,
    /// Makes the rows of a wall, given its number and its results, one after the other.
    pub rows: for<'a> fn(&Names<'a>, usize, &WallResults, Row<'_, 'a>),
}

/// Takes a row.
pub type Row<'r, 'a> = &'r mut dyn FnMut(&[Cell<'a>]);

/// Every run.
pub const LEVELS: Table = Table {
    name: "levels",
    columns: "wall,model,record,intensity_g,u_max_over_u_ins,overturned,overturn_time_s",
    rows: |names, wall, results, row| {
        for (index, curve) in results.all_curves().iter().enumerate() {
            let [wall, model, record] = names.of_curve(wall, index);
            for run in curve.runs() {
                let (intensity, demand) = (Cell::Number(in_g(run.intensity)), Cell::Number(run.demand));
                let overturned = Cell::Flag(run.overturning.is_some());
                let [wall, model, record] = [&wall, &model, &record].map(Clone::clone);
                row(&[wall, model, record, intensity, demand, overturned, run.overturning.into()]);
            }
        }
    },
};

/// The collapse with every model and record.
pub const COLLAPSES: Table = Table {
    name: "collapses",
    columns: "wall,model,record,collapse_g,standing_below_g,highest_level_g,runs,resurrections",
    rows: |names, wall, results, row| {
        for (index, curve) in results.all_curves().iter().enumerate() {
            let [wall, model, record] = names.of_curve(wall, index);
            let collapse = match curve.collapse() {
                Exceedance::At(intensity) => Some(in_g(intensity)),
                Exceedance::Above(_) => None,
            };
            let [below, top] = [curve.level_below_collapse(), curve.top()].map(|level| Some(in_g(level)));
            let [collapse, below, top] = [collapse, below, top].map(Cell::from);
            let [runs, resurrections] = [curve.runs().len(), curve.resurrections()].map(Cell::Count);
            row(&[wall, model, record, collapse, below, top, runs, resurrections]);
        }
    },
};

/// The fragility of every model and limit state.
pub const FRAGILITIES: Table = Table {
    name: "fragilities",
    columns: "wall,model,u_max_over_u_ins,records,censored,median_g,median_low_g,median_high_g,\
              theta_g,theta_low_g,theta_high_g,beta,beta_alone,median_ratio,median_ratio_low,\
              median_ratio_high,theta_ratio,theta_ratio_low,theta_ratio_high",
    rows: |names, wall, results, row| {
        let interval = |interval: &Interval, unit: f64| interval.bounds(unit).map(Cell::Between);
        for (m, model) in names.models.iter().enumerate() {
            for (f, fraction) in names.fractions.iter().enumerate() {
                let summary = &results.summaries(f)[m];
                let mut cells = vec![Cell::from(names.walls[wall]), Cell::from(*model)];
                cells.push(Cell::Number(*fraction));
                cells.extend([summary.records, summary.censored].map(Cell::Count));
                cells.extend(interval(&summary.median, STANDARD_GRAVITY));
                cells.extend(interval(&summary.theta, STANDARD_GRAVITY));
                let betas = [&summary.fitted, &summary.alone];
                cells.extend(betas.map(|fit| Cell::from(fit.as_ref().ok().map(|fit| fit.dispersion))));
                cells.extend(interval(&summary.median_ratio, 1.0));
                cells.extend(interval(&summary.theta_ratio, 1.0));
                row(&cells);
            }
        }
    },
};

impl<'a> Names<'a> {
    /// Returns the first cells of a row: wall, model and record of one of the wall's curves.
    fn of_curve(&self, wall: usize, curve: usize) -> [Cell<'a>; 3] {
        let (model, record) = (curve / self.records.len(), curve % self.records.len());
        [self.walls[wall], self.models[model], self.records[record]].map(Cell::from)
    }
}

/// Returns an acceleration in g.
pub fn in_g(acceleration: f64) -> f64 {
    acceleration / STANDARD_GRAVITY
}
