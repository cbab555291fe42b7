//! Attribute names: the column of an attribute whose own name a table of version 2 cannot use.

/// Start of escaped names. A number may follow, then a dot and the name of the attribute.
const ESCAPE: &str = "attribute";

/// Returns the name of the attribute in a column of version 2.
pub(super) fn attribute_of(column: &str) -> &str {
    unescaped(column).unwrap_or(column)
}

/// Returns the name of the column for an attribute: its own name, unless that is taken.
pub(super) fn column_for(attribute: &str, is_taken: impl Fn(&str) -> bool) -> String {
    if unescaped(attribute).is_none() && !is_taken(attribute) {
        return attribute.to_owned();
    }
    let mut column = format!("{ESCAPE}.{attribute}");
    let mut number = 2_u32;
    while is_taken(&column) {
        column = format!("{ESCAPE}{number}.{attribute}");
        number += 1;
    }
    column
}

fn unescaped(column: &str) -> Option<&str> {
    let rest = column.strip_prefix(ESCAPE)?;
    let rest = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    rest.strip_prefix('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_a_column_that_returns_it() {
        let mut taken = vec!["level".to_owned(), "of".to_owned()];
        let names = [
            "speed",
            "level",
            "of",
            "speed",
            "speed",
            "attribute",
            "attributes",
            "attribute.level",
            "attribute2.speed",
            "attribute.",
            "",
            "",
            "attribute7",
        ];
        for name in names {
            let column = column_for(name, |column| taken.iter().any(|t| t == column));
            assert_eq!(attribute_of(&column), name);
            assert!(!taken.contains(&column), "{column}");
            taken.push(column);
        }
        assert_eq!(
            taken[2..6],
            [
                "speed",
                "attribute.level",
                "attribute.of",
                "attribute.speed"
            ]
        );
        assert_eq!(taken[6..8], ["attribute2.speed", "attribute"]);
    }
}
