//! Eight numbers in one register of AVX-512.
//!
//! Operations become instructions only inside a function compiled for AVX-512, and may run only there: [`Wide`] is for those
//! functions, which are entered after [`is_there`] has said so.
#![allow(unsafe_code, reason = "instructions a processor may lack, which no type can tell")]

use std::arch::x86_64::{
    __m512d, __m512i, __mmask8, _CMP_LE_OQ, _CMP_LT_OQ, _mm_loadu_pd, _mm512_abs_pd, _mm512_add_pd,
    _mm512_castpd128_pd512, _mm512_cmp_pd_mask, _mm512_cvttpd_epi64, _mm512_div_pd, _mm512_insertf64x2,
    _mm512_load_pd, _mm512_mask_blend_pd, _mm512_max_pd, _mm512_min_pd, _mm512_mul_pd, _mm512_permutexvar_pd,
    _mm512_set1_epi64, _mm512_set1_pd, _mm512_setr_epi64, _mm512_store_pd, _mm512_storeu_si512,
    _mm512_sub_pd, _mm512_test_epi64_mask, _mm512_unpackhi_pd, _mm512_unpacklo_pd,
};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::vector::{Column, Row, Vector, WIDTH};

/// Whether the processor has what [`Wide`] needs.
pub(super) fn is_there() -> bool {
    std::arch::is_x86_feature_detected!("avx512f")
        && std::arch::is_x86_feature_detected!("avx512dq")
        && std::arch::is_x86_feature_detected!("avx512vl")
        && std::arch::is_x86_feature_detected!("popcnt")
}

/// Eight numbers; to be used only in functions that are entered after [`is_there`].
#[derive(Clone, Copy)]
pub(super) struct Wide(__m512d);

/// Eight bits.
#[derive(Clone, Copy)]
pub(super) struct WideMask(__mmask8);

macro_rules! operator {
    ($operator:ident, $name:ident, $instruction:ident) => {
        impl $operator for Wide {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: there are numbers of this type only where there is AVX-512.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

operator!(Add, add, _mm512_add_pd);
operator!(Sub, sub, _mm512_sub_pd);
operator!(Mul, mul, _mm512_mul_pd);
operator!(Div, div, _mm512_div_pd);

impl BitAnd for WideMask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for WideMask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Not for WideMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl Vector for Wide {
    type Mask = WideMask;
    type Places = __m512i;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: this type is used only where there is AVX-512, here and below.
        Self(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn load(row: &Row) -> Self {
        // SAFETY: a row is eight numbers, aligned to 64 bytes.
        Self(unsafe { _mm512_load_pd(row.0.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, row: &mut Row) {
        // SAFETY: as in `load`.
        unsafe { _mm512_store_pd(row.0.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> WideMask {
        // SAFETY: as in `splat`.
        WideMask(unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0) })
    }

    #[inline(always)]
    fn below(self, other: Self) -> WideMask {
        // SAFETY: as in `splat`.
        WideMask(unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }

    #[inline(always)]
    fn choose(mask: WideMask, yes: Self, no: Self) -> Self {
        // SAFETY: as in `splat`.
        Self(unsafe { _mm512_mask_blend_pd(mask.0, no.0, yes.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: as in `splat`.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: as in `splat`.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as in `splat`.
        Self(unsafe { _mm512_abs_pd(self.0) })
    }

    #[inline(always)]
    fn places(self) -> __m512i {
        // SAFETY: as in `splat`.
        unsafe { _mm512_cvttpd_epi64(self.0) }
    }

    #[inline(always)]
    fn look_up(places: __m512i, column: &Column) -> Self {
        // SAFETY: as in `load`; places are taken modulo eight.
        Self(unsafe { _mm512_permutexvar_pd(places, _mm512_load_pd(column.0.as_ptr())) })
    }

    #[inline(always)]
    fn whole(self) -> [i64; WIDTH] {
        let mut whole = [0; WIDTH];
        // SAFETY: as in `splat`; there is room for eight.
        unsafe { _mm512_storeu_si512(whole.as_mut_ptr().cast(), _mm512_cvttpd_epi64(self.0)) };
        whole
    }

    #[inline(always)]
    fn unzip(pairs: [&[f64; 2]; WIDTH]) -> [Self; 2] {
        // SAFETY: as in `splat`; each pair is two numbers.
        unsafe {
            let [a, b, c, d, e, f, g, h] = pairs.map(|pair| _mm_loadu_pd(pair.as_ptr()));
            let even = _mm512_insertf64x2::<1>(_mm512_castpd128_pd512(a), c);
            let odd = _mm512_insertf64x2::<1>(_mm512_castpd128_pd512(b), d);
            let even = _mm512_insertf64x2::<3>(_mm512_insertf64x2::<2>(even, e), g);
            let odd = _mm512_insertf64x2::<3>(_mm512_insertf64x2::<2>(odd, f), h);
            [Self(_mm512_unpacklo_pd(even, odd)), Self(_mm512_unpackhi_pd(even, odd))]
        }
    }

    #[inline(always)]
    fn mask(bits: u8) -> WideMask {
        // SAFETY: as in `splat`. A test of the bits keeps masks among masks, which a plain number does not.
        unsafe {
            let each = _mm512_setr_epi64(1, 2, 4, 8, 16, 32, 64, 128);
            WideMask(_mm512_test_epi64_mask(_mm512_set1_epi64(i64::from(bits)), each))
        }
    }

    #[inline(always)]
    fn bits(mask: WideMask) -> u8 {
        mask.0
    }
}
