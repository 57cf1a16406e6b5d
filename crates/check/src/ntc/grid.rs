//! The hazard of a site from a grid that the user brings, such as that of the ministry: `a_g`, F0 and `T_C`*
//! at nodes, for several return periods.
//!
//! Between return periods the logarithms of a number are straight over those of the periods, and between the
//! four nodes around the site it is their mean by the inverse of the distances. So NTC 2008, Annex A, is
//! remembered in the field; its text was not seen.

use std::borrow::Cow;

use ground_motion::columns::{Columns, Fault, Name, Numbers};
use serde::Deserialize;

use super::ground::{G, Hazard};

/// Largest `a_g` of a grid; more is in another unit \[g\].
const MOST: f64 = 1.5;
/// A node that completes a cell is at most so far from where the others would have it, in sides of the cell.
const CROOKED: f64 = 0.3;

/// A grid.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Return periods, rising \[years\].
    periods: Vec<f64>,
    nodes: Vec<Node>,
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    /// Longitude and latitude \[°\].
    place: [f64; 2],
    /// The hazard for each return period.
    hazards: Vec<Hazard>,
}

/// The hazard of a site for any return period.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SiteHazard {
    periods: Vec<f64>,
    /// Nodes around the site, with their shares of the sum 1.
    nodes: Vec<Near>,
}

/// A node near a site.
#[derive(Clone, Debug, PartialEq)]
struct Near {
    /// Its share of the sum 1 \[-\].
    share: f64,
    node: Node,
}

/// What is wrong with the text of a grid: the line from 1, and the words.
pub(crate) type GridFault = (usize, String);

impl Grid {
    /// Reads a grid from a table with columns `lon` and `lat` in degrees and, for each return period T in
    /// years, `ag_T`, `F0_T` and `TC_T`, or as the ministry has them, `Fo` and `TC*`, and T in a line above.
    /// `unit` is that of `a_g` \[g\]. Other columns are passed over.
    ///
    /// # Errors
    /// The line and what is wrong with it: a column that is missing, a number that cannot be, two nodes in
    /// one place, `a_g` in another unit.
    pub(crate) fn read(text: &str, unit: f64) -> Result<Self, GridFault> {
        let fault = |fault: Fault| (fault.line(), fault.to_string());
        let forms = "a grid: a line of names (lon, lat, ag_30, F0_30, TC_30, …), and a row for each node";
        let text = with_periods(text.trim_start_matches('\u{feff}'));
        let columns = Columns::of_texts(&text, forms).map_err(fault)?;
        let head = columns.line();
        let plain = |name: &Name| {
            let name = name.written().replace('*', "").to_lowercase().replace("fo", "f0");
            // ag30 is ag_30
            let is_period = |of: &&str| name.strip_prefix(*of).is_some_and(|t| t.parse::<f64>().is_ok());
            match ["ag", "f0", "tc"].into_iter().find(is_period) {
                Some(of) => format!("{of}_{}", &name[of.len()..]),
                None => name,
            }
        };
        let names: Vec<String> = columns.names().iter().map(plain).collect();
        let column = |names_of: &[&str]| {
            let found = names.iter().position(|name| names_of.contains(&name.as_str()));
            found.ok_or_else(|| (head, format!("the grid has no column {:?}; it needs {forms}", names_of[0])))
        };
        let place = [column(&["lon", "longitude"])?, column(&["lat", "latitude"])?];
        let written = periods(&names).map_err(|message| (head, message))?;
        let of_period = |(_, period): &(f64, &str)| {
            let [ag, f0, tc] = ["ag", "f0", "tc"].map(|name| format!("{name}_{period}"));
            Ok::<_, GridFault>([column(&[&ag])?, column(&[&f0])?, column(&[&tc])?])
        };
        let places = written.iter().map(of_period).collect::<Result<Vec<_>, _>>()?;
        let periods = written.into_iter().map(|(period, _)| period).collect();
        let (mut nodes, mut numbers) = (Vec::<Node>::new(), Numbers::new(&columns));
        let mut seen = std::collections::BTreeSet::new();
        for row in columns.rows() {
            let row = row.map_err(fault)?;
            let cells: Vec<_> = row.cells().collect();
            let mut number = |column: usize| {
                numbers.real(cells.get(column).map_or("", |cell| cell), row.line).map_err(fault)
            };
            let place = [number(place[0])?, number(place[1])?];
            let hazards = places
                .iter()
                .map(|&[ag, f0, tc]| Ok(Hazard { ag: unit * number(ag)?, f0: number(f0)?, tc: number(tc)? }));
            let hazards = hazards.collect::<Result<Vec<_>, GridFault>>()?;
            check(&hazards).map_err(|message| (row.line, message))?;
            if !seen.insert(place.map(f64::to_bits)) {
                let [lon, lat] = place;
                return Err((row.line, format!("a second node at lon {lon}, lat {lat}; delete one")));
            }
            nodes.push(Node { place, hazards });
        }
        Ok(Self { periods, nodes })
    }

    /// Finds the hazard of a site, by its latitude and longitude \[°\].
    ///
    /// # Errors
    /// The reason: no cell of the grid has the site in it.
    pub(crate) fn at(&self, [latitude, longitude]: [f64; 2]) -> Result<SiteHazard, String> {
        // degrees of latitude, from the site on
        let shrink = libm::cos(latitude.to_radians());
        let away = |node: &Node| [(node.place[0] - longitude) * shrink, node.place[1] - latitude];
        let plane: Vec<[f64; 2]> = self.nodes.iter().map(away).collect();
        let square = |[x, y]: [f64; 2]| x * x + y * y;
        let nearest = |at: [f64; 2]| {
            (0..plane.len())
                .min_by(|&a, &b| square(less(plane[a], at)).total_cmp(&square(less(plane[b], at))))
        };
        let outside = |near: Option<usize>| {
            let near = near.map_or_else(String::new, |near| {
                let [lon, lat] = self.nodes[near].place;
                format!("; the nearest node is at lon {lon}, lat {lat}")
            });
            format!(
                "the site at lat {latitude}, lon {longitude} is in no cell of the grid{near}; give ag, F0 \
                 and TC of each limit state"
            )
        };
        let corner = nearest([0.0; 2]).ok_or_else(|| outside(None))?;
        if square(plane[corner]) == 0.0 {
            return Ok(SiteHazard { periods: self.periods.clone(), nodes: vec![self.share(1.0, corner)] });
        }
        // of the nearest node the next ones to the east, north, west and south
        let next = |[ex, ey]: [f64; 2]| {
            let along = |&k: &usize| {
                let [x, y] = less(plane[k], plane[corner]);
                x * ex + y * ey > (x * ey - y * ex).abs()
            };
            let far = |k: usize| square(less(plane[k], plane[corner]));
            (0..plane.len()).filter(along).min_by(|&a, &b| far(a).total_cmp(&far(b)))
        };
        let around = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(next);
        for k in 0..4 {
            let (Some(a), Some(b)) = (around[k], around[(k + 1) % 4]) else { continue };
            let sides = [a, b].map(|next| less(plane[next], plane[corner]));
            let fourth = [0, 1].map(|axis| plane[corner][axis] + sides[0][axis] + sides[1][axis]);
            let Some(opposite) = nearest(fourth) else { continue };
            let side = sides.map(square).into_iter().fold(f64::INFINITY, f64::min);
            let is_cell = square(less(plane[opposite], fourth)) <= CROOKED * CROOKED * side;
            let cell = [corner, a, opposite, b];
            if is_cell && surrounds(cell.map(|node| plane[node])) {
                let shares = cell.map(|node| 1.0 / libm::sqrt(square(plane[node])));
                let sum: f64 = shares.iter().sum();
                let nodes = cell.iter().zip(shares).map(|(&node, share)| self.share(share / sum, node));
                return Ok(SiteHazard { periods: self.periods.clone(), nodes: nodes.collect() });
            }
        }
        Err(outside(Some(corner)))
    }

    fn share(&self, share: f64, node: usize) -> Near {
        Near { share, node: self.nodes[node].clone() }
    }
}

impl SiteHazard {
    /// Returns the hazard for a return period \[years\]; outside the periods of the grid that of the nearest
    /// one.
    pub(crate) fn hazard(&self, period: f64) -> Hazard {
        let last = self.periods.len() - 1;
        let period = period.clamp(self.periods[0], self.periods[last]);
        let after = self.periods.partition_point(|of_grid| *of_grid < period).clamp(1, last);
        let [from, to] = [self.periods[after - 1], self.periods[after]];
        let part = libm::log(period / from) / libm::log(to / from);
        let mean = |of: fn(&Hazard) -> f64| {
            let at = |hazards: &[Hazard]| {
                let [low, high] = [of(&hazards[after - 1]), of(&hazards[after])];
                low * libm::pow(high / low, part)
            };
            self.nodes.iter().map(|near| near.share * at(&near.node.hazards)).sum()
        };
        Hazard { ag: mean(|one| one.ag), f0: mean(|one| one.f0), tc: mean(|one| one.tc) }
    }

    /// The nodes: longitude and latitude \[°\], share \[-\], and the hazard of each alone.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = ([f64; 2], f64, Self)> {
        self.nodes.iter().map(|near| {
            let alone = Near { share: 1.0, node: near.node.clone() };
            (near.node.place, near.share, Self { periods: self.periods.clone(), nodes: vec![alone] })
        })
    }

    /// Whether the site is a node.
    pub(crate) fn is_node(&self) -> bool {
        self.nodes.len() == 1
    }

    /// Returns the first and the last return period of the grid \[years\].
    pub(crate) fn periods(&self) -> [f64; 2] {
        [self.periods[0], self.periods[self.periods.len() - 1]]
    }
}

/// Puts return periods that stand above the names, `TR = 30` above `ag`, behind these: `ag_30`.
fn with_periods(text: &str) -> Cow<'_, str> {
    let mut lines = text.split_inclusive('\n').skip_while(|line| line.trim().is_empty());
    let (Some(above), Some(names)) = (lines.next(), lines.next()) else { return text.into() };
    let separator = [';', '\t', ','].into_iter().find(|mark| above.contains(*mark)).unwrap_or(';');
    let period = |cell: &str| {
        let is_period = cell.trim_matches([' ', '"']).to_lowercase().starts_with("tr");
        is_period.then(|| cell.chars().filter(char::is_ascii_digit).collect::<String>())
    };
    let mut periods = above.trim_end().split(separator).map(period);
    if periods.clone().flatten().all(|digits| digits.is_empty()) {
        return text.into();
    }
    let mut last = String::new();
    let of_name = |name: &str| {
        last = periods.next().flatten().unwrap_or(std::mem::take(&mut last));
        let name = name.trim_matches([' ', '"']);
        if last.is_empty() { name.to_owned() } else { format!("{name}_{last}") }
    };
    let joined: Vec<_> = names.trim_end().split(separator).map(of_name).collect();
    // every line keeps its number
    text.replacen(above, "\n", 1)
        .replacen(names, &format!("{}\n", joined.join(&separator.to_string())), 1)
        .into()
}

/// Finds the return periods of the columns `ag_T`, rising, and as they are written \[years\].
///
/// # Errors
/// The reason: fewer than two periods, or a period that is given twice, such as by `ag_30` and `ag_030`.
fn periods(names: &[String]) -> Result<Vec<(f64, &str)>, String> {
    let written = names.iter().filter_map(|name| name.strip_prefix("ag_"));
    let period =
        |written: &str| written.parse().ok().filter(|period: &f64| *period > 0.0 && period.is_finite());
    let no_period = |written: &str| format!("column ag_{written}: {written:?} is no return period in years");
    let mut periods = written
        .map(|written| Ok((period(written).ok_or_else(|| no_period(written))?, written)))
        .collect::<Result<Vec<_>, String>>()?;
    periods.sort_by(|a, b| a.0.total_cmp(&b.0));
    if let Some(same) = periods.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        let (a, b) = (same[0].1, same[1].1);
        return Err(format!("columns ag_{a} and ag_{b} have the same return period; delete one"));
    }
    if periods.len() < 2 {
        let message = "the grid needs columns of a_g, F0 and T_C* for two return periods in years or more: \
                       ag_30, F0_30, TC_30, ag_50, …, or ag, Fo, TC* below a line with TR = 30, TR = 50, …";
        return Err(message.into());
    }
    Ok(periods)
}

/// Says what of the hazard of a node cannot be.
fn check(hazards: &[Hazard]) -> Result<(), String> {
    for Hazard { ag, f0, tc } in hazards {
        if !(*ag > 0.0 && *f0 > 0.0 && *tc > 0.0) {
            return Err(format!("a_g = {ag} g, F0 = {f0} and T_C* = {tc} s must be above 0"));
        }
        if *ag > MOST {
            return Err(format!(
                "a_g = {ag} g is above {MOST} g; state the unit of the grid: ag_unit = \"g/10\" or \"m/s2\""
            ));
        }
    }
    Ok(())
}

/// Unit of the `a_g` of a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[allow(missing_docs, reason = "the names say it")]
pub enum GridUnit {
    #[default]
    #[serde(rename = "g")]
    G,
    #[serde(rename = "g/10")]
    TenthOfG,
    #[serde(rename = "m/s2")]
    MetresPerSecondSquared,
}

impl GridUnit {
    /// Returns the unit \[g\].
    pub(crate) fn in_g(self) -> f64 {
        match self {
            Self::G => 1.0,
            Self::TenthOfG => 0.1,
            Self::MetresPerSecondSquared => 1.0 / G,
        }
    }
}

fn less(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Whether the origin is in a convex quadrangle, or on its edge, whose corners go round it once to the left.
fn surrounds(corners: [[f64; 2]; 4]) -> bool {
    let turn = |k: usize| {
        let [a, b] = [corners[k], corners[(k + 1) % 4]];
        a[0] * b[1] - a[1] * b[0]
    };
    (0..4).all(|k| turn(k) >= 0.0)
}

#[cfg(test)]
mod tests;
