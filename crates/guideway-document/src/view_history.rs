//! View history: back and forward through recent places, as in a browser.

/// Recent places and the present one; at most [`ViewHistory::MAX_PLACES`].
#[derive(Clone, Debug)]
pub struct ViewHistory<T> {
    places: Vec<T>,
    current: usize,
}

impl<T: Clone + PartialEq> ViewHistory<T> {
    /// Most places remembered; the oldest is forgotten first.
    pub const MAX_PLACES: usize = 200;

    /// A history that starts at `place`.
    pub fn new(place: T) -> Self {
        Self {
            places: vec![place],
            current: 0,
        }
    }

    /// Moves to a place and forgets all places that [`Self::forward`] would return to. Moving to
    /// the present place does nothing.
    pub fn go(&mut self, place: T) {
        if self.places[self.current] == place {
            return;
        }
        self.places.truncate(self.current + 1);
        self.places.push(place);
        if self.places.len() > Self::MAX_PLACES {
            self.places.remove(0);
        }
        self.current = self.places.len() - 1;
    }

    /// Moves one place back and returns it; `None` at the oldest place.
    pub fn back(&mut self) -> Option<T> {
        self.current = self.current.checked_sub(1)?;
        Some(self.places[self.current].clone())
    }

    /// Moves one place forward and returns it; `None` at the newest place.
    pub fn forward(&mut self) -> Option<T> {
        let place = self.places.get(self.current + 1)?;
        self.current += 1;
        Some(place.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn back_and_forward_retrace_the_visited_places() {
        let mut history = ViewHistory::new(0);
        history.go(1);
        history.go(1);
        history.go(2);
        assert_eq!(history.back(), Some(1));
        assert_eq!(history.back(), Some(0));
        assert_eq!(history.back(), None);
        assert_eq!(history.forward(), Some(1));
        history.go(3);
        assert_eq!(history.forward(), None);
        assert_eq!(history.back(), Some(1));
    }

    #[test]
    fn forgets_the_oldest_places_beyond_the_limit() {
        let mut history = ViewHistory::new(0);
        (1..10_000).for_each(|place| history.go(place));
        let steps = std::iter::from_fn(|| history.back()).count();
        assert_eq!(steps, ViewHistory::<i32>::MAX_PLACES - 1);
    }
}
