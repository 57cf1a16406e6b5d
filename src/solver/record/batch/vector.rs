//! Eight numbers side by side, one for each lane.
//!
//! Every operation rounds as it does on one number, on every processor.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// Numbers side by side.
pub(super) const WIDTH: usize = 8;

/// A number for each lane, in memory.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Row(pub(super) [f64; WIDTH]);

impl Row {
    pub(super) const ZERO: Self = Self([0.0; WIDTH]);
}

/// A number for each of eight places, to be looked up.
pub(super) type Column = Row;

/// A number for each lane.
pub(super) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Yes or no for each lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;
    /// A place of a column for each lane.
    type Places: Copy;

    /// The same number for all.
    fn splat(value: f64) -> Self;
    fn load(row: &Row) -> Self;
    fn store(self, row: &mut Row);
    /// ≤, false where one is not a number.
    fn at_most(self, other: Self) -> Self::Mask;
    /// <, false where one is not a number.
    fn below(self, other: Self) -> Self::Mask;
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The larger; `other` where one is not a number.
    fn max(self, other: Self) -> Self;
    /// The smaller; `other` where one is not a number.
    fn min(self, other: Self) -> Self;
    fn abs(self) -> Self;
    /// Each as a place: a whole number that is not negative, taken modulo eight.
    fn places(self) -> Self::Places;
    /// The number at each place of a column.
    fn look_up(places: Self::Places, column: &Column) -> Self;
    /// Each as a whole number, which it is.
    fn whole(self) -> [i64; WIDTH];
    /// The first and the second numbers of pairs.
    fn unzip(pairs: [&[f64; 2]; WIDTH]) -> [Self; 2];
    /// Lane `i` by bit `i`.
    fn mask(bits: u8) -> Self::Mask;
    fn bits(mask: Self::Mask) -> u8;
}

/// On any processor.
#[derive(Clone, Copy)]
pub(super) struct Portable([f64; WIDTH]);

/// All ones or all zeros for each lane.
#[derive(Clone, Copy)]
pub(super) struct PortableMask([u64; WIDTH]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| operation(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn compare(self, other: Self, comparison: impl Fn(f64, f64) -> bool) -> PortableMask {
        PortableMask(std::array::from_fn(|i| u64::from(comparison(self.0[i], other.0[i])).wrapping_neg()))
    }
}

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Div for Portable {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl BitAnd for PortableMask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl BitOr for PortableMask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] | other.0[i]))
    }
}

impl Not for PortableMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(|lane| !lane))
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole numbers far below 2⁵³, and places that are taken modulo eight"
)]
impl Vector for Portable {
    type Mask = PortableMask;
    type Places = [usize; WIDTH];

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; WIDTH])
    }

    #[inline(always)]
    fn load(row: &Row) -> Self {
        Self(row.0)
    }

    #[inline(always)]
    fn store(self, row: &mut Row) {
        row.0 = self.0;
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> PortableMask {
        self.compare(other, |a, b| a <= b)
    }

    #[inline(always)]
    fn below(self, other: Self) -> PortableMask {
        self.compare(other, |a, b| a < b)
    }

    #[inline(always)]
    fn choose(mask: PortableMask, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|i| {
            f64::from_bits((yes.0[i].to_bits() & mask.0[i]) | (no.0[i].to_bits() & !mask.0[i]))
        }))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }

    #[inline(always)]
    fn places(self) -> [usize; WIDTH] {
        self.0.map(|place| place as usize)
    }

    #[inline(always)]
    fn look_up(places: [usize; WIDTH], column: &Column) -> Self {
        Self(places.map(|place| column.0[place % WIDTH]))
    }

    #[inline(always)]
    fn whole(self) -> [i64; WIDTH] {
        self.0.map(|number| number as i64)
    }

    #[inline(always)]
    fn unzip(pairs: [&[f64; 2]; WIDTH]) -> [Self; 2] {
        [0, 1].map(|part| Self(std::array::from_fn(|i| pairs[i][part])))
    }

    #[inline(always)]
    fn mask(bits: u8) -> PortableMask {
        PortableMask(std::array::from_fn(|i| u64::from(bits >> i & 1).wrapping_neg()))
    }

    #[inline(always)]
    fn bits(mask: PortableMask) -> u8 {
        (0..WIDTH).fold(0, |bits, i| bits | ((mask.0[i] & 1) as u8) << i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALUES: [f64; 14] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.1,
        -3.7,
        7.0,
        1e300,
        -1e-300,
        5e-324,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        2.5,
    ];

    fn outcome<V: Vector>() -> Vec<u64> {
        let mut bits = Vec::new();
        let mut keep = |vector: V| {
            let mut row = Row::ZERO;
            vector.store(&mut row);
            // one NaN is as good as another
            bits.extend(row.0.map(|x| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }));
        };
        let window = |from: usize| Row(std::array::from_fn(|i| VALUES[(from + i) % VALUES.len()]));
        let column = Row(std::array::from_fn(|i| i as f64 * 1.5));
        let pairs: [[f64; 2]; WIDTH] = std::array::from_fn(|i| [i as f64, -0.5 * i as f64]);
        for from in 0..VALUES.len() {
            for to in 0..VALUES.len() {
                let (a, b) = (V::load(&window(from)), V::load(&window(to)));
                for result in [a + b, a - b, a * b, a / b, a.max(b), a.min(b), a.abs()] {
                    keep(result);
                }
                let masks = [
                    a.below(b),
                    a.at_most(b),
                    !a.below(b),
                    a.below(b) | b.below(a),
                    V::mask(u8::try_from(from * 17).unwrap_or(u8::MAX)),
                ];
                for mask in masks {
                    keep(V::choose(mask & V::mask(0b1011_0111), a, b));
                    keep(V::splat(f64::from(V::bits(mask))));
                }
            }
            let places = V::load(&Row(std::array::from_fn(|i| (from + 3 * i) as f64)));
            keep(V::look_up(places.places(), &column));
            keep(V::load(&Row(places.whole().map(|number| number as f64))));
        }
        V::unzip(std::array::from_fn(|i| &pairs[i])).into_iter().for_each(keep);
        bits
    }

    /// Written out for one lane.
    #[test]
    fn portable_numbers_are_numbers() {
        let (a, b) = (Portable(std::array::from_fn(|i| i as f64 - 2.0)), Portable::splat(1.5));
        assert_eq!((a * b - a).0, std::array::from_fn(|i| 0.5 * (i as f64 - 2.0)));
        assert_eq!(Portable::bits(a.below(b)), 0b0000_1111);
        assert_eq!(Portable::choose(Portable::mask(0b10), a, b).0, [1.5, -1.0, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5]);
        assert_eq!(
            Portable::look_up(a.abs().places(), &Row([9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0])).0,
            [7.0, 8.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0]
        );
        let pairs: [[f64; 2]; WIDTH] = std::array::from_fn(|i| [i as f64, 10.0 * i as f64]);
        let [first, second] = Portable::unzip(std::array::from_fn(|i| &pairs[i]));
        assert_eq!((first.0[3], second.0[3]), (3.0, 30.0));
    }

    #[test]
    #[cfg(target_arch = "x86_64")]
    #[allow(unsafe_code, reason = "each processor's own is asked for first")]
    fn every_processor_gives_the_same_bits() {
        use super::super::{avx2, avx512};

        #[target_feature(enable = "avx2")]
        fn halves() -> Vec<u64> {
            outcome::<avx2::Halves>()
        }
        #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
        fn wide() -> Vec<u64> {
            outcome::<avx512::Wide>()
        }
        if avx2::is_there() {
            // SAFETY: the processor has AVX2, as was just found.
            assert_eq!(outcome::<Portable>(), unsafe { halves() });
        }
        if avx512::is_there() {
            // SAFETY: the processor has AVX-512, as was just found.
            assert_eq!(outcome::<Portable>(), unsafe { wide() });
        }
    }
}
