//! Floors and walls in time: values at the samples of the record, and peaks at all communication points.

use rocking_wall::solver::reported_peak;
use rocking_wall::wall::Wall;
use scene::response::Fate;

/// A largest absolute value, and when it came.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// The value, with its sign.
    pub value: f64,
    /// Its time \[s\].
    pub time: f64,
}

impl Peak {
    pub(crate) fn add(&mut self, value: f64, time: f64) {
        if value.abs() > self.value.abs() {
            *self = Self { value, time };
        }
    }
}

/// A quantity over time, and its peak at all communication points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Values at the times of the [`Coupled`](crate::Coupled) run.
    pub values: Vec<f64>,
    /// Largest value at any communication point.
    pub peak: Peak,
}

impl History {
    pub(crate) fn add(&mut self, value: f64, time: f64, is_shown: bool) {
        self.peak.add(value, time);
        if is_shown {
            self.values.push(value);
        }
    }
}

/// A storey in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloorHistory {
    /// Absolute acceleration \[m/s²\].
    pub acceleration: History,
    /// Displacement relative to what it stands on: the drift \[m\].
    pub drift: History,
}

/// A wall in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallHistory {
    /// u \[m\].
    pub displacement: History,
    /// u/`u_ins` of its side (-).
    pub ratio: History,
    /// Force of the bottom support on the wall \[N\].
    pub reaction_bottom: History,
    /// Force of the top support on the wall \[N\]; 0 for a parapet.
    pub reaction_top: History,
    /// Largest |u| between the communication points too \[m\].
    pub largest: f64,
    /// When it overturned \[s\].
    pub overturn_time: Option<f64>,
    /// Plastic elongation of its tie at the end, the larger one of two \[m\].
    pub tie_elongation: f64,
    /// When a tie first broke \[s\].
    pub tie_break_time: Option<f64>,
}

impl WallHistory {
    /// Returns the wall's overturning and whether it falls, from its history at the times of the run \[s\].
    pub fn fate(&self, times: &[f64]) -> Fate {
        Fate::of(self.overturn_time, times.iter().copied().zip(self.ratio.values.iter().copied()))
    }

    /// Returns the peak of u \[m\], and the largest |u| \[m\] and |u|/`u_ins`, as results report them.
    pub fn reported(&self, wall: &Wall, times: &[f64]) -> (Peak, [f64; 2]) {
        let u_ins = wall.body().instability;
        let (peak, falls) = (self.displacement.peak, self.fate(times).falling());
        let end = self.displacement.values.last().copied().unwrap_or_default();
        let own = [self.largest, self.largest / u_ins.of(peak.value)];
        let reported = reported_peak(own, u_ins.of(end), falls.is_some());
        (falls.map_or(peak, |time| Peak { value: reported[0].copysign(end), time }), reported)
    }
}
