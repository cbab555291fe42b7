//! Timestamps between pieces of work, by the clock of the device or of the host.

use std::rc::Rc;
use std::time::Instant;

use glow::HasContext;
use guideway_scene::Clock;

use super::Gl;
use crate::error::GlError;

/// A list of timestamps between pieces of work.
pub(crate) struct Timeline {
    gl: Rc<Gl>,
    timestamps: Timestamps,
}

enum Timestamps {
    /// Timer queries, and the number in use. The device writes them as it passes them.
    Device(Vec<glow::Query>, usize),
    /// Host times after waiting for the device. Software rasterizers need them, because they start
    /// to draw before they reach an earlier timer query.
    Host(Vec<Instant>),
}

impl Timeline {
    /// An empty timeline.
    pub(crate) fn new(gl: &Rc<Gl>) -> Self {
        Self {
            gl: Rc::clone(gl),
            timestamps: if gl.is_software() {
                Timestamps::Host(Vec::new())
            } else {
                Timestamps::Device(Vec::new(), 0)
            },
        }
    }

    /// The clock of the timestamps.
    pub(crate) fn clock(&self) -> Clock {
        match self.timestamps {
            Timestamps::Device(..) => Clock::Device,
            Timestamps::Host(_) => Clock::Host,
        }
    }

    /// Removes all timestamps.
    pub(crate) fn restart(&mut self) {
        match &mut self.timestamps {
            Timestamps::Device(_, used) => *used = 0,
            Timestamps::Host(times) => times.clear(),
        }
    }

    /// Adds the time at which all queued work is complete.
    ///
    /// # Errors
    /// When the device fails.
    pub(crate) fn mark(&mut self) -> Result<(), GlError> {
        match &mut self.timestamps {
            Timestamps::Device(queries, used) => {
                if *used == queries.len() {
                    // SAFETY: the context is current; the call makes an object and takes no memory
                    // of the host.
                    let query = unsafe { self.gl.raw.create_query() };
                    queries.push(query.map_err(GlError::create("query"))?);
                }
                // SAFETY: the object belongs to this context, which is current; no memory of the
                // host is passed.
                unsafe { self.gl.raw.query_counter(queries[*used], glow::TIMESTAMP) };
                *used += 1;
            }
            Timestamps::Host(times) => {
                self.gl.finish(|| true)?;
                times.push(Instant::now());
            }
        }
        Ok(())
    }

    /// Milliseconds between consecutive timestamps. Waits for the last one.
    pub(crate) fn elapsed_ms(&self) -> Vec<f64> {
        match &self.timestamps {
            Timestamps::Device(queries, used) => {
                // SAFETY: the query belongs to this context; the driver answers by value.
                let time_ns = |&query| unsafe {
                    self.gl
                        .raw
                        .get_query_parameter_u64(query, glow::QUERY_RESULT)
                };
                let times_ns: Vec<u64> = queries[..*used].iter().map(time_ns).collect();
                let elapsed = |pair: &[u64]| pair[1].saturating_sub(pair[0]) as f64 * 1e-6;
                times_ns.windows(2).map(elapsed).collect()
            }
            Timestamps::Host(times) => {
                let elapsed = |pair: &[Instant]| (pair[1] - pair[0]).as_secs_f64() * 1e3;
                times.windows(2).map(elapsed).collect()
            }
        }
    }
}

impl Drop for Timeline {
    fn drop(&mut self) {
        if let Timestamps::Device(queries, _) = &self.timestamps {
            for &query in queries {
                // SAFETY: the object belongs to this context, and nothing uses it afterwards.
                unsafe { self.gl.raw.delete_query(query) };
            }
        }
    }
}
