//! Parts of a self-contained page with measurements: one HTML file without scripts or external
//! resources. It is valid XML, too, so that XML tools can check it.
//!
//! | module | purpose |
//! |---|---|
//! | `table` | a table as HTML and CSV |
//! | `xml` | escaped markup |

mod table;
mod xml;

pub use table::{Cell, Column, Table};
pub use xml::{element, escape};

/// The style sheet of all pages.
pub const STYLE: &str = include_str!("style.css");

/// The page with a title and the markup of its body.
pub fn document(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en-US\">\n<head>\n\
         <meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{0}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n",
        escape(title)
    )
}

/// A list of names with their values.
pub fn facts(facts: &[(&str, String)]) -> String {
    let fact = |(name, value): &(&str, String)| {
        format!("<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(value))
    };
    let facts: String = facts.iter().map(fact).collect();
    format!("<dl>\n{facts}</dl>\n")
}
