//! The parts of the variance of ln IM of uncertain walls.

use std::collections::BTreeMap;

use crate::folders::number;

/// The parts of the variance add up, to roundings: E β² and Var ln θ over the samples with a curve.
pub(crate) fn check_parts(parts: &[BTreeMap<String, String>], curves: &[BTreeMap<String, String>]) {
    for group in parts.chunks(6) {
        let of =
            |name: &str| group.iter().find(|row| row["part"] == name).unwrap()["variance"].parse::<f64>();
        let is_own = |curve: &&BTreeMap<String, String>| {
            curve["wall"].starts_with(&format!("{} ", group[0]["wall"]))
                && ["model", "u_max_over_u_ins"].iter().all(|name| curve[*name] == group[0][*name])
        };
        let known = curves.iter().filter(is_own).filter(|curve| !curve["beta"].is_empty());
        let known: Vec<_> =
            known.map(|curve| [number(curve, "theta_g").ln(), number(curve, "beta")]).collect();
        let mean = |of: &dyn Fn(&[f64; 2]) -> f64| known.iter().map(of).sum::<f64>() / known.len() as f64;
        let centre = mean(&|[theta, _]| *theta);
        let walls = mean(&|[theta, _]| (theta - centre).powi(2));
        let Ok(records) = of("records") else { continue };
        assert!((records - mean(&|[_, beta]| beta * beta)).abs() < 1e-9, "{group:?}");
        let names = ["height", "thickness", "not explained by parameters"];
        let explained: f64 = names.iter().map(|name| of(name).unwrap()).sum();
        assert!((explained - walls).abs() < 1e-9 && of("modelling") == Ok(0.0), "{group:?}, {walls}");
        assert!((of("total").unwrap() - records - walls).abs() < 1e-9, "{group:?}");
    }
    assert_eq!(parts.len(), 2 * 2 * 2 * 6);
}
