//! Render methods that need no GPU: [`Oracle`], the judge, and [`Cpu`], the one to use; and [`lay_areas`], for what
//! lies below paths.

mod areas;
mod cpu;
mod oracle;

pub use areas::{Areas, lay_areas};
pub use cpu::Cpu;
pub use oracle::Oracle;
