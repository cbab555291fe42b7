//! [`Reading`]: the facts that all columns of a read share.

use arrow_schema::Schema;
use guideway_layout::Limits;

use super::budget::Budget;
use super::schema::ColumnRoles;

/// Schema, limits and budget of a read.
#[derive(Clone, Copy)]
pub(super) struct Reading<'a> {
    pub(super) schema: &'a Schema,
    pub(super) columns: &'a ColumnRoles,
    pub(super) limits: &'a Limits,
    pub(super) budget: &'a Budget,
}
