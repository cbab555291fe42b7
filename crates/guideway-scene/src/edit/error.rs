//! Errors of editing a scene.

use std::fmt;

/// The reason why a scene rejects an edit. The scene is unchanged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EditError {
    /// The scene has no such path row.
    UnknownPath {
        /// The requested row.
        path: u32,
        /// Number of rows.
        rows: usize,
    },
    /// A control point would not be finite, or exceed the coordinate limit.
    OutOfBounds {
        /// Row of the path; `None` for a path that is not part of the scene yet.
        path: Option<u32>,
    },
    /// The paths of a gesture would exceed the coordinate limit.
    FarGesture,
    /// The layout has no such element, level or block.
    UnknownReference {
        /// Its kind, such as `level` or `node`.
        what: &'static str,
        /// The requested row.
        row: u32,
    },
    /// Copies would exceed a limit.
    TooManyCopies {
        /// Their kind, such as `copies`.
        what: &'static str,
        /// Their number.
        count: u64,
        /// The limit.
        limit: u64,
    },
    /// The number of curves differs from the number of paths.
    CurveCountMismatch,
    /// A transform names a path twice.
    DuplicatePath {
        /// Row of the path.
        path: u32,
    },
    /// A node or station would not be at a finite position within the coordinate limit.
    FarPosition {
        /// `node` or `station`.
        what: &'static str,
    },
    /// The number of values differs from the number of rows, and is not one.
    ValueCountMismatch,
    /// A number is NaN or infinite.
    NotFinite {
        /// Name of its column.
        column: String,
    },
    /// Stations have no entries per vehicle type.
    NoVehicleTypes,
    /// An element has no entry for a vehicle type.
    NoEntry {
        /// `path` or `node`.
        what: &'static str,
        /// Row of the element.
        row: u32,
        /// The vehicle type.
        vehicle_type: String,
    },
    /// Entries per vehicle type have a column that the table lacks, or has in another type.
    ColumnType {
        /// Name of the column.
        column: String,
    },
    /// An edit of tables sets the states of paths.
    PathState,
    /// A level to remove still has elements.
    LevelInUse {
        /// Row of the level.
        row: u32,
    },
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownPath { path, rows } => {
                write!(f, "unknown path row {path}: the scene has {rows} rows")
            }
            Self::OutOfBounds { path: Some(path) } => {
                write!(
                    f,
                    "the path in row {path} would exceed the coordinate limit of 1e9 m"
                )
            }
            Self::OutOfBounds { path: None } => {
                write!(
                    f,
                    "a new path needs finite points within the coordinate limit of 1e9 m"
                )
            }
            Self::FarGesture => write!(
                f,
                "the paths would exceed the coordinate limit of 1e9 m; move them less far"
            ),
            Self::UnknownReference { what, row } => write!(
                f,
                "the layout has no {what} in row {row}; choose one that exists"
            ),
            Self::TooManyCopies { what, count, limit } => write!(
                f,
                "{count} {what} exceed the limit of {limit}; make fewer copies"
            ),
            Self::CurveCountMismatch => write!(f, "the edit needs exactly one curve per path"),
            Self::DuplicatePath { path } => {
                write!(
                    f,
                    "the edit names the path in row {path} twice; name each path once"
                )
            }
            Self::FarPosition { what } => write!(
                f,
                "a {what} needs a finite position within the coordinate limit of 1e9 m"
            ),
            Self::ValueCountMismatch => {
                write!(f, "the edit needs one value per row, or one for all rows")
            }
            Self::NotFinite { column } => {
                write!(f, "a value of `{column}` is no finite number")
            }
            Self::NoVehicleTypes => write!(
                f,
                "stations have no properties per vehicle type; set the property for all types"
            ),
            Self::NoEntry {
                what,
                row,
                vehicle_type,
            } => write!(
                f,
                "the {what} in row {row} has no entry for the vehicle type `{vehicle_type}`; add \
                 the type to it first"
            ),
            Self::ColumnType { column } => write!(
                f,
                "`{column}` per vehicle type is no column yet, or one of another type; create the \
                 column first"
            ),
            Self::LevelInUse { row } => write!(
                f,
                "the level in row {row} still has elements; move them to another level first"
            ),
            Self::PathState => {
                write!(
                    f,
                    "`Edit::SetStates` removes and restores paths, not an edit of tables"
                )
            }
        }
    }
}

impl std::error::Error for EditError {}
