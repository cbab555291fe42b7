use std::rc::Rc;
use std::time::Instant;

use glow::HasContext;
use guideway_scene::Clock;

use super::Gl;

/// Moments between pieces of work.
pub(crate) struct Timeline {
    gl: Rc<Gl>,
    moments: Moments,
}

enum Moments {
    /// By queries, of which so many are in use. The device passes them while it works.
    Device(Vec<glow::Query>, usize),
    /// By the processor, which waits until the work is done. Where it stands in for a device it begins with
    /// drawing before it comes to the query ahead of it, so that queries would tell next to nothing.
    Host(Vec<Instant>),
}

impl Timeline {
    /// No moments yet.
    pub(crate) fn new(gl: &Rc<Gl>) -> Self {
        Self {
            gl: Rc::clone(gl),
            moments: if gl.is_software() {
                Moments::Host(Vec::new())
            } else {
                Moments::Device(Vec::new(), 0)
            },
        }
    }

    /// Whose clock it is.
    pub(crate) fn clock(&self) -> Clock {
        match self.moments {
            Moments::Device(..) => Clock::Device,
            Moments::Host(_) => Clock::Host,
        }
    }

    /// Forgets all moments.
    pub(crate) fn restart(&mut self) {
        match &mut self.moments {
            Moments::Device(_, used) => *used = 0,
            Moments::Host(moments) => moments.clear(),
        }
    }

    /// Marks the moment when all work asked for so far is done.
    pub(crate) fn mark(&mut self) -> Result<(), String> {
        match &mut self.moments {
            Moments::Device(queries, used) => {
                if *used == queries.len() {
                    queries.push(unsafe { self.gl.raw.create_query() }?);
                }
                unsafe { self.gl.raw.query_counter(queries[*used], glow::TIMESTAMP) };
                *used += 1;
            }
            Moments::Host(moments) => {
                self.gl.finish(|| true)?;
                moments.push(Instant::now());
            }
        }
        Ok(())
    }

    /// Milliseconds from one moment to the next, in order; waits for the last.
    pub(crate) fn elapsed_ms(&self) -> Vec<f64> {
        match &self.moments {
            Moments::Device(queries, used) => {
                let moment_ns = |&query| unsafe {
                    self.gl
                        .raw
                        .get_query_parameter_u64(query, glow::QUERY_RESULT)
                };
                let moments_ns: Vec<u64> = queries[..*used].iter().map(moment_ns).collect();
                let elapsed = |pair: &[u64]| pair[1].saturating_sub(pair[0]) as f64 * 1e-6;
                moments_ns.windows(2).map(elapsed).collect()
            }
            Moments::Host(moments) => {
                let elapsed = |pair: &[Instant]| (pair[1] - pair[0]).as_secs_f64() * 1e3;
                moments.windows(2).map(elapsed).collect()
            }
        }
    }
}

impl Drop for Timeline {
    fn drop(&mut self) {
        if let Moments::Device(queries, _) = &self.moments {
            for &query in queries {
                unsafe { self.gl.raw.delete_query(query) };
            }
        }
    }
}
