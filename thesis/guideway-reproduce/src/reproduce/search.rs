//! The most paths that a method draws within a frame time: bracket by doubling, then close in.

use guideway_scene::RenderError;
use serde::{Deserialize, Serialize};

/// What is searched for, and where.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// Longest median frame time that counts, in milliseconds.
    pub target_ms: f64,
    /// Paths of the first trial.
    pub start: usize,
    /// Fewest paths that are tried.
    pub least: usize,
    /// Most paths that are tried.
    pub ceiling: usize,
    /// The search ends when the count is known to this fraction.
    pub tolerance: f64,
}

/// Why there are not more paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Limit {
    /// With more, frames take too long.
    FrameTime,
    /// More were not tried.
    Ceiling,
    /// Even the fewest that were tried take too long.
    TooSlow,
    /// More are refused, such as for lack of memory.
    Refused,
    /// The time for the search was over.
    Time,
}

/// One count that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Paths.
    pub paths: usize,
    /// Median frame time in milliseconds; none when the method refused.
    pub frame_ms: Option<f64>,
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Found<T> {
    /// The most paths within the target, and what was measured of them.
    pub(crate) best: Option<(usize, T)>,
    /// Why there are not more.
    pub(crate) limit: Limit,
    /// What the method said when it refused more.
    pub(crate) reason: Option<String>,
    /// All trials in order.
    pub(crate) trials: Vec<Trial>,
}

impl<T> Found<T> {
    /// What a search begins with.
    pub(crate) fn nothing() -> Self {
        Self {
            best: None,
            limit: Limit::Time,
            reason: None,
            trials: Vec::new(),
        }
    }
}

enum Next {
    Try(usize),
    End(Limit),
}

impl Search {
    /// Runs trials until the answer is known, after those of a search that ended early. A trial returns the
    /// frame time and what to keep of it, or why the method refuses; `is_over` ends the search early.
    pub(crate) fn run<T>(
        &self,
        mut found: Found<T>,
        is_over: impl Fn() -> bool,
        mut trial: impl FnMut(usize) -> Result<Result<(f64, T), String>, RenderError>,
    ) -> Result<Found<T>, RenderError> {
        found.limit = loop {
            let paths = match self.next(&found.trials) {
                Next::Try(_) if is_over() => break Limit::Time,
                Next::Try(paths) => paths,
                Next::End(limit) => break limit,
            };
            let (frame_ms, kept) = match trial(paths)? {
                Ok((frame_ms, kept)) => (Some(frame_ms), Some(kept)),
                Err(reason) => {
                    found.reason = Some(reason);
                    (None, None)
                }
            };
            found.trials.push(Trial { paths, frame_ms });
            if let Some(kept) = kept
                && self.is_within(frame_ms)
            {
                found.best = Some((paths, kept));
            }
        };
        // Of a search that may go on, the refusal may yet be the answer.
        if !matches!(found.limit, Limit::Refused | Limit::Time) {
            found.reason = None;
        }
        Ok(found)
    }

    fn is_within(&self, frame_ms: Option<f64>) -> bool {
        frame_ms.is_some_and(|ms| ms <= self.target_ms)
    }

    fn next(&self, trials: &[Trial]) -> Next {
        // The answer lies between the last count within the target and the last beyond.
        let last = |is_low| {
            let mut own = trials
                .iter()
                .filter(|t| self.is_within(t.frame_ms) == is_low);
            own.next_back()
        };
        let low = last(true).and_then(|t| Some((t.paths, t.frame_ms?)));
        let high = last(false).map(|t| (t.paths, t.frame_ms));
        // A count that is far off is left by larger steps.
        let step = |nearness: f64| if nearness < 0.2 { 4 } else { 2 };
        match (low, high) {
            (None, None) => Next::Try(self.start.clamp(self.least, self.ceiling)),
            (Some((low, _)), None) if low >= self.ceiling => Next::End(Limit::Ceiling),
            (Some((low, ms)), None) => {
                let next = low.saturating_mul(step(ms / self.target_ms));
                Next::Try(next.min(self.ceiling))
            }
            (None, Some((high, ms))) if high <= self.least => Next::End(match ms {
                Some(_) => Limit::TooSlow,
                None => Limit::Refused,
            }),
            (None, Some((high, ms))) => {
                let nearness = ms.map_or(1.0, |ms| self.target_ms / ms);
                Next::Try((high / step(nearness)).max(self.least))
            }
            (Some((low, low_ms)), Some((high, high_ms))) => {
                let width = high.saturating_sub(low);
                if width <= 1 || width as f64 <= low as f64 * self.tolerance {
                    return Next::End(match high_ms {
                        Some(_) => Limit::FrameTime,
                        None => Limit::Refused,
                    });
                }
                let fraction = match high_ms {
                    // Times grow about in line with paths; every third step halves, in case they do not.
                    Some(high_ms) if !trials.len().is_multiple_of(3) && high_ms > low_ms => {
                        let guess = (self.target_ms - low_ms) / (high_ms - low_ms);
                        // A little to the far side of the guess, so that the bracket closes from there too.
                        let nudge = 0.4 * self.tolerance * low as f64 / width as f64;
                        if guess < 0.5 {
                            guess + nudge
                        } else {
                            guess - nudge
                        }
                    }
                    _ => 0.5,
                };
                let next = low + (width as f64 * fraction.clamp(0.02, 0.98)).round() as usize;
                Next::Try(next.clamp(low + 1, high - 1))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEARCH: Search = Search {
        target_ms: 1000.0 / 60.0,
        start: 16_000,
        least: 250,
        ceiling: 4_000_000,
        tolerance: 0.02,
    };

    /// Searches with a method whose frame takes a + b n milliseconds and that refuses above `room` paths.
    fn search(a_ms: f64, b_ms: f64, room: usize) -> Found<usize> {
        let trial = |paths: usize| {
            Ok(if paths > room {
                Err("no memory".to_owned())
            } else {
                Ok((a_ms + b_ms * paths as f64, paths))
            })
        };
        SEARCH.run(Found::nothing(), || false, trial).unwrap()
    }

    #[test]
    fn the_most_paths_are_found_to_two_percent_in_few_trials() {
        for most in [
            300.0,
            7_000.0,
            16_100.0,
            225_000.0,
            1_020_350.0,
            3_900_000.0,
        ] {
            for a_ms in [0.0, 5.0, 16.0] {
                let found = search(a_ms, (SEARCH.target_ms - a_ms) / most, usize::MAX);
                let (paths, kept) = found.best.unwrap();
                assert_eq!(paths, kept);
                let error = (most - paths as f64) / most;
                assert!((-1e-9..=0.02).contains(&error), "{paths} of {most}, {a_ms}");
                assert_eq!(found.limit, Limit::FrameTime);
                assert!(
                    found.trials.len() <= 16,
                    "{most}, {a_ms}: {:?}",
                    found.trials
                );
            }
        }
    }

    #[test]
    fn a_method_that_is_never_too_slow_reaches_the_ceiling() {
        let found = search(1.0, 1e-9, usize::MAX);
        assert_eq!(found.best.unwrap().0, SEARCH.ceiling);
        assert_eq!(found.limit, Limit::Ceiling);
    }

    #[test]
    fn a_method_that_is_always_too_slow_has_no_answer() {
        let found = search(20.0, 1e-6, usize::MAX);
        assert_eq!((found.best, found.limit), (None, Limit::TooSlow));
        assert_eq!(found.trials.last().unwrap().paths, SEARCH.least);
    }

    #[test]
    fn lack_of_memory_is_told_from_lack_of_time() {
        let found = search(1.0, 1e-6, 500_000);
        let (paths, _) = found.best.unwrap();
        assert!((490_000..=500_000).contains(&paths), "{paths}");
        assert_eq!(found.limit, Limit::Refused);
        assert_eq!(found.reason.as_deref(), Some("no memory"));
        let nothing = search(1.0, 1e-6, 0);
        assert_eq!((nothing.best, nothing.limit), (None, Limit::Refused));
        // Refused at first, but then it was the time after all.
        let found = search(1.0, 5e-4, 40_000);
        assert_eq!((found.limit, found.reason), (Limit::FrameTime, None));
    }

    #[test]
    fn the_search_ends_in_time_and_on_cancel() {
        let trials = std::cell::Cell::new(0);
        let count = |paths: usize| {
            trials.set(trials.get() + 1);
            Ok(Ok((paths as f64 * 1e-5, ())))
        };
        let nothing = Found::nothing();
        let found = SEARCH.run(nothing, || trials.get() >= 2, count).unwrap();
        assert_eq!((found.trials.len(), found.limit), (2, Limit::Time));
        assert!(found.best.is_some());
        let nothing = Found::<()>::nothing();
        let cancelled = SEARCH.run(nothing, || false, |_| Err(RenderError::Cancelled));
        assert_eq!(cancelled, Err(RenderError::Cancelled));
    }

    #[test]
    fn a_search_that_goes_on_tries_nothing_twice() {
        let whole = search(1.0, 1e-6, 500_000);
        for cut in 0..=whole.trials.len() {
            let left = std::cell::Cell::new(cut);
            let trial = |paths: usize| {
                left.set(left.get().saturating_sub(1));
                Ok(if paths > 500_000 {
                    Err("no memory".to_owned())
                } else {
                    Ok((1.0 + 1e-6 * paths as f64, paths))
                })
            };
            let is_over = || left.get() == 0;
            let part = SEARCH.run(Found::nothing(), is_over, trial).unwrap();
            assert_eq!(part.trials, whole.trials[..cut]);
            assert_eq!(SEARCH.run(part, || false, trial).unwrap(), whole);
        }
    }

    #[test]
    fn times_that_jump_about_still_end_the_search() {
        let mut random = 1_u32;
        let noisy = |paths: usize| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let noise = 0.8 + 0.4 * f64::from(random >> 16) / 65_536.0;
            Ok(Ok((paths as f64 * 3e-5 * noise, ())))
        };
        let found = SEARCH.run(Found::nothing(), || false, noisy).unwrap();
        assert_eq!(found.limit, Limit::FrameTime);
        assert!(found.trials.len() < 30, "{:?}", found.trials);
    }
}
