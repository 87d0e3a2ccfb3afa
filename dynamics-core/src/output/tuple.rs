//! Several outputs one after the other: tuples, and references.

use super::{OperatingPoint, Output, Row};
use crate::error::Error;
use crate::scalar::Scalar;

impl<R: ?Sized, T: Scalar, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for () {
    const ROWS: usize = 0;

    fn write(&self, _: &R, _: &OperatingPoint<T, NQ, NV>, _: &mut [Row<T, NV>]) -> Result<(), Error> {
        Ok(())
    }
}

impl<R, T, O, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for &O
where
    R: ?Sized,
    T: Scalar,
    O: Output<R, T, NQ, NV> + ?Sized,
{
    const ROWS: usize = O::ROWS;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        (**self).write(robot, at, rows)
    }
}

macro_rules! impl_tuple {
    ($($name:ident)+) => {
        impl<R: ?Sized, T: Scalar, $($name: Output<R, T, NQ, NV>,)+ const NQ: usize, const NV: usize>
            Output<R, T, NQ, NV> for ($($name,)+)
        {
            const ROWS: usize = 0 $(+ $name::ROWS)+;

            fn write(
                &self,
                robot: &R,
                at: &OperatingPoint<T, NQ, NV>,
                rows: &mut [Row<T, NV>],
            ) -> Result<(), Error> {
                #[allow(non_snake_case, reason = "each is called as its type")]
                let ($($name,)+) = self;
                $(
                    let (own, rows) = rows.split_at_mut_checked($name::ROWS).unwrap_or_default();
                    $name.write(robot, at, own)?;
                )+
                let _ = rows;
                Ok(())
            }
        }
    };
}

impl_tuple!(A);
impl_tuple!(A B);
impl_tuple!(A B C);
impl_tuple!(A B C D);
impl_tuple!(A B C D E);
impl_tuple!(A B C D E F);
impl_tuple!(A B C D E F G);
impl_tuple!(A B C D E F G H);
