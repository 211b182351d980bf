//! How fast the pictures come.

use std::time::{Duration, Instant};

/// How long figures stay the same: those that change with every frame cannot be read, and cost
/// bytes.
const WINDOW: Duration = Duration::from_millis(250);

/// What one frame took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    /// From scene to cells.
    pub(super) drawing: Duration,
    /// From scene to bytes.
    pub(super) making: Duration,
    pub(super) rays: u64,
    pub(super) bytes: usize,
    /// How long the terminal's last answer took, from the end of its frame.
    pub(super) round_trip: Option<Duration>,
}

/// Means over the last frames; zero before the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Figures {
    /// `None` while frames come one by one.
    pub(super) frames_per_second: Option<f64>,
    pub(super) milliseconds: f64,
    pub(super) megarays_per_second: f64,
    pub(super) bytes: usize,
    /// How long the terminal's last answer took, from the end of its frame.
    pub(super) round_trip: Option<Duration>,
}

/// Adds frames up until there is something new to say.
#[derive(Debug, Default)]
pub(super) struct Meter {
    since: Option<Instant>,
    last: Option<Instant>,
    frames: u32,
    sum: Frame,
    figures: Figures,
}

impl Meter {
    /// Counts a frame that began at `now`. What there is to show changes with the first frame
    /// after a pause, and then once a window.
    pub(super) fn count(&mut self, frame: Frame, now: Instant) -> Figures {
        let after_a_pause = self.last.is_none_or(|last| now - last > WINDOW);
        self.last = Some(now);
        if after_a_pause {
            self.figures = means(&frame, 1);
            self.restart(now);
            return self.figures;
        }
        self.frames += 1;
        self.sum.drawing += frame.drawing;
        self.sum.making += frame.making;
        self.sum.rays += frame.rays;
        self.sum.bytes += frame.bytes;
        self.sum.round_trip = frame.round_trip;
        let elapsed = self.since.map_or(Duration::ZERO, |since| now - since);
        if elapsed >= WINDOW {
            let rate = f64::from(self.frames) / elapsed.as_secs_f64();
            self.figures =
                Figures { frames_per_second: Some(rate), ..means(&self.sum, self.frames) };
            self.restart(now);
        }
        self.figures
    }

    /// What there is to show without another frame.
    pub(super) fn figures(&self) -> Figures {
        self.figures
    }

    fn restart(&mut self, now: Instant) {
        self.since = Some(now);
        self.frames = 0;
        self.sum = Frame::default();
    }
}

fn means(sum: &Frame, frames: u32) -> Figures {
    let drawing = sum.drawing.as_secs_f64();
    Figures {
        frames_per_second: None,
        milliseconds: 1e3 * sum.making.as_secs_f64() / f64::from(frames),
        megarays_per_second: if drawing > 0.0 { sum.rays as f64 / drawing / 1e6 } else { 0.0 },
        bytes: sum.bytes / frames as usize,
        round_trip: sum.round_trip,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame {
        drawing: Duration::from_millis(2),
        making: Duration::from_millis(3),
        rays: 4000,
        bytes: 500,
        round_trip: None,
    };

    #[test]
    fn a_single_frame_has_no_rate() {
        let figures = Meter::default().count(FRAME, Instant::now());
        assert_eq!(figures.frames_per_second, None);
        assert!((figures.milliseconds - 3.0).abs() < 1e-9);
        assert!((figures.megarays_per_second - 2.0).abs() < 1e-9);
        assert_eq!(figures.bytes, 500);
    }

    #[test]
    fn a_steady_rate_is_told_once_a_window() {
        let mut meter = Meter::default();
        let start = Instant::now();
        let mut shown = Vec::new();
        for frame in 0..=50 {
            shown.push(meter.count(FRAME, start + frame * Duration::from_millis(20)));
        }
        let rate = shown[50].frames_per_second.expect("frames came steadily");
        assert!((rate - 50.0).abs() < 1e-6, "{rate}");
        shown.dedup();
        assert!(shown.len() <= 5, "{shown:?}");
    }

    #[test]
    fn a_pause_is_not_a_low_rate() {
        let mut meter = Meter::default();
        let start = Instant::now();
        meter.count(FRAME, start);
        let figures = meter.count(FRAME, start + Duration::from_secs(5));
        assert_eq!(figures.frames_per_second, None);
    }
}
