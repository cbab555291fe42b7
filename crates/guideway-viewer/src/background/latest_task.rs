//! The result for the latest subject of a task: computed anew once the subject is another one.

use guideway_layout::UserError;

use super::{BackgroundTask, RepaintHandle};

/// The last result with its subject, and the task that computes the next one.
pub(crate) struct LatestTask<K, T> {
    result: Option<(K, T)>,
    task: Option<(K, BackgroundTask<T>)>,
}

impl<K, T> Default for LatestTask<K, T> {
    fn default() -> Self {
        Self {
            result: None,
            task: None,
        }
    }
}

impl<K: PartialEq, T: Send + 'static> LatestTask<K, T> {
    /// The last result and its subject, which may be out of date.
    pub(crate) fn result(&self) -> Option<(&K, &T)> {
        self.result.as_ref().map(|(key, result)| (key, result))
    }

    pub(crate) fn is_busy(&self) -> bool {
        self.task.is_some()
    }

    /// Takes the result of a finished task; `failed` makes one if the task panicked.
    pub(crate) fn take_finished(&mut self, failed: impl FnOnce(UserError) -> T) {
        if let Some((_, task)) = &self.task
            && let Some(result) = task.result()
        {
            let result = result.unwrap_or_else(failed);
            self.result = self.task.take().map(|(key, _)| (key, result));
        }
    }

    /// Returns `true` if a subject has no result, and no task delays its own.
    pub(crate) fn is_due(&self, key: &K) -> bool {
        self.task.is_none() && self.result.as_ref().is_none_or(|(done, _)| done != key)
    }

    /// Starts the task of a subject; the window repaints when it ends.
    pub(crate) fn start(
        &mut self,
        key: K,
        repaint: &RepaintHandle,
        work: impl FnOnce() -> T + Send + 'static,
    ) {
        self.task = Some((key, BackgroundTask::start(repaint, work)));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;
    use std::time::Duration;

    use super::*;

    /// Takes the result of the task, once it ends.
    fn end(latest: &mut LatestTask<u32, Result<u32, String>>) {
        for _ in 0..10_000 {
            latest.take_finished(|error| Err(error.message));
            if !latest.is_busy() {
                return;
            }
            thread::sleep(Duration::from_millis(1));
        }
        panic!("the task does not end");
    }

    #[test]
    fn old_result_stays_until_that_of_the_next_subject() {
        let repaint: RepaintHandle = Arc::new(|| {});
        let mut latest = LatestTask::default();
        assert!(latest.is_due(&1) && latest.result().is_none());
        latest.start(1, &repaint, || Ok(10));
        assert!(latest.is_busy() && !latest.is_due(&2));
        end(&mut latest);
        assert_eq!(latest.result(), Some((&1, &Ok(10))));
        assert!(latest.is_due(&2) && !latest.is_due(&1));
        latest.start(2, &repaint, || panic!("a bug"));
        assert_eq!(latest.result(), Some((&1, &Ok(10))));
        end(&mut latest);
        assert!(matches!(latest.result(), Some((2, Err(_)))));
    }
}
