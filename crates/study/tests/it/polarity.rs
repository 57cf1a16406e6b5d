//! Records with both signs: which runs they are, and how they are kept and drawn.

use fragility::Bootstrap;
use ground_motion::SyntheticMotion;
use rocking_wall::variables::{Impact, Rocking};
use rocking_wall::wall::Parameters;
use run::model::{EnergyLoss, Model};
use run::records::NamedRecord;
use run::walls::NamedWall;
use study::codes::NoCodes;
use study::document::StudyFile;
use study::folder::Contents;
use study::ida::{Curve, Exceedance, IntensityMeasure, Levels, Polarity, Run, Study};
use study::loaded::LoadedStudy;

use crate::estimators::medians;

fn records(count: u64) -> Vec<NamedRecord> {
    let record = |seed| {
        NamedRecord::new(
            format!("seed {seed}"),
            SyntheticMotion { seed, duration: 12.0, step: 0.01, peak: 3.0 }.motion().unwrap(),
        )
    };
    (1..=count).map(record).collect()
}

/// A wall that rocks to one side, and one that is alike on both.
fn walls() -> Vec<NamedWall> {
    let wall = Parameters { height: 3.0, thickness: 0.3, ..Parameters::default() };
    let (impact, restitution) = (Impact::Restitution, 0.6);
    let one_sided = Parameters { rocking: Rocking::OneSidedPositive, impact, restitution, ..wall.clone() };
    vec![NamedWall::new("one-sided", one_sided), NamedWall::new("two-sided", wall)]
}

fn curves(polarity: Polarity, levels: &Levels) -> Vec<Curve> {
    let models = vec![Model::new(EnergyLoss::Restitution)];
    let study = Study::new(walls(), records(4), models, IntensityMeasure::Pga, levels.clone()).unwrap();
    study.with_polarity(polarity).run(2).unwrap()
}

const HUNT: Levels = Levels::HuntAndFill { first: 1.0, increase: 0.5, top: 60.0, resolution: 0.01, gap: 0.5 };

/// The curves of both signs are those of the signs alone; at each level the worse of them is the worst.
#[test]
fn both_and_worst_are_made_of_the_two_signs() {
    let grid = Levels::Grid((1..=16).map(f64::from).collect());
    let [plain, reversed, both, worst] =
        [Polarity::AsRecorded, Polarity::Reversed, Polarity::Both, Polarity::Worst]
            .map(|polarity| curves(polarity, &grid));
    let pairs: Vec<Curve> = plain.iter().zip(&reversed).flat_map(|(a, b)| [a.clone(), b.clone()]).collect();
    assert_eq!(both, pairs);
    let mut differing = 0;
    for ((one, other), worst) in plain.iter().zip(&reversed).zip(&worst) {
        for ((one, other), worst) in one.runs().iter().zip(other.runs()).zip(worst.runs()) {
            let over = |run: &Run| (run.overturning.is_some(), run.demand);
            let larger = if over(one) < over(other) { over(other) } else { over(one) };
            assert_eq!(over(worst), larger);
            differing += usize::from(over(one) != over(other));
        }
    }
    // those of the one-sided wall
    assert!(differing > 12, "{differing} of 64");
    // the wall that is alike on both sides
    assert_eq!((&plain[4..], &plain[4..]), (&reversed[4..], &worst[4..]));
}

/// The worst sign of a hunt overturns at the lower of the two intensities, to the widths of the brackets.
#[test]
fn the_worst_sign_collapses_first() {
    let [plain, reversed, worst] =
        [Polarity::AsRecorded, Polarity::Reversed, Polarity::Worst].map(|polarity| curves(polarity, &HUNT));
    let at = |curve: &Curve| match curve.collapse() {
        Exceedance::At(intensity) => intensity,
        other => panic!("{other:?}"),
    };
    for ((one, other), worst) in plain.iter().zip(&reversed).zip(&worst) {
        let lower = at(one).min(at(other));
        // a level that only the search of the worst has may overturn below
        assert!(at(worst) <= 1.01 * lower, "{} and {lower}", at(worst));
    }
    assert!((at(&plain[0]) / at(&reversed[0]) - 1.0).abs() > 0.02, "the sides differ");
}

/// A study that is sent has its records once, and is the same study.
#[test]
fn a_study_that_is_sent_keeps_its_signs() {
    for (word, polarity) in [
        ("as_recorded", Polarity::AsRecorded),
        ("reversed", Polarity::Reversed),
        ("both", Polarity::Both),
        ("worst", Polarity::Worst),
    ] {
        let text = format!(
            "models = [\"CR\"]\npolarity = \"{word}\"\n\
             levels = {{ method = \"step\", step = 0.4, top = 2 }}\n"
        );
        let loaded = LoadedStudy::of_parts(text, walls(), records(3), &NoCodes).unwrap();
        assert_eq!((loaded.study.polarity(), polarity.name()), (polarity, word));
        assert_eq!(loaded.study.given_records(), records(3), "{word}");
        let sent = loaded.sent(&NoCodes);
        assert_eq!(sent.records.len(), 3);
        let received = LoadedStudy::received(sent, &NoCodes).unwrap();
        assert!(Contents::of(&received.study) == Contents::of(&loaded.study));
        let names: Vec<_> = loaded.study.records().iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names.contains(&"seed 2"), polarity != Polarity::Reversed);
        let has_reversed = matches!(polarity, Polarity::Reversed | Polarity::Both);
        assert_eq!(names.contains(&"seed 2 (reversed)"), has_reversed);
    }
    let text =
        "models = [\"CR\"]\npolarity = \"negative\"\nlevels = { method = \"step\", step = 1, top = 2 }\n";
    let told = StudyFile::parse("study.toml", text, &NoCodes).unwrap_err().to_string();
    assert!(
        told.contains("line 2") && told.contains("\"as_recorded\", \"reversed\", \"both\", \"worst\""),
        "{told}"
    );
}

/// A resample has both signs of a record or none: 2 n records in pairs of equal values have the medians of n.
#[test]
fn pairs_are_drawn_together() {
    let values = |signs: usize| -> Vec<Exceedance> {
        let all = (1..=15).flat_map(|k| std::iter::repeat_n(Exceedance::At(f64::from(k)), signs));
        all.collect()
    };
    let single = medians(&Bootstrap::new(15, 200, 7), &values(1));
    assert_eq!(medians(&Bootstrap::new(30, 200, 7).in_groups(2), &values(2)), single);
    // drawn one by one, thirty records scatter less
    let spread = |medians: &[f64]| medians.iter().map(|median| (median - 8.0).powi(2)).sum::<f64>();
    assert!(spread(&medians(&Bootstrap::new(30, 200, 7), &values(2))) < 0.8 * spread(&single));
}
