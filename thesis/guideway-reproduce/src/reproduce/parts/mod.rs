//! The measurements of the thesis' chapter 5, each of which fills its part of the results.

pub(crate) mod borders;
pub(crate) mod growth;
pub(crate) mod most_paths;
pub(crate) mod pictures;
pub(crate) mod views;
