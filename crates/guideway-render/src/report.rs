use std::fmt;

/// What became of every path, and where the time went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Name of the method.
    pub method: &'static str,
    /// Paths of the input.
    pub total: u64,
    /// Paths that may have left a mark: not proven to be outside the view.
    pub drawn: u64,
    /// Paths proven to be outside the view.
    pub culled: u64,
    /// Paths that the scene hides, such as those of other levels.
    pub hidden: u64,
    /// Paths that cannot be drawn; the layout names each with its reason.
    pub refused: u64,
    /// Stages in order, with their time.
    pub stages: Vec<Stage>,
    /// Lines that curves were turned into.
    pub lines: u64,
    /// Most bytes that the method held beside the scene and the frame.
    pub peak_bytes: u64,
    /// Bands that the picture was drawn in; more than one where the budget did not hold all at once.
    pub bands: u32,
}

/// One stage of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// What it does.
    pub name: &'static str,
    /// How long it took.
    pub elapsed_ms: f64,
}

impl Report {
    /// Whether drawn + culled + hidden + refused = total: nothing was lost.
    pub fn accounts_for_all(&self) -> bool {
        self.drawn + self.culled + self.hidden + self.refused == self.total
    }

    /// Time of all stages.
    pub fn elapsed_ms(&self) -> f64 {
        self.stages.iter().map(|s| s.elapsed_ms).sum()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} paths drawn by {}",
            self.drawn, self.total, self.method
        )?;
        for (count, what) in [
            (self.culled, "outside the view"),
            (self.hidden, "hidden"),
            (self.refused, "refused"),
        ] {
            if count > 0 {
                write!(f, ", {count} {what}")?;
            }
        }
        write!(f, ", in {:.1} ms", self.elapsed_ms())
    }
}
