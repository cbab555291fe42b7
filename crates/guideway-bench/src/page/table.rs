//! A table of a page: shown as HTML with rounded numbers, written as CSV with full precision.

use super::xml::escape;
use crate::format::{count, digits};

/// A table of the page and of a CSV file.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name of the CSV file and anchor in the page, such as `table-5.1`.
    pub name: &'static str,
    /// Caption.
    pub title: String,
    /// True if the page folds it, below the chart of its numbers.
    pub is_folded: bool,
    /// Columns from left to right.
    pub columns: Vec<Column>,
    /// Rows with one cell per column.
    pub rows: Vec<Vec<Cell>>,
}

/// A column of the page, of the file, or of both.
#[derive(Clone, Debug)]
pub struct Column {
    /// Heading in the page.
    heading: Option<String>,
    /// Name in the file, with its unit.
    key: Option<String>,
}

/// Content of a cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A text.
    Text(String),
    /// A measured number.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// A median with the 5th and 95th percentile.
    Range([f64; 3]),
    /// No content.
    Nothing,
}

impl Column {
    /// A column of the page and of the file.
    pub fn new(heading: impl Into<String>, key: impl Into<String>) -> Self {
        Self {
            heading: Some(heading.into()),
            key: Some(key.into()),
        }
    }

    /// A column of the page alone.
    pub fn in_page(heading: impl Into<String>) -> Self {
        Self {
            heading: Some(heading.into()),
            key: None,
        }
    }

    /// A column of the file alone.
    pub fn in_file(key: impl Into<String>) -> Self {
        Self {
            heading: None,
            key: Some(key.into()),
        }
    }
}

impl Cell {
    /// A cell with this text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    fn shown(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(value) => digits(*value),
            Self::Count(value) => count(*value),
            Self::Range(values) => {
                let [median, p5, p95] = values.map(digits);
                format!("{median} ({p5} to {p95})")
            }
            Self::Nothing => String::new(),
        }
    }

    fn written(&self) -> String {
        match self {
            Self::Text(text) if text.contains([',', '"', '\n', '\r']) => {
                format!("\"{}\"", text.replace('"', "\"\""))
            }
            Self::Text(text) => text.clone(),
            Self::Number(value) => value.to_string(),
            Self::Count(value) => value.to_string(),
            Self::Range(values) => values.map(|value| value.to_string()).join(" "),
            Self::Nothing => String::new(),
        }
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Nothing, Self::Number)
    }
}

impl From<Option<u64>> for Cell {
    fn from(value: Option<u64>) -> Self {
        value.map_or(Self::Nothing, Self::Count)
    }
}

impl Table {
    /// The table as CSV (RFC 4180), with full precision.
    pub fn csv(&self) -> String {
        let line = |cells: Vec<String>| cells.join(",") + "\r\n";
        let keys = self.columns.iter().filter_map(|column| column.key.clone());
        let mut file = line(keys.collect());
        for row in &self.rows {
            let cells = row.iter().zip(&self.columns);
            let kept = cells.filter(|(_, column)| column.key.is_some());
            file += &line(kept.map(|(cell, _)| cell.written()).collect());
        }
        file
    }

    /// The table as HTML, with three significant digits and without empty columns.
    pub fn html(&self) -> String {
        let has_cells = |column: usize| {
            let mut cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.any(|cell| *cell != Cell::Nothing)
        };
        let shown: Vec<(usize, &str)> = (self.columns.iter().enumerate())
            .filter_map(|(i, column)| Some((i, column.heading.as_deref()?)))
            .filter(|&(i, _)| has_cells(i))
            .collect();
        let mut html = String::from("<div class=\"wide\"><table>\n<thead><tr>");
        for (_, heading) in &shown {
            html += &format!("<th scope=\"col\">{}</th>", escape(heading));
        }
        html += "</tr></thead>\n<tbody>\n";
        for row in &self.rows {
            html += "<tr>";
            for cell in shown.iter().filter_map(|&(i, _)| row.get(i)) {
                let class = match cell {
                    Cell::Text(_) => "",
                    _ => " class=\"number\"",
                };
                html += &format!("<td{class}>{}</td>", escape(&cell.shown()));
            }
            html += "</tr>\n";
        }
        html += "</tbody></table></div>\n";
        let title = escape(&self.title);
        let name = self.name;
        if self.is_folded {
            format!("<details id=\"{name}\"><summary>{title}</summary>\n{html}</details>\n")
        } else {
            format!("<figure id=\"{name}\"><figcaption>{title}</figcaption>\n{html}</figure>\n")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_has_full_precision_and_html_three_digits() {
        let table = Table {
            name: "table-1",
            title: "A <title>".into(),
            is_folded: false,
            columns: vec![
                Column::new("Method", "method"),
                Column::in_file("mean_ms"),
                Column::in_page("Mean (ms)"),
                Column::new("Paths", "paths"),
                Column::new("Not measured", "why_not"),
            ],
            rows: vec![
                vec![
                    Cell::text("a,\"b\""),
                    Cell::Number(1.23456),
                    Cell::Range([1.23456, 1.0, 2.0]),
                    Cell::Count(1000),
                    Cell::Nothing,
                ],
                vec![
                    Cell::text("c"),
                    Cell::Nothing,
                    Cell::Nothing,
                    Cell::Nothing,
                    Cell::Nothing,
                ],
            ],
        };
        let expected = "method,mean_ms,paths,why_not\r\n\"a,\"\"b\"\"\",1.23456,1000,\r\nc,,,\r\n";
        assert_eq!(table.csv(), expected);
        let html = table.html();
        roxmltree::Document::parse(&html).expect("well-formed");
        assert!(
            html.contains("A &lt;title&gt;") && html.contains(">1,000<"),
            "{html}"
        );
        assert!(
            html.contains(">1.23 (1.00 to 2.00)<") && !html.contains("Not measured"),
            "{html}"
        );
    }
}
