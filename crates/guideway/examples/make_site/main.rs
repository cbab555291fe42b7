//! Writes `site.lif.json`, the example site:
//!
//!     cargo run --example make_site > crates/guideway/examples/site.lif.json
//!
//! With two numbers it writes that many copies of the site side by side, in that many rows.
//!
//! The site is a distribution hall of our own design: two ring lanes in opposite directions,
//! high-bay aisles, docks, chargers, parking, a production loop, and a mezzanine as a second
//! layout.

mod file;
mod hall;
mod level;
mod trajectory;

use std::io::{self, Write};
use std::process::ExitCode;

pub(crate) use file::{campus, site};

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Option<Vec<u32>> = args.iter().map(|arg| arg.parse().ok()).collect();
    let site = match numbers.as_deref() {
        Some([]) => site(),
        Some(&[columns, rows]) if columns > 0 && rows > 0 => campus(columns, rows),
        _ => {
            eprintln!("expected no arguments, or the columns and rows of copies, such as `20 16`");
            return ExitCode::from(2);
        }
    };
    match io::stdout().write_all(site.as_bytes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("cannot write the site: {problem}");
            ExitCode::FAILURE
        }
    }
}
