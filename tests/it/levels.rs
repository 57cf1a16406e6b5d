//! Tests bodies that a level cuts out of a wall of parts.

use rocking_wall::wall::{Load, Opening, Part, Profile};

use crate::bodies::PRISM;

const LOWER: Part = Part { height: 2.7, thickness: [0.6; 2], ..PRISM };
const UPPER: Part = Part { base: 2.7, height: 2.6, thickness: [0.48; 2], outer: [0.1; 2], ..PRISM };

fn profile(parts: &[Part], openings: &[Opening], loads: &[Load]) -> Profile {
    Profile::new(parts.to_vec(), openings.to_vec(), loads.to_vec()).unwrap()
}

/// A tapered part is cut where it is as thick, wide and set back as at the level; what is above keeps its
/// mass and centroid.
#[test]
fn masonry_above_a_level_stays_as_it_is() {
    let tapered = Part { thickness: [0.5, 0.3], width: [4.0, 2.0], outer: [0.0, 0.1], ..PRISM };
    let window = Opening { base: 0.5, height: 1.5, width: 1.0, hollow: None };
    let whole = profile(&[tapered], &[window], &[]);
    for level in [0.4, 1.0, 1.9, 2.5] {
        let above = whole.above(level).unwrap();
        let (own, cut) = (whole.centroid([level, 3.0]), above.centroid([0.0, 3.0 - level]));
        let face = tapered.section(level).outer;
        let places = [(own.mass, cut.mass), (own.x - face, cut.x), (own.z - level, cut.z)];
        // rounding of the cut, of sizes near 1
        assert!(
            places.iter().all(|(own, cut)| (own - cut).abs() <= 1e-12 * own.abs().max(1.0)),
            "{places:?}"
        );
        assert!((above.height() - (3.0 - level)).abs() < 1e-15);
        assert_eq!(above.openings().len(), usize::from(level < 2.0));
    }
}

/// The end of a part is found but for rounding: 2.7 + 2.6 is not 5.3 in doubles.
#[test]
fn a_level_is_the_end_of_a_part_but_for_rounding() {
    let top = Part { base: UPPER.top(), height: 2.5, thickness: [0.36; 2], outer: [0.1; 2], ..PRISM };
    let above = profile(&[LOWER, UPPER, top], &[], &[]).above(5.3).unwrap();
    assert_ne!(UPPER.top(), 5.3);
    assert_eq!((above.parts().len(), above.height()), (1, 2.5));
    assert_eq!(above.base_thickness(), 0.36);
    assert!(above.is_rectangle());
}

/// A load at the level rests on what is below; those above keep their distance from it.
#[test]
fn loads_at_the_level_rest_below() {
    let loads = [1.0, 2.7 + 1e-10, 4.0].map(|height| Load::resting(1e3, height, 0.3));
    let above = profile(&[LOWER, UPPER], &[], &loads).above(2.7).unwrap();
    let [load] = above.loads() else { panic!("{:?}", above.loads()) };
    assert!((load.height - 1.3).abs() < 1e-15 && (load.inside - 0.2).abs() < 1e-15);
}

/// The toes are the edges of the contact: a body that overhangs bears on what is below.
#[test]
fn a_body_bears_where_both_sections_reach() {
    let wide = Part { base: 2.7, height: 1.0, thickness: [0.9; 2], outer: [-0.2; 2], ..PRISM };
    let above = profile(&[LOWER, wide], &[], &[]).above(2.7).unwrap();
    let [outer, inner] = above.toes();
    assert!((outer - 0.2).abs() < 1e-15 && (inner - 0.8).abs() < 1e-15);
    assert!(!above.is_rectangle() && (above.base_thickness() - 0.6).abs() < 1e-15);
}

#[test]
fn levels_that_cut_nothing_out_are_refused() {
    let wedge = Part { thickness: [0.0, 1.2], outer: [0.6; 2], width: [0.5; 2], ..LOWER };
    let held = profile(&[LOWER, wedge], &[], &[]);
    assert_eq!(held.hanging(), [1]);
    assert!(profile(&[LOWER, UPPER], &[], &[]).hanging().is_empty());
    for (level, message) in [
        (-1.0, "nothing turns above the level -1 m; levels are from 0 to below the top, 2.7 m"),
        (2.7, "nothing turns above the level 2.7 m"),
        (f64::NAN, "nothing turns above the level NaN m"),
        (1.0, "part 2: the level 1 m goes through it, and it hangs on the side of another part from 0 m on"),
    ] {
        let error = held.above(level).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
    assert_eq!(held.above(0.0).unwrap(), held);
}
