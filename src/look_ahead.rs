//! How far ahead of the beam lines must be drawn, from what they cost.

/// How the lines of a picture keep a line period, all known from their costs: before the first one is sent.
///
/// ```
/// use beamshade::Schedule;
///
/// // The third line takes two and a half periods: it must be begun three ahead, and then is there before the first goes out.
/// let schedule = Schedule::new([50, 50, 250, 50, 50, 50].into_iter(), 100);
/// assert_eq!(schedule, Schedule { worst: 250, total: 500, slack: 100, look_ahead: 3 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// What the dearest line takes.
    pub worst: u32,
    /// What all lines take.
    pub total: u64,
    /// What is left of the time in which all lines are sent; negative if that is too short, so that no frame can follow the
    /// other at once.
    pub slack: i64,
    /// The smallest K with which no line is late: rows that hold lines drawn ahead, beside the one that is sent.
    ///
    /// The first K lines are there when the first one goes out. From then on each line that goes out leaves its row to the one K
    /// lines below, which is drawn as soon as the row is free and those above are ready, and must be ready when it is its turn.
    pub look_ahead: u32,
}

impl Schedule {
    /// For lines that take that long, from the first to the last, and a line period, at least 1, in the same unit.
    #[must_use]
    pub fn new(costs: impl Iterator<Item = u32> + Clone, period: u32) -> Self {
        let period = u64::from(period.max(1));
        let (mut worst, mut total, mut lines) = (0, 0_u64, 0_u32);
        for cost in costs.clone() {
            (worst, total, lines) = (worst.max(cost), total.saturating_add(cost.into()), lines.saturating_add(1));
        }
        let slack = i128::from(lines) * i128::from(period) - i128::from(total);
        // Each line more helps, and all of them are enough.
        let look_ahead = (0..lines).find(|ahead| keeps(costs.clone(), period, *ahead)).unwrap_or(lines);
        Self { worst, total, slack: slack.clamp(i64::MIN.into(), i64::MAX.into()) as i64, look_ahead }
    }
}

/// Whether so many lines ahead are enough.
fn keeps(costs: impl Iterator<Item = u32>, period: u64, ahead: u32) -> bool {
    // Since line y − `ahead` went out, when the row of line y is free: until the line above is ready.
    let mut busy = 0_u64;
    for cost in costs.skip(ahead as usize) {
        busy = busy.saturating_add(cost.into());
        if busy > period.saturating_mul(ahead.into()) {
            return false;
        }
        busy = busy.saturating_sub(period);
    }
    true
}
