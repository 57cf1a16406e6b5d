//! The hinge of a strip, searched; and the angle of a crack alike.
//!
//! ζ(x) of a check, its `ζ_E` with the hinge at x h, has several minima, corners where periods meet those of
//! the spectrum, and jumps where the thickness has a step or a load rests. Equal points find the valleys,
//! with both sides of each jump among them; a golden section goes down each.

use rocking_wall::wall::Parameters;

use super::level::loads;

/// How finely a range is searched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search {
    /// Equal points of the range.
    points: u32,
    /// Where a golden section ends \[-\].
    width: f64,
}

impl Search {
    /// Whether it is that of a check.
    pub(crate) fn is_fine(self) -> bool {
        self.points == FINE.points
    }
}

/// The search of a check.
pub(crate) const FINE: Search = Search { points: 401, width: 1e-10 };
/// The search of what only informs: ζ to some 1e-6.
pub(crate) const COARSE: Search = Search { points: 101, width: 1e-7 };
/// Valleys are followed whose lowest point is within this share of the lowest of all \[-\].
const NEAR: f64 = 0.05;
/// Values that are equal \[-\]: of these the smallest x is taken.
const EQUAL: f64 = 1e-9;
/// How far from a jump its sides are looked at, of h: nearer than 1e-9 h is at the end of a part \[-\].
const BESIDE: f64 = 4e-9;
/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Where ζ(x) of a strip may jump: at the ends of its parts and at its loads, of h \[-\].
pub(crate) fn jumps(parameters: &Parameters) -> Vec<f64> {
    let Some(profile) = &parameters.profile else { return Vec::new() };
    let ends = profile.parts().iter().flat_map(|part| [part.base, part.top()]);
    let heights = ends.chain(loads(parameters).iter().map(|load| load.height));
    heights.map(|height| height / profile.height()).collect()
}

/// Returns the x of a range at which each of some functions is least; infinite ones are left out. Of jumps,
/// which are known, the function counts at the jump and on both sides; of others the lower side. `values`
/// takes an x and which function is asked for, `None` for all; what it gives for the others has no part.
///
/// # Errors
/// That of the functions.
pub(crate) fn least<const N: usize, E>(
    Search { points: count, width }: Search,
    [from, to]: [f64; 2],
    jumps: &[f64],
    mut values: impl FnMut(f64, Option<usize>) -> Result<[f64; N], E>,
) -> Result<[Option<f64>; N], E> {
    let equal = (0..count).map(|index| from + (to - from) * (f64::from(index) / f64::from(count - 1)));
    let sides = jumps.iter().flat_map(|x| [x - BESIDE, *x, x + BESIDE]);
    let mut places: Vec<f64> = equal.chain(sides.filter(|x| (from..=to).contains(x))).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let points = places.into_iter().map(|x| Ok((x, values(x, None)?)));
    let points = points.collect::<Result<Vec<_>, E>>()?;
    let mut found = [None; N];
    for (which, found) in found.iter_mut().enumerate() {
        let lowest = points.iter().map(|(_, values)| values[which]).fold(f64::INFINITY, f64::min);
        if lowest == f64::INFINITY {
            continue;
        }
        let at = |index: usize| points[index].1[which];
        let last = points.len() - 1;
        let mut best: Option<(f64, f64)> = None;
        for index in 0..=last {
            let is_valley = (index == 0 || at(index) < at(index - 1))
                && (index == last || at(index) <= at(index + 1))
                && at(index) <= lowest * (1.0 + NEAR);
            if !is_valley {
                continue;
            }
            let ends = [points[index.saturating_sub(1)].0, points[last.min(index + 1)].0];
            let start = points[index].0;
            let (x, value) = valley(width, ends, start, at(index), |x| Ok(values(x, Some(which))?[which]))?;
            if best.is_none_or(|(_, least)| value < least * (1.0 - EQUAL)) {
                best = Some((x, value));
            }
        }
        *found = best.map(|(x, _)| x);
    }
    Ok(found)
}

/// Goes down a valley from its lowest point that is known: returns the lowest that was looked at.
fn valley<E>(
    width: f64,
    [mut left, mut right]: [f64; 2],
    start: f64,
    lowest: f64,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(f64, f64), E> {
    let mut best = (start, lowest);
    let mut look = |x: f64| {
        let value = value(x)?;
        if value < best.1 {
            best = (x, value);
        }
        Ok(value)
    };
    let place = |left: f64, right: f64, share: f64| left + share * (right - left);
    let mut inner = [1.0 - GOLDEN, GOLDEN].map(|share| place(left, right, share));
    let mut values = [look(inner[0])?, look(inner[1])?];
    while right - left > width {
        if values[0] <= values[1] {
            (right, inner[1], values[1]) = (inner[1], inner[0], values[0]);
            inner[0] = place(left, right, 1.0 - GOLDEN);
            values[0] = look(inner[0])?;
        } else {
            (left, inner[0], values[0]) = (inner[0], inner[1], values[1]);
            inner[1] = place(left, right, GOLDEN);
            values[1] = look(inner[1])?;
        }
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth valley, a corner, the lower side of a jump, an end, and nothing.
    #[test]
    fn valleys_corners_jumps_and_ends() {
        let functions = |x: f64, _: Option<usize>| {
            Ok::<_, ()>([
                1.0 + (x - 0.3456).powi(2),
                1.0 + (x - 0.5432).abs(),
                if x < 0.617_2 { 2.0 - x } else { 2.0 + x },
                3.0 - x,
                f64::INFINITY,
            ])
        };
        let found = least(FINE, [0.1, 0.9], &[], functions).unwrap();
        // a smooth valley is flat within √(2 ε) of its bottom
        for (found, expected, tolerance) in [
            (found[0], 0.3456, 1e-7),
            (found[1], 0.5432, 1e-10),
            (found[2], 0.6172, 1e-10),
            (found[3], 0.9, 1e-10),
        ] {
            let found = found.unwrap();
            assert!((found - expected).abs() <= tolerance, "{found} for {expected}");
        }
        assert!(found[4].is_none() && found[2].unwrap() < 0.6172);
        // of equal valleys the first
        let twice = least(FINE, [0.1, 0.9], &[], |x: f64, _| Ok::<_, ()>([2.0 + (25.0 * x).cos()])).unwrap();
        let twice = twice[0].unwrap();
        assert!((twice - std::f64::consts::PI / 25.0).abs() < 1e-7, "{twice}");
    }
}
