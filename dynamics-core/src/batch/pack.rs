//! From one state after the other to lanes, and back.

use core::slice;

use nalgebra::{ArrayStorage, SMatrix};

use crate::dynamics::{EquationsOfMotion, ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::error::Error;
use crate::kinematics::Pose;
use crate::lanes::{Element, Lanes};
use crate::linearize::Linearization;
use crate::state::State;

/// What one state has and lanes can have: a float, a vector, a matrix, or a struct or tuple of these.
pub trait Pack: Copy + 'static {
    /// The float it is made of.
    type Element: Element;

    /// The same of lanes.
    type Packed<L: Lanes<Element = Self::Element>>;

    /// The `part`s of as many `states` as there are lanes; where there are fewer, the last one fills the rest.
    fn pack<L: Lanes<Element = Self::Element>, S>(
        states: &[S],
        part: impl Fn(&S) -> &Self + Copy,
    ) -> Self::Packed<L>;

    /// Writes the `part`s of as many `states` as there are, up to the number of lanes.
    fn unpack<L: Lanes<Element = Self::Element>, S>(
        packed: &Self::Packed<L>,
        states: &mut [S],
        part: impl Fn(&mut S) -> &mut Self + Copy,
    );
}

macro_rules! pack_float {
    ($($float:ident),*) => {$(
        impl Pack for $float {
            type Element = Self;
            type Packed<L: Lanes<Element = Self>> = L;

            #[inline(always)]
            fn pack<L: Lanes<Element = Self>, S>(
                states: &[S],
                part: impl Fn(&S) -> &Self + Copy,
            ) -> L {
                let [packed] = L::gather(states, |state| core::array::from_ref(part(state)));
                packed
            }

            #[inline(always)]
            fn unpack<L: Lanes<Element = Self>, S>(
                packed: &L,
                states: &mut [S],
                part: impl Fn(&mut S) -> &mut Self + Copy,
            ) {
                L::scatter(&[*packed], states, |state| core::array::from_mut(part(state)));
            }
        }
    )*};
}

pack_float!(f32, f64);

impl<T: Element, const R: usize, const C: usize> Pack for SMatrix<T, R, C> {
    type Element = T;
    type Packed<L: Lanes<Element = T>> = SMatrix<L, R, C>;

    #[inline(always)]
    fn pack<L: Lanes<Element = T>, S>(states: &[S], part: impl Fn(&S) -> &Self + Copy) -> SMatrix<L, R, C> {
        let mut columns = [[L::zero(); R]; C];
        for (c, column) in columns.iter_mut().enumerate() {
            *column = L::gather(states, |state| &part(state).data.0[c]); // `from_fn` is not inlined here
        }
        SMatrix::from_array_storage(ArrayStorage(columns))
    }

    #[inline(always)]
    fn unpack<L: Lanes<Element = T>, S>(
        packed: &SMatrix<L, R, C>,
        states: &mut [S],
        part: impl Fn(&mut S) -> &mut Self + Copy,
    ) {
        for (c, column) in packed.data.0.iter().enumerate() {
            L::scatter(column, states, |state| &mut part(state).data.0[c]);
        }
    }
}

/// `Pack` part by part; `$build` makes the whole of `field: part`s.
macro_rules! pack_parts {
    ([$($generics:tt)*] $type:ty, $build:ident $packed:ty, $element:ty, { $($field:tt: $part:ty),* }) => {
        impl<$($generics)*> Pack for $type {
            type Element = $element;
            type Packed<L: Lanes<Element = $element>> = $packed;

            #[inline(always)]
            fn pack<L: Lanes<Element = $element>, S>(
                states: &[S],
                part: impl Fn(&S) -> &Self + Copy,
            ) -> Self::Packed<L> {
                pack_parts!(@$build $($field: <$part>::pack::<L, S>(states, |state| &part(state).$field)),*)
            }

            #[inline(always)]
            fn unpack<L: Lanes<Element = $element>, S>(
                packed: &Self::Packed<L>,
                states: &mut [S],
                part: impl Fn(&mut S) -> &mut Self + Copy,
            ) {
                $(<$part>::unpack::<L, S>(&packed.$field, states, |state| &mut part(state).$field);)*
            }
        }
    };
    (@tuple $($field:tt: $value:expr),*) => { ($($value),*) };
    (@$name:ident $($field:tt: $value:expr),*) => { $name { $($field: $value),* } };
}

pack_parts!([T: Element, const NV: usize] EquationsOfMotion<T, NV>, EquationsOfMotion EquationsOfMotion<L, NV>, T, {
    mass_matrix: SMatrix<T, NV, NV>, coriolis_matrix: SMatrix<T, NV, NV>, gravity_forces: SMatrix<T, NV, 1>
});
pack_parts!(
    [T: Element, const NV: usize] InverseDynamicsDerivatives<T, NV>,
    InverseDynamicsDerivatives InverseDynamicsDerivatives<L, NV>, T,
    { dtau_dq: SMatrix<T, NV, NV>, dtau_dv: SMatrix<T, NV, NV>, dtau_da: SMatrix<T, NV, NV> }
);
pack_parts!(
    [T: Element, const NV: usize] ForwardDynamicsDerivatives<T, NV>,
    ForwardDynamicsDerivatives ForwardDynamicsDerivatives<L, NV>, T,
    { da_dq: SMatrix<T, NV, NV>, da_dv: SMatrix<T, NV, NV>, da_dtau: SMatrix<T, NV, NV> }
);
pack_parts!([T: Element] Pose<T>, Pose Pose<L>, T, {
    rotation: SMatrix<T, 3, 3>, translation: SMatrix<T, 3, 1>
});
pack_parts!([T: Element, const NQ: usize, const NV: usize] State<T, NQ, NV>, State State<L, NQ, NV>, T, {
    q: SMatrix<T, NQ, 1>, v: SMatrix<T, NV, 1>
});
pack_parts!(
    [T: Element, const NX: usize, const NU: usize] Linearization<T, NX, NU>,
    Linearization Linearization<L, NX, NU>, T,
    { a: SMatrix<T, NX, NX>, b: SMatrix<T, NX, NU>, drift: SMatrix<T, NX, 1> }
);
pack_parts!(
    [A: Pack, B: Pack<Element = A::Element>] (A, B),
    tuple (A::Packed<L>, B::Packed<L>), A::Element, { 0: A, 1: B }
);
pack_parts!(
    [A: Pack, B: Pack<Element = A::Element>, C: Pack<Element = A::Element>] (A, B, C),
    tuple (A::Packed<L>, B::Packed<L>, C::Packed<L>), A::Element, { 0: A, 1: B, 2: C }
);

/// The states of a batch: a slice, array or vector by reference, or a tuple of such.
pub trait States: Copy {
    /// The float they are made of.
    type Element: Element;

    /// One state of lanes.
    type Packed<L: Lanes<Element = Self::Element>>;

    /// `Ok` if there are as many states as `results`, in every slice.
    ///
    /// # Errors
    ///
    /// [`Error::BatchLength`], of the first that has another length.
    fn check_length(self, results: usize) -> Result<(), Error>;

    /// The states from the `first` on, as many as `count` and as there are lanes, in lanes.
    fn pack<L: Lanes<Element = Self::Element>>(self, first: usize, count: usize) -> Self::Packed<L>;
}

impl<'a, S, I> States for &'a I
where
    S: Pack + 'a,
    I: ?Sized,
    &'a I: IntoIterator<IntoIter = slice::Iter<'a, S>>, // what slices, arrays and vectors have in common
{
    type Element = S::Element;
    type Packed<L: Lanes<Element = S::Element>> = S::Packed<L>;

    #[inline(always)]
    fn check_length(self, results: usize) -> Result<(), Error> {
        let states = self.into_iter().len();
        if states == results { Ok(()) } else { Err(Error::BatchLength { results, states }) }
    }

    #[inline(always)]
    fn pack<L: Lanes<Element = S::Element>>(self, first: usize, count: usize) -> S::Packed<L> {
        let states = self.into_iter().as_slice().get(first..).unwrap_or_default();
        S::pack(states.get(..count).unwrap_or_default(), |whole| whole)
    }
}

macro_rules! states_tuple {
    ($($name:ident $field:tt),*) => {
        impl<First: States, $($name: States<Element = First::Element>),*> States for (First, $($name),*) {
            type Element = First::Element;
            type Packed<L: Lanes<Element = First::Element>> = (First::Packed<L>, $($name::Packed<L>),*);

            #[inline(always)]
            fn check_length(self, results: usize) -> Result<(), Error> {
                self.0.check_length(results)?;
                $(self.$field.check_length(results)?;)*
                Ok(())
            }

            #[inline(always)]
            fn pack<L: Lanes<Element = First::Element>>(self, first: usize, count: usize) -> Self::Packed<L> {
                (self.0.pack(first, count), $(self.$field.pack(first, count)),*)
            }
        }
    };
}

states_tuple!(B 1);
states_tuple!(B 1, C 2);
states_tuple!(B 1, C 2, D 3);
states_tuple!(B 1, C 2, D 3, E 4);
