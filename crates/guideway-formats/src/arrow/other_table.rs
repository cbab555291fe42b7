//! Other tables: names the formats of tables that pandas and polars write beside Arrow, and the way
//! to convert them.

use guideway_layout::Place;

use crate::Problem;

/// Returns the problem of a file that is a Parquet table, or Feather of version 1.
pub(crate) fn other_table(bytes: &[u8]) -> Option<Problem> {
    let (what, read) = match bytes.get(..4)? {
        b"PAR1" => ("a Parquet table", "pyarrow.parquet.read_table"),
        b"FEA1" => ("Feather of version 1", "pyarrow.feather.read_table"),
        _ => return None,
    };
    Some(Problem::Unsupported {
        place: Place::element("the file"),
        what: what.to_owned(),
        remedy: format!(
            "Convert it to Arrow, which is Feather of version 2: \
             pyarrow.feather.write_feather({read}(\"FILE\"), \"FILE.arrow\")"
        ),
    })
}
