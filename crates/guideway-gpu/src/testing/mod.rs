//! Helpers for the tests of methods on graphics devices.

pub mod reflection;

use std::fmt::Display;

/// Returns a clone of what needs a device. Without one prints the reason, for the test to return.
///
/// # Panics
/// Without a device, if `GUIDEWAY_REQUIRE_DEVICES` is 1.
pub fn device_or_skip<T: Clone, E: Display>(result: &Result<T, E>) -> Option<T> {
    match result {
        Ok(value) => Some(value.clone()),
        Err(reason) => {
            let is_required =
                std::env::var_os("GUIDEWAY_REQUIRE_DEVICES").is_some_and(|v| v == "1");
            assert!(!is_required, "{reason}");
            println!("SKIPPED: {reason}");
            None
        }
    }
}
