//! Render methods that need no GPU: [`Oracle`], the judge, and [`Cpu`], the one to use.

mod cpu;
mod oracle;

pub use cpu::Cpu;
pub use oracle::Oracle;
