//! What the whole-system tests share: scenes of one behavior each, the methods that draw them, and the
//! comparison of their pictures with the oracle's.

pub mod compare;
pub mod devices;
pub mod edits;
pub mod evidence;
pub mod hairline;
pub mod methods;
pub mod random;
pub mod scenes;
pub mod sketch;
