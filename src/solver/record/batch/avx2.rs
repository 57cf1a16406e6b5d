//! Eight numbers in two registers of AVX2.
//!
//! As in the module `avx512`: [`Halves`] are for functions compiled for AVX2, which are entered after [`is_there`] has said so.
#![allow(unsafe_code, reason = "instructions a processor may lack, which no type can tell")]

use std::arch::x86_64::{
    __m128i, __m256d, _CMP_LE_OQ, _CMP_LT_OQ, _mm_and_si128, _mm_loadu_pd, _mm_set1_epi32, _mm_storeu_si128,
    _mm256_add_pd, _mm256_and_pd, _mm256_and_si256, _mm256_andnot_pd, _mm256_blendv_pd, _mm256_castsi256_pd,
    _mm256_cmp_pd, _mm256_cmpeq_epi64, _mm256_cvttpd_epi32, _mm256_div_pd, _mm256_i32gather_pd,
    _mm256_load_pd, _mm256_max_pd, _mm256_min_pd, _mm256_movemask_pd, _mm256_mul_pd, _mm256_or_pd,
    _mm256_set_m128d, _mm256_set1_epi64x, _mm256_set1_pd, _mm256_setr_epi64x, _mm256_store_pd, _mm256_sub_pd,
    _mm256_unpackhi_pd, _mm256_unpacklo_pd,
};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::vector::{Column, Row, Vector, WIDTH};

/// Whether the processor has what [`Halves`] need.
pub(super) fn is_there() -> bool {
    std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("popcnt")
}

/// Numbers of lanes 0 to 3 and 4 to 7; to be used only in functions that are entered after [`is_there`].
#[derive(Clone, Copy)]
pub(super) struct Halves([__m256d; 2]);

/// All ones or all zeros for each lane.
#[derive(Clone, Copy)]
pub(super) struct HalvesMask([__m256d; 2]);

// No closures: they are not always put into their place, and then lack AVX2.
macro_rules! operator {
    ($type:ident, $operator:ident, $name:ident, $instruction:ident) => {
        impl $operator for $type {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let ([a, b], [c, d]) = (self.0, other.0);
                // SAFETY: there are values of this type only where there is AVX2.
                Self(unsafe { [$instruction(a, c), $instruction(b, d)] })
            }
        }
    };
}

operator!(Halves, Add, add, _mm256_add_pd);
operator!(Halves, Sub, sub, _mm256_sub_pd);
operator!(Halves, Mul, mul, _mm256_mul_pd);
operator!(Halves, Div, div, _mm256_div_pd);
operator!(HalvesMask, BitAnd, bitand, _mm256_and_pd);
operator!(HalvesMask, BitOr, bitor, _mm256_or_pd);

impl Not for HalvesMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        let [low, high] = self.0;
        // SAFETY: as above.
        Self(unsafe {
            let ones = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
            [_mm256_andnot_pd(low, ones), _mm256_andnot_pd(high, ones)]
        })
    }
}

impl Vector for Halves {
    type Mask = HalvesMask;
    type Places = [__m128i; 2];

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: this type is used only where there is AVX2, here and below.
        Self([unsafe { _mm256_set1_pd(value) }; 2])
    }

    #[inline(always)]
    fn load(row: &Row) -> Self {
        let (low, high) = row.0.split_at(4);
        // SAFETY: four numbers each, aligned to 32 bytes.
        Self(unsafe { [_mm256_load_pd(low.as_ptr()), _mm256_load_pd(high.as_ptr())] })
    }

    #[inline(always)]
    fn store(self, row: &mut Row) {
        let (low, high) = row.0.split_at_mut(4);
        // SAFETY: as in `load`.
        unsafe {
            _mm256_store_pd(low.as_mut_ptr(), self.0[0]);
            _mm256_store_pd(high.as_mut_ptr(), self.0[1]);
        }
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> HalvesMask {
        let ([a, b], [c, d]) = (self.0, other.0);
        // SAFETY: as in `splat`.
        HalvesMask(unsafe { [_mm256_cmp_pd::<_CMP_LE_OQ>(a, c), _mm256_cmp_pd::<_CMP_LE_OQ>(b, d)] })
    }

    #[inline(always)]
    fn below(self, other: Self) -> HalvesMask {
        let ([a, b], [c, d]) = (self.0, other.0);
        // SAFETY: as in `splat`.
        HalvesMask(unsafe { [_mm256_cmp_pd::<_CMP_LT_OQ>(a, c), _mm256_cmp_pd::<_CMP_LT_OQ>(b, d)] })
    }

    #[inline(always)]
    fn choose(mask: HalvesMask, yes: Self, no: Self) -> Self {
        let ([no0, no1], [yes0, yes1], [mask0, mask1]) = (no.0, yes.0, mask.0);
        // SAFETY: as in `splat`.
        Self(unsafe { [_mm256_blendv_pd(no0, yes0, mask0), _mm256_blendv_pd(no1, yes1, mask1)] })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        // SAFETY: as in `splat`.
        Self(unsafe { [_mm256_max_pd(a, c), _mm256_max_pd(b, d)] })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        // SAFETY: as in `splat`.
        Self(unsafe { [_mm256_min_pd(a, c), _mm256_min_pd(b, d)] })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        let [low, high] = self.0;
        // SAFETY: as in `splat`.
        Self(unsafe {
            let sign = _mm256_set1_pd(-0.0);
            [_mm256_andnot_pd(sign, low), _mm256_andnot_pd(sign, high)]
        })
    }

    #[inline(always)]
    fn places(self) -> [__m128i; 2] {
        let [low, high] = self.0;
        // SAFETY: as in `splat`.
        unsafe {
            let seven = _mm_set1_epi32(7);
            [_mm_and_si128(_mm256_cvttpd_epi32(low), seven), _mm_and_si128(_mm256_cvttpd_epi32(high), seven)]
        }
    }

    #[inline(always)]
    fn look_up(places: [__m128i; 2], column: &Column) -> Self {
        let ([low, high], numbers) = (places, column.0.as_ptr());
        // SAFETY: places are below eight, the numbers of a column.
        Self(unsafe { [_mm256_i32gather_pd::<8>(numbers, low), _mm256_i32gather_pd::<8>(numbers, high)] })
    }

    #[inline(always)]
    fn whole(self) -> [i64; WIDTH] {
        let mut whole = [0_i32; WIDTH];
        let (low, high) = whole.split_at_mut(4);
        // SAFETY: as in `splat`; there is room for four in each half.
        unsafe {
            _mm_storeu_si128(low.as_mut_ptr().cast(), _mm256_cvttpd_epi32(self.0[0]));
            _mm_storeu_si128(high.as_mut_ptr().cast(), _mm256_cvttpd_epi32(self.0[1]));
        }
        whole.map(i64::from)
    }

    #[inline(always)]
    fn unzip(pairs: [&[f64; 2]; WIDTH]) -> [Self; 2] {
        // SAFETY: as in `splat`; each pair is two numbers.
        unsafe {
            let [a, b, c, d, e, f, g, h] = pairs;
            let even = _mm256_set_m128d(_mm_loadu_pd(c.as_ptr()), _mm_loadu_pd(a.as_ptr()));
            let odd = _mm256_set_m128d(_mm_loadu_pd(d.as_ptr()), _mm_loadu_pd(b.as_ptr()));
            let even4 = _mm256_set_m128d(_mm_loadu_pd(g.as_ptr()), _mm_loadu_pd(e.as_ptr()));
            let odd4 = _mm256_set_m128d(_mm_loadu_pd(h.as_ptr()), _mm_loadu_pd(f.as_ptr()));
            [
                Self([_mm256_unpacklo_pd(even, odd), _mm256_unpacklo_pd(even4, odd4)]),
                Self([_mm256_unpackhi_pd(even, odd), _mm256_unpackhi_pd(even4, odd4)]),
            ]
        }
    }

    #[inline(always)]
    fn mask(bits: u8) -> HalvesMask {
        // SAFETY: as in `splat`.
        unsafe {
            let bits = _mm256_set1_epi64x(i64::from(bits));
            let (low, high) = (_mm256_setr_epi64x(1, 2, 4, 8), _mm256_setr_epi64x(16, 32, 64, 128));
            HalvesMask([
                _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(bits, low), low)),
                _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(bits, high), high)),
            ])
        }
    }

    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "four bits each")]
    fn bits(mask: HalvesMask) -> u8 {
        // SAFETY: as in `splat`.
        let (low, high) = unsafe { (_mm256_movemask_pd(mask.0[0]), _mm256_movemask_pd(mask.0[1])) };
        (low | high << 4) as u8
    }
}
