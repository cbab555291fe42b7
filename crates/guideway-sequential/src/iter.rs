//! Iterators with the methods of rayon's.

use std::iter::{Sum, once};

/// An iterator whose items are handled one after the other.
#[derive(Clone, Debug)]
pub struct Sequential<I>(pub(crate) I);

impl<I: Iterator> IntoIterator for Sequential<I> {
    type Item = I::Item;
    type IntoIter = I;

    fn into_iter(self) -> I {
        self.0
    }
}

/// Becomes a sequential iterator, as all do that become iterators.
pub trait IntoParallelIterator: IntoIterator + Sized {
    /// The iterator.
    fn into_par_iter(self) -> Sequential<Self::IntoIter> {
        Sequential(self.into_iter())
    }
}

impl<T: IntoIterator> IntoParallelIterator for T {}

/// Has a sequential iterator of references.
pub trait IntoParallelRefIterator<'a> {
    /// The iterator.
    type Iter: Iterator;

    /// The iterator.
    fn par_iter(&'a self) -> Sequential<Self::Iter>;
}

impl<'a, T: ?Sized + 'a> IntoParallelRefIterator<'a> for T
where
    &'a T: IntoIterator,
{
    type Iter = <&'a T as IntoIterator>::IntoIter;

    fn par_iter(&'a self) -> Sequential<Self::Iter> {
        Sequential(self.into_iter())
    }
}

/// Has a sequential iterator of references by which the items may change.
pub trait IntoParallelRefMutIterator<'a> {
    /// The iterator.
    type Iter: Iterator;

    /// The iterator.
    fn par_iter_mut(&'a mut self) -> Sequential<Self::Iter>;
}

impl<'a, T: ?Sized + 'a> IntoParallelRefMutIterator<'a> for T
where
    &'a mut T: IntoIterator,
{
    type Iter = <&'a mut T as IntoIterator>::IntoIter;

    fn par_iter_mut(&'a mut self) -> Sequential<Self::Iter> {
        Sequential(self.into_iter())
    }
}

/// Takes more items.
pub trait ParallelExtend<T> {
    /// Adds the items.
    fn par_extend(&mut self, items: impl IntoIterator<Item = T>);
}

impl<T, C: Extend<T>> ParallelExtend<T> for C {
    fn par_extend(&mut self, items: impl IntoIterator<Item = T>) {
        self.extend(items);
    }
}

/// The methods of rayon's iterators.
pub trait ParallelIterator: IntoIterator + Sized {
    /// See [`Iterator::map`].
    fn map<R>(self, map: impl FnMut(Self::Item) -> R) -> Sequential<impl Iterator<Item = R>> {
        Sequential(self.into_iter().map(map))
    }

    /// Maps with a value that `init` makes once.
    fn map_init<T, R>(
        self,
        init: impl FnOnce() -> T,
        mut map: impl FnMut(&mut T, Self::Item) -> R,
    ) -> Sequential<impl Iterator<Item = R>> {
        let mut state = init();
        Sequential(self.into_iter().map(move |item| map(&mut state, item)))
    }

    /// See [`Iterator::filter`].
    fn filter(
        self,
        keep: impl FnMut(&Self::Item) -> bool,
    ) -> Sequential<impl Iterator<Item = Self::Item>> {
        Sequential(self.into_iter().filter(keep))
    }

    /// See [`Iterator::filter_map`].
    fn filter_map<R>(
        self,
        map: impl FnMut(Self::Item) -> Option<R>,
    ) -> Sequential<impl Iterator<Item = R>> {
        Sequential(self.into_iter().filter_map(map))
    }

    /// See [`Iterator::flat_map`].
    fn flat_map_iter<R: IntoIterator>(
        self,
        map: impl FnMut(Self::Item) -> R,
    ) -> Sequential<impl Iterator<Item = R::Item>> {
        Sequential(self.into_iter().flat_map(map))
    }

    /// See [`Iterator::flatten`].
    fn flatten(self) -> Sequential<impl Iterator<Item = <Self::Item as IntoIterator>::Item>>
    where
        Self::Item: IntoIterator,
    {
        Sequential(self.into_iter().flatten())
    }

    /// See [`Iterator::enumerate`].
    fn enumerate(self) -> Sequential<impl Iterator<Item = (usize, Self::Item)>> {
        Sequential(self.into_iter().enumerate())
    }

    /// See [`Iterator::zip`].
    fn zip<O: IntoIterator>(
        self,
        other: O,
    ) -> Sequential<impl Iterator<Item = (Self::Item, O::Item)>> {
        Sequential(self.into_iter().zip(other))
    }

    /// See [`Iterator::step_by`].
    fn step_by(self, step: usize) -> Sequential<impl Iterator<Item = Self::Item>> {
        Sequential(self.into_iter().step_by(step))
    }

    /// There is one part in any case.
    #[must_use]
    fn with_min_len(self, _len: usize) -> Self {
        self
    }

    /// There is one part in any case.
    #[must_use]
    fn with_max_len(self, _len: usize) -> Self {
        self
    }

    /// Folds each part; there is one.
    fn fold<T>(
        self,
        init: impl FnOnce() -> T,
        fold: impl FnMut(T, Self::Item) -> T,
    ) -> Sequential<impl Iterator<Item = T>> {
        Sequential(once(self.into_iter().fold(init(), fold)))
    }

    /// Joins all items and one that `init` makes.
    fn reduce(
        self,
        init: impl FnOnce() -> Self::Item,
        join: impl FnMut(Self::Item, Self::Item) -> Self::Item,
    ) -> Self::Item {
        self.into_iter().fold(init(), join)
    }

    /// See [`Iterator::reduce`].
    fn reduce_with(
        self,
        join: impl FnMut(Self::Item, Self::Item) -> Self::Item,
    ) -> Option<Self::Item> {
        self.into_iter().reduce(join)
    }

    /// Joins the values of all results and one that `init` makes.
    ///
    /// # Errors
    /// The first error of the items or of `join`; what follows is not joined.
    fn try_reduce<T, E>(
        self,
        init: impl FnOnce() -> T,
        mut join: impl FnMut(T, T) -> Result<T, E>,
    ) -> Result<T, E>
    where
        Self: ParallelIterator<Item = Result<T, E>>,
    {
        let mut items = self.into_iter();
        items.try_fold(init(), |joined, item| join(joined, item?))
    }

    /// See [`Iterator::for_each`].
    fn for_each(self, handle: impl FnMut(Self::Item)) {
        self.into_iter().for_each(handle);
    }

    /// Handles all items with a value that `init` makes once.
    fn for_each_init<T>(
        self,
        init: impl FnOnce() -> T,
        mut handle: impl FnMut(&mut T, Self::Item),
    ) {
        let mut state = init();
        self.into_iter().for_each(|item| handle(&mut state, item));
    }

    /// See [`Iterator::try_for_each`].
    ///
    /// # Errors
    /// The first error of `handle`; what follows is not handled.
    fn try_for_each<E>(self, handle: impl FnMut(Self::Item) -> Result<(), E>) -> Result<(), E> {
        self.into_iter().try_for_each(handle)
    }

    /// See [`Iterator::all`].
    fn all(self, holds: impl FnMut(Self::Item) -> bool) -> bool {
        self.into_iter().all(holds)
    }

    /// See [`Iterator::any`].
    fn any(self, holds: impl FnMut(Self::Item) -> bool) -> bool {
        self.into_iter().any(holds)
    }

    /// See [`Iterator::find`].
    fn find_first(self, is_it: impl FnMut(&Self::Item) -> bool) -> Option<Self::Item> {
        self.into_iter().find(is_it)
    }

    /// See [`Iterator::count`].
    fn count(self) -> usize {
        self.into_iter().count()
    }

    /// See [`Iterator::sum`].
    fn sum<S: Sum<Self::Item>>(self) -> S {
        self.into_iter().sum()
    }

    /// See [`Iterator::partition`]; the parts may be of two types.
    fn partition<A, B>(self, mut is_first: impl FnMut(&Self::Item) -> bool) -> (A, B)
    where
        A: Default + Extend<Self::Item>,
        B: Default + Extend<Self::Item>,
    {
        let (mut first, mut second) = (A::default(), B::default());
        for item in self {
            match is_first(&item) {
                true => first.extend(once(item)),
                false => second.extend(once(item)),
            }
        }
        (first, second)
    }

    /// See [`Iterator::collect`].
    fn collect<C: FromIterator<Self::Item>>(self) -> C {
        self.into_iter().collect()
    }
}

impl<I: Iterator> ParallelIterator for Sequential<I> {}
