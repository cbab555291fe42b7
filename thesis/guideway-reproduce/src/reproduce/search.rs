//! Finds the most paths that a method draws within a frame time.
//!
//! The search first doubles (or halves) the count until it brackets the answer, then narrows the
//! bracket by interpolation (regula falsi) with every third step a bisection:
//!
//! ```text
//! within the target      beyond the target
//!   low ----------- guess ----------- high
//! ```
//!
//! It takes some 10 to 16 trials for a tolerance of 2 %.

use guideway_scene::RenderError;
use serde::{Deserialize, Serialize};

/// Target and range of the search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// Limit of the median frame time, in milliseconds.
    pub target_ms: f64,
    /// Paths of the first trial.
    pub start: usize,
    /// Fewest paths of a trial.
    pub least: usize,
    /// Most paths of a trial.
    pub ceiling: usize,
    /// Relative width of the bracket at which the search ends.
    pub tolerance: f64,
}

/// The reason why more paths are not possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Limit {
    /// With more paths, frames take too long.
    FrameTime,
    /// The count reached [`Search::ceiling`].
    Ceiling,
    /// Even [`Search::least`] paths take too long.
    TooSlow,
    /// The method refuses more paths, for example for lack of memory.
    Refused,
    /// The time limit ended the search.
    Time,
}

/// One trial of the search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Number of paths.
    pub paths: usize,
    /// Median frame time in milliseconds; `None` when the method refused.
    pub frame_ms: Option<f64>,
}

/// State and result of a search.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SearchState<T> {
    /// The most paths within the target, with their measurement.
    pub(crate) best: Option<(usize, T)>,
    /// Reason why more paths are not possible.
    pub(crate) limit: Limit,
    /// Error of the method that refused more paths.
    pub(crate) reason: Option<String>,
    /// All trials in order.
    pub(crate) trials: Vec<Trial>,
}

impl<T> SearchState<T> {
    /// The state before the first trial.
    pub(crate) fn nothing() -> Self {
        Self {
            best: None,
            limit: Limit::Time,
            reason: None,
            trials: Vec::new(),
        }
    }
}

/// Result of one trial.
pub(crate) enum TrialOutcome<T> {
    /// The method drew: median frame time in milliseconds, and the measurement.
    Drawn { frame_ms: f64, measurement: T },
    /// The method refused, for this reason.
    Refused { reason: String },
}

enum NextTrial {
    Measure(usize),
    End(Limit),
}

impl Search {
    /// Continues a search until it ends, or until `is_over`. `trial` measures a number of paths.
    ///
    /// # Errors
    /// When a trial fails, or the caller cancels.
    pub(crate) fn run<T>(
        &self,
        mut found: SearchState<T>,
        is_over: impl Fn() -> bool,
        mut trial: impl FnMut(usize) -> Result<TrialOutcome<T>, RenderError>,
    ) -> Result<SearchState<T>, RenderError> {
        found.limit = loop {
            let paths = match self.next(&found.trials) {
                NextTrial::Measure(_) if is_over() => break Limit::Time,
                NextTrial::Measure(paths) => paths,
                NextTrial::End(limit) => break limit,
            };
            let frame_ms = match trial(paths)? {
                TrialOutcome::Drawn {
                    frame_ms,
                    measurement,
                } => {
                    if frame_ms <= self.target_ms {
                        found.best = Some((paths, measurement));
                    }
                    Some(frame_ms)
                }
                TrialOutcome::Refused { reason } => {
                    found.reason = Some(reason);
                    None
                }
            };
            found.trials.push(Trial { paths, frame_ms });
        };
        // A search without time may continue and still end with the refusal.
        if !matches!(found.limit, Limit::Refused | Limit::Time) {
            found.reason = None;
        }
        Ok(found)
    }

    fn is_within(&self, frame_ms: Option<f64>) -> bool {
        frame_ms.is_some_and(|ms| ms <= self.target_ms)
    }

    fn next(&self, trials: &[Trial]) -> NextTrial {
        // The bracket: the last count within the target, and the last beyond it.
        let last = |is_low| {
            let mut own = trials
                .iter()
                .filter(|t| self.is_within(t.frame_ms) == is_low);
            own.next_back()
        };
        let low = last(true).and_then(|t| Some((t.paths, t.frame_ms?)));
        let high = last(false).map(|t| (t.paths, t.frame_ms));
        // Larger steps far from the target.
        let step = |nearness: f64| if nearness < 0.2 { 4 } else { 2 };
        match (low, high) {
            (None, None) => NextTrial::Measure(self.start.clamp(self.least, self.ceiling)),
            (Some((low, _)), None) if low >= self.ceiling => NextTrial::End(Limit::Ceiling),
            (Some((low, ms)), None) => {
                let next = low.saturating_mul(step(ms / self.target_ms));
                NextTrial::Measure(next.min(self.ceiling))
            }
            (None, Some((high, ms))) if high <= self.least => NextTrial::End(match ms {
                Some(_) => Limit::TooSlow,
                None => Limit::Refused,
            }),
            (None, Some((high, ms))) => {
                let nearness = ms.map_or(1.0, |ms| self.target_ms / ms);
                NextTrial::Measure((high / step(nearness)).max(self.least))
            }
            (Some((low, low_ms)), Some((high, high_ms))) => {
                let width = high.saturating_sub(low);
                if width <= 1 || width as f64 <= low as f64 * self.tolerance {
                    return NextTrial::End(match high_ms {
                        Some(_) => Limit::FrameTime,
                        None => Limit::Refused,
                    });
                }
                let fraction = match high_ms {
                    // Interpolate, because times grow almost linearly with paths; bisect every
                    // third step, in case they do not.
                    Some(high_ms) if !trials.len().is_multiple_of(3) && high_ms > low_ms => {
                        let guess = (self.target_ms - low_ms) / (high_ms - low_ms);
                        // Beyond the guess by part of the tolerance, so that both ends of the
                        // bracket move.
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
                NextTrial::Measure(next.clamp(low + 1, high - 1))
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

    fn drawn<T>(frame_ms: f64, measurement: T) -> TrialOutcome<T> {
        TrialOutcome::Drawn {
            frame_ms,
            measurement,
        }
    }

    fn refused<T>() -> TrialOutcome<T> {
        TrialOutcome::Refused {
            reason: "no memory".to_owned(),
        }
    }

    /// Searches with a method that takes a + b n milliseconds for n paths and refuses above
    /// `capacity`.
    fn search(a_ms: f64, b_ms: f64, capacity: usize) -> SearchState<usize> {
        let trial = |paths: usize| {
            Ok(if paths > capacity {
                refused()
            } else {
                drawn(a_ms + b_ms * paths as f64, paths)
            })
        };
        SEARCH.run(SearchState::nothing(), || false, trial).unwrap()
    }

    #[test]
    fn finds_the_most_paths_to_two_percent_in_sixteen_trials() {
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
    fn a_fast_method_reaches_the_ceiling() {
        let found = search(1.0, 1e-9, usize::MAX);
        assert_eq!(found.best.unwrap().0, SEARCH.ceiling);
        assert_eq!(found.limit, Limit::Ceiling);
    }

    #[test]
    fn a_slow_method_ends_at_the_fewest_paths() {
        let found = search(20.0, 1e-6, usize::MAX);
        assert_eq!((found.best, found.limit), (None, Limit::TooSlow));
        assert_eq!(found.trials.last().unwrap().paths, SEARCH.least);
    }

    #[test]
    fn distinguishes_refusal_from_frame_time() {
        let found = search(1.0, 1e-6, 500_000);
        let (paths, _) = found.best.unwrap();
        assert!((490_000..=500_000).contains(&paths), "{paths}");
        assert_eq!(found.limit, Limit::Refused);
        assert_eq!(found.reason.as_deref(), Some("no memory"));
        let nothing = search(1.0, 1e-6, 0);
        assert_eq!((nothing.best, nothing.limit), (None, Limit::Refused));
        // The first trial is refused, but a smaller one exceeds the frame time.
        let found = search(1.0, 5e-4, 40_000);
        assert_eq!((found.limit, found.reason), (Limit::FrameTime, None));
    }

    #[test]
    fn ends_at_the_time_limit_and_on_cancel() {
        let trials = std::cell::Cell::new(0);
        let count = |paths: usize| {
            trials.set(trials.get() + 1);
            Ok(drawn(paths as f64 * 1e-5, ()))
        };
        let nothing = SearchState::nothing();
        let found = SEARCH.run(nothing, || trials.get() >= 2, count).unwrap();
        assert_eq!((found.trials.len(), found.limit), (2, Limit::Time));
        assert!(found.best.is_some());
        let nothing = SearchState::<()>::nothing();
        let cancelled = SEARCH.run(nothing, || false, |_| Err(RenderError::Cancelled));
        assert_eq!(cancelled, Err(RenderError::Cancelled));
    }

    #[test]
    fn a_continued_search_repeats_no_trial() {
        let whole = search(1.0, 1e-6, 500_000);
        for cut in 0..=whole.trials.len() {
            let left = std::cell::Cell::new(cut);
            let trial = |paths: usize| {
                left.set(left.get().saturating_sub(1));
                Ok(if paths > 500_000 {
                    refused()
                } else {
                    drawn(1.0 + 1e-6 * paths as f64, paths)
                })
            };
            let is_over = || left.get() == 0;
            let part = SEARCH.run(SearchState::nothing(), is_over, trial).unwrap();
            assert_eq!(part.trials, whole.trials[..cut]);
            assert_eq!(SEARCH.run(part, || false, trial).unwrap(), whole);
        }
    }

    #[test]
    fn noisy_times_still_end_the_search() {
        let mut random = 1_u32;
        let noisy = |paths: usize| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let noise = 0.8 + 0.4 * f64::from(random >> 16) / 65_536.0;
            Ok(drawn(paths as f64 * 3e-5 * noise, ()))
        };
        let found = SEARCH.run(SearchState::nothing(), || false, noisy).unwrap();
        assert_eq!(found.limit, Limit::FrameTime);
        assert!(found.trials.len() < 30, "{:?}", found.trials);
    }
}
