//! Helpers for the tests of methods on graphics devices.

pub mod reflection;

/// What needs a device, unless there is none: then says so, for a test to be skipped.
pub fn here<T: Clone>(found: &Result<T, String>) -> Option<T> {
    match found {
        Ok(found) => Some(found.clone()),
        Err(why) => {
            let is_required =
                std::env::var_os("GUIDEWAY_REQUIRE_DEVICES").is_some_and(|v| v == "1");
            assert!(!is_required, "{why}");
            println!("SKIPPED: {why}");
            None
        }
    }
}
