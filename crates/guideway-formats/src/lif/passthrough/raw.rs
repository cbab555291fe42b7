//! Raw JSON helpers: objects whose members are parsed on demand.

use std::borrow::Cow;
use std::collections::HashMap;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use serde_json::{Map, Value};

/// A parsed object.
pub(super) type Object = Map<String, Value>;

/// An object with unparsed members.
pub(super) type RawObject<'a> = HashMap<Cow<'a, str>, &'a RawValue>;

/// Removes a member and parses it; `None` if it is missing or of another type.
pub(super) fn take<T: DeserializeOwned>(members: &mut RawObject<'_>, key: &str) -> Option<T> {
    parse(members.remove(key)?)
}

/// Parses a value; `None` if it is of another type.
pub(super) fn parse<'a, T: Deserialize<'a>>(value: &'a RawValue) -> Option<T> {
    serde_json::from_str(value.get()).ok()
}

/// Parses all members of an object.
pub(super) fn parse_members(members: RawObject<'_>) -> Object {
    let members = members.into_iter();
    let parsed = members.filter_map(|(name, value)| Some((name.into_owned(), parse(value)?)));
    parsed.collect()
}
