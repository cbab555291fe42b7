//! The fastest route between two stations or nodes, as JSON.

use std::ffi::c_char;

use guideway::network::{RouteOptions, Router};

use crate::arguments::{optional_text, reference, refused, text};
use crate::layout::{GuidewayLayout, owned_text};

/// The way a vehicle drives.
#[derive(Debug)]
#[repr(C)]
pub struct GuidewayRouteOptions {
    /// Its type; NULL if the layout has at most one.
    pub vehicle_type: *const c_char,
    /// Its speed on paths without a limit, in m/s; 0 for 1 m/s.
    pub speed_m_s: f64,
    /// Its largest lateral acceleration in m/s², which slows it in bends; 0 for no limit.
    pub lateral_acceleration_m_s2: f64,
}

/// The fastest route from one station or node to another one, as JSON: its length and time, and its
/// paths in order. NULL if there is none. `options` may be NULL. Free the text with
/// `guideway_text_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_route(
    layout: *const GuidewayLayout,
    start: *const c_char,
    goal: *const c_char,
    options: *const GuidewayRouteOptions,
) -> *mut c_char {
    owned_text(|| {
        // SAFETY: the caller passes a layout.
        let layout = &*unsafe { reference(layout, "layout") }?.0;
        // SAFETY: the caller passes texts.
        let (start, goal) = unsafe { (text(start, "start")?, text(goal, "goal")?) };
        // SAFETY: the caller passes options, or NULL.
        let options = unsafe { options.as_ref() };
        let vehicle_type = options.map(|of| of.vehicle_type);
        // SAFETY: the caller passes a text, or NULL.
        let vehicle_type = vehicle_type.map(|of| unsafe { optional_text(of, "vehicle_type") });
        let mut chosen = RouteOptions::default();
        if let Some(options) = options {
            let positive = |value: f64, name: &str| match value >= 0.0 && value.is_finite() {
                true => Ok((value > 0.0).then_some(value)),
                false => {
                    let message = format!("the option `{name}` is {value}");
                    Err(refused(message, "Pass a number above 0, or 0"))
                }
            };
            let speed_m_s = positive(options.speed_m_s, "speed_m_s")?;
            chosen.speed_m_s = speed_m_s.unwrap_or(chosen.speed_m_s);
            let lateral = options.lateral_acceleration_m_s2;
            chosen.lateral_acceleration_m_s2 = positive(lateral, "lateral_acceleration_m_s2")?;
        }
        let only = layout.paths.vehicle_types().only_name();
        let router = Router::new(
            layout,
            vehicle_type.transpose()?.flatten().or(only),
            &chosen,
        )?;
        let route = router.route(&router.place(start)?, &router.place(goal)?)?;
        Ok(guideway::json::route(layout, &route))
    })
}
