//! Several numbers side by side as one scalar: `f64x2`, `f64x4`, `f64x8`, `f32x4`, `f32x8`, `f32x16`.
//!
//! Every operation acts on each lane alone and gives the bits that it gives on one float, so that the generated code
//! of a robot, unchanged, computes two to sixteen states at once. Lanes are registers where the target has
//! such: with `-C target-cpu=native` or the like, 256 bits on AVX, 512 on AVX-512; elsewhere several smaller ones.

pub(crate) mod sines;
pub(crate) mod tiles;
pub(crate) mod together;

use core::fmt;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use self::tiles::{lanes_of_rows, rows_of_lanes};
use crate::scalar::{FUSED, One, Scalar, Zero};
use crate::trigonometry::{Kernel, sin_cos_double, sin_cos_single};

/// `f32` or `f64`, which lanes hold.
pub trait Element: Scalar {
    /// As many lanes as the widest registers of the target hold; of 256 bits where it has no such registers.
    type Native: Lanes<Element = Self>;
}

/// Lanes of `T` as wide as the target's registers: `Native<f64>` is [`f64x8`] with AVX-512, else [`f64x4`].
pub type Native<T> = <T as Element>::Native;

impl Element for f64 {
    #[cfg(target_feature = "avx512f")]
    type Native = f64x8;
    #[cfg(not(target_feature = "avx512f"))]
    type Native = f64x4;
}

impl Element for f32 {
    #[cfg(target_feature = "avx512f")]
    type Native = f32x16;
    #[cfg(not(target_feature = "avx512f"))]
    type Native = f32x8;
}

/// Floats side by side: a [`Scalar`] that computes [`COUNT`](Self::COUNT) numbers at a time.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is one number, and numbers side by side are needed",
    note = "with `batch` and `Rollouts` a robot with fields has them in lanes, too: \
            `Robot::<Native<f64>> {{ m: 2.0.into() }}`, by `use dynamics_core::lanes::Native`"
)]
pub trait Lanes: Scalar + From<Self::Element> {
    /// What is in a lane: `f32` or `f64`.
    type Element: Element;

    /// How many lanes there are.
    const COUNT: usize;

    /// Rows to lanes: entry `i` of the result has in lane `k` entry `i` of the row of `states[k]`.
    ///
    /// Where there are fewer states than lanes, the last one fills the rest, and zeros where there is none; more are
    /// left out.
    fn gather<S, const N: usize>(states: &[S], row: impl Fn(&S) -> &[Self::Element; N]) -> [Self; N];

    /// Lanes to rows, the inverse of [`gather`](Self::gather): lanes without a state are left out.
    fn scatter<S, const N: usize>(
        lanes: &[Self; N],
        states: &mut [S],
        row: impl Fn(&mut S) -> &mut [Self::Element; N],
    );
}

// Operators are not always to be inlined: LLVM simplifies what it decides about before it is put into a method by the
// thousand, which takes it half the time. What lays lanes out is: there it decides wrongly.
macro_rules! lanes {
    ($name:ident: $count:literal x $float:ident, $sign:literal, $edge:literal, $sin_cos:path) => {
        #[doc = concat!("`", stringify!($count), "` numbers of `", stringify!($float), "` side by side.")]
        ///
        /// Made of an array, or of one number for all lanes, by `from`. Two are equal if all lanes are.
        #[derive(Clone, Copy, PartialEq)]
        #[repr(transparent)]
        #[allow(non_camel_case_types, reason = "the name of such a type in every library and language")]
        pub struct $name(wide::$name);

        impl $name {
            /// The numbers, lane by lane.
            #[inline]
            #[must_use]
            pub const fn to_array(self) -> [$float; $count] {
                self.0.to_array()
            }

            #[inline]
            const fn as_array(&self) -> &[$float; $count] {
                self.0.as_array()
            }
        }

        impl From<[$float; $count]> for $name {
            #[inline]
            fn from(lanes: [$float; $count]) -> Self {
                Self(wide::$name::new(lanes))
            }
        }

        impl From<$float> for $name {
            #[inline]
            fn from(value: $float) -> Self {
                Self(wide::$name::splat(value))
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.to_array().fmt(f)
            }
        }

        lanes!(@operator $name Add add AddAssign add_assign);
        lanes!(@operator $name Sub sub SubAssign sub_assign);
        lanes!(@operator $name Mul mul MulAssign mul_assign);
        lanes!(@operator $name Div div DivAssign div_assign);

        impl Neg for $name {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Zero for $name {
            #[inline]
            fn zero() -> Self {
                Self::from(0.0)
            }

            #[inline]
            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl One for $name {
            #[inline]
            fn one() -> Self {
                Self::from(1.0)
            }
        }

        impl Scalar for $name {
            #[inline]
            fn of(value: f64) -> Self {
                Self::from(<$float as Scalar>::of(value))
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }

            #[inline]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return Self(self.0.sqrt());
                #[cfg(not(feature = "std"))] // where `wide` may round otherwise than the scalar
                return Self::from(self.to_array().map(Scalar::sqrt));
            }

            #[inline]
            fn is_finite(self) -> bool {
                self.to_array().into_iter().all($float::is_finite)
            }

            #[inline]
            fn mul_add(self, a: Self, b: Self) -> Self {
                if FUSED { Self(self.0.mul_add(a.0, b.0)) } else { self * a + b }
            }
        }

        impl Kernel for $name {
            #[inline]
            fn turn(sin: Self, cos: Self, quarter_turns: Self) -> (Self, Self) {
                let turns = quarter_turns.0.to_bits();
                let one = wide::$name::splat($float::from_bits(1)).to_bits();
                let sign = wide::$name::splat(-0.0).to_bits();
                let zero = wide::$name::splat(0.0).to_bits();
                let odd = wide::$name::from_bits(zero - (turns & one)); // all bits, or none
                let (s, c) = (odd.select(cos.0, sin.0), odd.select(sin.0, cos.0));
                let sign_s = (turns << ($sign - 1)) & sign;
                let sign_c = ((turns + one) << ($sign - 1)) & sign;
                let signed = |x: wide::$name, sign| Self(wide::$name::from_bits(x.to_bits() ^ sign));
                (signed(s, sign_s), signed(c, sign_c))
            }
        }

        impl Lanes for $name {
            type Element = $float;
            const COUNT: usize = $count;

            #[inline(always)]
            fn gather<S, const N: usize>(states: &[S], row: impl Fn(&S) -> &[$float; N]) -> [Self; N] {
                match states.first_chunk::<$count>() {
                    Some(block) => lanes_of_rows::<_, _, _, _, _, $edge>(block, row),
                    None => {
                        let last = states.last().map_or(&[0.0; N], &row);
                        let rows: [_; $count] =
                            core::array::from_fn(|k| states.get(k).map_or(last, &row));
                        lanes_of_rows::<_, _, _, _, _, $edge>(&rows, |row| *row)
                    }
                }
            }

            #[inline(always)]
            fn scatter<S, const N: usize>(
                lanes: &[Self; N],
                states: &mut [S],
                row: impl Fn(&mut S) -> &mut [$float; N],
            ) {
                match states.first_chunk_mut::<$count>() {
                    Some(block) => rows_of_lanes::<_, _, _, _, _, $edge>(lanes, Self::as_array, block, row), // without looking how many there are
                    None => rows_of_lanes::<_, _, _, _, _, $edge>(lanes, Self::as_array, states, row),
                }
            }
        }
    };
    (@operator $name:ident $trait:ident $method:ident $assign:ident $assigning:ident) => {
        impl $trait for $name {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                Self($trait::$method(self.0, other.0))
            }
        }

        impl $assign for $name {
            #[inline]
            fn $assigning(&mut self, other: Self) {
                *self = $trait::$method(*self, other);
            }
        }
    };
}

lanes!(f64x2: 2 x f64, 63, 2, sin_cos_double);
lanes!(f64x4: 4 x f64, 63, 2, sin_cos_double);
lanes!(f64x8: 8 x f64, 63, 2, sin_cos_double);
lanes!(f32x4: 4 x f32, 31, 4, sin_cos_single);
lanes!(f32x8: 8 x f32, 31, 4, sin_cos_single);
lanes!(f32x16: 16 x f32, 31, 4, sin_cos_single);

impl f64x2 {
    /// A sine and a cosine turned by the quarter turns in the two lowest bits of `quarter_turns`, as [`Kernel::turn`] does.
    #[inline(always)]
    fn turned_apart(self, quarter_turns: f64) -> (f64, f64) {
        let [sin, cos] = self.to_array();
        let (own, other) = (self.0.to_bits(), wide::f64x2::new([cos, sin]).to_bits());
        let turns = wide::f64x2::splat(quarter_turns).to_bits();
        let odd = wide::u64x2::splat(0) - (turns & wide::u64x2::splat(1)); // all bits, or none
        let sign = wide::f64x2::splat(-0.0).to_bits();
        let signs = ((turns + wide::u64x2::new([0, 1])) << 62) & sign;
        let [sin, cos] = wide::f64x2::from_bits(own ^ ((own ^ other) & odd) ^ signs).to_array();
        (sin, cos)
    }
}
