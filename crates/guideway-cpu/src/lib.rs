//! Render methods without a GPU.
//!
//! | item          | does                                                                  |
//! |---------------|-----------------------------------------------------------------------|
//! | [`Cpu`]       | renders paths fast, on all cores                                      |
//! | [`Oracle`]    | renders paths exactly and slowly: the reference of all tests          |
//! | [`lay_areas`] | composites the union of areas, such as those that vehicles sweep        |

mod areas;
mod cpu;
mod oracle;

pub use areas::{Areas, lay_areas};
pub use cpu::Cpu;
pub use oracle::Oracle;
