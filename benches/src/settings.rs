//! How criterion takes its time: a full run of all groups in a few minutes.

use criterion::Criterion;
use std::time::Duration;

/// Short, without plots, and quiet about changes that neighbours on the machine can cause.
#[must_use]
pub fn settings() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .nresamples(10_000)
        .noise_threshold(0.10)
        .significance_level(0.01)
        .without_plots()
        .configure_from_args()
}
