//! Green's functions, and the functions φₙ that they are made of.

/// Green's functions after some time: the impulse response G and its integrals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Green {
    /// G, the displacement that a unit impulse gives \[s\].
    pub g: f64,
    /// H = ∫G \[s²\].
    pub h: f64,
    /// J = ∫H \[s³\].
    pub j: f64,
    /// K = ∫J \[s⁴\].
    pub k: f64,
}

/// Computes φ₁(x) = (eˣ − 1)/x.
pub(crate) fn phi1(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.exp_m1() / x }
}

/// eˣ and φ₁, φ₂, φ₃ with φₙ₊₁(x) = (φₙ(x) − 1/n!)/x.
pub(crate) struct Phi {
    pub(crate) exp: f64,
    pub(crate) one: f64,
    pub(crate) two: f64,
    pub(crate) three: f64,
}

impl Phi {
    pub(crate) fn new(x: f64) -> Self {
        let (exp, one) = (x.exp(), phi1(x));
        if x.abs() > 1.0 {
            let two = (one - 1.0) / x;
            return Self { exp, one, two, three: (two - 0.5) / x };
        }
        // φ₂ = Σ xⁿ/(n+2)!, φ₃ = Σ xⁿ/(n+3)!
        let (mut two, mut three) = (0.0, 0.0);
        for n in (0..18_u32).rev() {
            let n = f64::from(n);
            two = 1.0 + x / (n + 3.0) * two;
            three = 1.0 + x / (n + 4.0) * three;
        }
        Self { exp, one, two: two / 2.0, three: three / 6.0 }
    }
}
