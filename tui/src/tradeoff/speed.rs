//! How fast the tiers are, in turns: the clock and the neighbours of a machine change from second
//! to second, and so they change for all tiers alike.

use std::time::{Duration, Instant};

/// How long the tiers are timed for, together, unless a round takes longer.
const LONG_ENOUGH: Duration = Duration::from_millis(1500);
/// The fewest rounds and the most, after one that is thrown away.
const ROUNDS: (usize, usize) = (5, 501);

/// The median of the seconds that each of `passes` takes. Before every pass `go_on` gets the share done; it ends the
/// measurement with `None`.
pub(super) fn medians<const N: usize>(
    mut passes: [impl FnMut(); N],
    mut go_on: impl FnMut(f64) -> Option<()>,
) -> Option<[f64; N]> {
    let mut seconds = [const { Vec::new() }; N];
    let start = Instant::now();
    for round in 0..=ROUNDS.1 {
        let spent = start.elapsed().as_secs_f64() / LONG_ENOUGH.as_secs_f64();
        if round > ROUNDS.0 && spent >= 1.0 {
            break;
        }
        for (index, (seconds, pass)) in seconds.iter_mut().zip(passes.iter_mut()).enumerate() {
            // Whichever of time and rounds ends it.
            let rounds = round as f64 + index as f64 / N as f64;
            let by_rounds = rounds / ROUNDS.1 as f64;
            go_on(spent.min(rounds / (ROUNDS.0 + 1) as f64).max(by_rounds).min(1.0))?;
            let start = Instant::now();
            pass();
            let elapsed = start.elapsed().as_secs_f64();
            if round > 0 {
                seconds.push(elapsed);
            }
        }
    }
    Some(seconds.map(|mut seconds| {
        seconds.sort_by(f64::total_cmp);
        seconds.get(seconds.len() / 2).copied().unwrap_or(f64::NAN)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread::sleep;

    #[test]
    fn every_pass_is_timed_by_itself() {
        let mut counts = [0_usize; 2];
        let [slow_count, quick_count] = &mut counts;
        let mut slow = || {
            *slow_count += 1;
            sleep(Duration::from_millis(30));
        };
        let mut quick = || *quick_count += 1;
        let mut last = 0.0;
        let times = medians([&mut slow as &mut dyn FnMut(), &mut quick], |share| {
            assert!(share >= last && share <= 1.0);
            last = share;
            Some(())
        });
        let [slow_time, quick_time] = times.expect("it is not ended");
        assert!(slow_time >= 0.03 && quick_time < slow_time);
        assert!(counts[0] == counts[1] && counts[0] > ROUNDS.0);
    }
    /// The pass that is running is the last.
    #[test]
    fn it_ends_between_two_passes() {
        let (mut passes, mut words) = ([0_usize; 2], 0);
        let [one, other] = &mut passes;
        let mut one = || *one += 1;
        let mut other = || *other += 1;
        let times = medians([&mut one as &mut dyn FnMut(), &mut other], |_| {
            words += 1;
            (words < 4).then_some(())
        });
        assert_eq!((times, words, passes), (None, 4, [2, 1]));
    }
}
