//! Tests the motion of floors against that of the chain of storeys.

use ground_motion::Storeys;

use crate::chain::{STOREYS, TAIL, ground, integrated, rounded, storeys};

/// The nodes differ from the motion itself by (Δt²/12) a″, up to 2e-4 of the peak at the largest phase.
#[test]
fn modes_agree_with_the_chain_itself() {
    let ground = ground();
    let chain = storeys(0.0, &STOREYS);
    let single = storeys(0.05, &STOREYS[..1]);
    let dashpot = 2.0 * 0.05 * (single[0].mass * single[0].stiffness).sqrt();
    for (chain, dashpots) in [(chain, vec![0.0; 3]), (single, vec![dashpot])] {
        let modes = Storeys::new(&chain).unwrap();
        let every = 16;
        let own = modes.floor(&ground, 1.0, 1).unwrap().acceleration.step();
        let parts = every * rounded(ground.step() / own);
        let expected = integrated(&chain, &dashpots, &ground, parts);
        for (index, floor) in expected.iter().enumerate() {
            let found = modes.floor(&ground, ground.duration() + TAIL, index + 1).unwrap();
            for (quantity, nodes) in
                [found.acceleration.samples(), &found.displacement].into_iter().enumerate()
            {
                let peak = floor.iter().fold(0.0_f64, |peak, values| peak.max(values[quantity].abs()));
                let pairs = nodes.iter().zip(floor.iter().step_by(every));
                let apart = pairs.map(|(node, values)| (node - values[quantity]).abs()).fold(0.0, f64::max);
                assert!(apart <= 3e-4 * peak, "floor {index}, quantity {quantity}: {:.1e}", apart / peak);
            }
        }
    }
    let ratios = Storeys::new(&storeys(0.07, &STOREYS)).unwrap().damping_ratios();
    assert!(ratios.iter().all(|ratio| (ratio - 0.07).abs() < 1e-12), "{ratios:?}");
}
