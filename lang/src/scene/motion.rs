//! What moves from key to key.

/// The motion of a thing that has keys, in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Columns of a matrix: world from the frame in which its angles are, a rotation.
    pub frame: [[f64; 3]; 3],
    /// In order of time, two or more. Before the first and after the last it stands still.
    pub keys: Vec<MotionKey>,
}

impl Motion {
    /// Whether its angles change.
    #[must_use]
    pub fn turns(&self) -> bool {
        let differs = |a: &MotionKey, b: &MotionKey| {
            a.rotate.iter().zip(b.rotate).any(|(a, b)| (a - b).abs() > 0.0)
        };
        self.keys.windows(2).any(|pair| differs(&pair[0], &pair[1]))
    }
}

/// Where a thing is at some moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionKey {
    /// Seconds, relative to the frame.
    pub time: f64,
    /// Where its origin is, metres, world frame.
    pub at: [f64; 3],
    /// Turned about x, then y, then z, radians.
    pub rotate: [f64; 3],
}

/// Where a camera is at some moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    /// Seconds, relative to the frame.
    pub time: f64,
    /// As those of `Camera`.
    pub from: [f64; 3],
    /// As those of `Camera`.
    pub to: [f64; 3],
}

/// A list of keys, in order of time.
pub trait Keyed: Copy {
    /// When it is so.
    fn time(&self) -> f64;

    /// What lies between this one and `next`, `u` of the way, at `time`.
    #[must_use]
    fn between(&self, next: &Self, u: f64, time: f64) -> Self;
}

/// What `keys`, of which there is one at least, say of a moment: the keys before and after it interpolated, beyond the
/// first and the last one these.
///
/// # Panics
/// Without keys.
#[must_use]
pub fn at_time<K: Keyed>(keys: &[K], time: f64) -> K {
    let after = keys.partition_point(|key| key.time() <= time);
    match (after.checked_sub(1).map(|i| &keys[i]), keys.get(after)) {
        (Some(a), Some(b)) => a.between(b, (time - a.time()) / (b.time() - a.time()), time),
        (Some(last), None) => *last,
        (None, Some(first)) => *first,
        (None, None) => unreachable!("there are keys"),
    }
}

/// The moments at which the interpolation of keys bends, strictly between two moments.
pub fn bends<K: Keyed>(keys: &[K], open: f64, close: f64) -> impl Iterator<Item = f64> {
    keys.iter().map(Keyed::time).filter(move |time| *time > open && *time < close)
}

pub(crate) fn mixed(a: [f64; 3], b: [f64; 3], u: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * u)
}

impl Keyed for MotionKey {
    fn time(&self) -> f64 {
        self.time
    }

    fn between(&self, next: &Self, u: f64, time: f64) -> Self {
        Self { time, at: mixed(self.at, next.at, u), rotate: mixed(self.rotate, next.rotate, u) }
    }
}

impl Keyed for CameraKey {
    fn time(&self) -> f64 {
        self.time
    }

    fn between(&self, next: &Self, u: f64, time: f64) -> Self {
        Self { time, from: mixed(self.from, next.from, u), to: mixed(self.to, next.to, u) }
    }
}
