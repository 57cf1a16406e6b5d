//! What the levels of one wall, record and model came to.

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Intensity the record was scaled to \[m/s²\].
    pub intensity: f64,
    /// Largest |u|/`u_ins`; of an overturned wall where its run stopped.
    pub demand: f64,
    /// Time of overturning from the start of the record \[s\].
    pub overturning: Option<f64>,
}

/// Where a demand is first exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Occurrence {
    /// At this intensity \[m/s²\].
    At(f64),
    /// Not up to this intensity, the highest that was run \[m/s²\]: a censored record.
    Above(f64),
}

/// The levels of one wall, record and model, in rising order.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    levels: Vec<Level>,
}

impl Curve {
    /// A curve from its levels in any order.
    #[must_use]
    pub fn new(mut levels: Vec<Level>) -> Self {
        levels.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
        Self { levels }
    }

    /// The levels, in rising order.
    #[must_use]
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Place of the lowest level at which the wall overturned.
    fn first_overturning(&self) -> Option<usize> {
        self.levels.iter().position(|level| level.overturning.is_some())
    }

    /// The collapse intensity: the lowest level at which the wall overturned.
    #[must_use]
    pub fn collapse(&self) -> Occurrence {
        match self.first_overturning() {
            Some(index) => Occurrence::At(self.levels[index].intensity),
            None => Occurrence::Above(self.top()),
        }
    }

    /// The highest level below the collapse, 0 if there is none: the collapse lies between the two \[m/s²\].
    #[must_use]
    pub fn standing(&self) -> f64 {
        let index = self.first_overturning().unwrap_or(self.levels.len());
        index.checked_sub(1).map_or(0.0, |below| self.levels[below].intensity)
    }

    /// Levels above the collapse at which the wall stood: resurrections. Overturning is not monotonic in the intensity.
    #[must_use]
    pub fn resurrections(&self) -> usize {
        let first = self.first_overturning().unwrap_or(self.levels.len());
        self.levels[first..].iter().filter(|level| level.overturning.is_none()).count()
    }

    /// Where |u| first exceeds a `fraction` of `u_ins`: between two standing levels by a straight line, at the level itself
    /// where the wall overturns or where `at_levels` asks for it; at the collapse for a fraction of 1 and more.
    #[must_use]
    pub fn exceedance(&self, fraction: f64, at_levels: bool) -> Occurrence {
        let mut before = [0.0, 0.0];
        for level in &self.levels {
            let exceeded = level.overturning.is_some() || (fraction < 1.0 && level.demand > fraction);
            if exceeded && (at_levels || level.overturning.is_some()) {
                return Occurrence::At(level.intensity);
            }
            if exceeded {
                let [intensity, demand] = before;
                let part = (fraction - demand) / (level.demand - demand);
                return Occurrence::At(intensity + part * (level.intensity - intensity));
            }
            before = [level.intensity, level.demand];
        }
        Occurrence::Above(self.top())
    }

    /// |u|/`u_ins` at an intensity, by straight lines between levels from the origin on; infinite from the collapse on.
    /// `None` above the levels of a wall that stood.
    #[must_use]
    pub fn demand(&self, intensity: f64) -> Option<f64> {
        let mut before = [0.0, 0.0];
        for level in &self.levels {
            if level.overturning.is_some() {
                let standing = intensity <= before[0];
                return Some(if standing { before[1] } else { f64::INFINITY });
            }
            if intensity <= level.intensity {
                let part = (intensity - before[0]) / (level.intensity - before[0]);
                return Some(before[1] + part * (level.demand - before[1]));
            }
            before = [level.intensity, level.demand];
        }
        None
    }

    /// The highest level \[m/s²\].
    #[must_use]
    pub fn top(&self) -> f64 {
        self.levels.last().map_or(0.0, |level| level.intensity)
    }
}
