//! How much of the machine's arithmetic brute force reaches: a table in Markdown.
//!
//! `cargo bench -p spherule-benches --bench limit`, and once more with
//! `RUSTFLAGS="-C target-cpu=native"`. What the probes mean stands in [`spherule_benches::probe`].
//! The aims, on a native build at 64 spheres, 16 lanes, camera rays: `Fast` at 0.8 of the FMA
//! limit or more, `Stable` at 1.3 times the time of `Fast` or less.

use spherule_benches::check::{self, Tolerance};
use spherule_benches::probe::{self, FILTER, TEXTBOOK};
use spherule_benches::rounds::{self, Median, Samples, Subject};
use spherule_benches::workload::{Cloud, Kind, RAYS, packets};
use spherule_kernel::{
    Accuracy, Exact, Fast, HitPacket, Lanes, Spheres, Stable, f32x4, f32x8, f32x16, nearest,
};

const COUNTS: [usize; 2] = [64, 1024];
/// Brute force's lanes.
type Wide = f32x16;

fn main() {
    let quick = std::env::args().any(|argument| argument == "--test");
    let (rounds, work) = if quick { (3, 1) } else { (101, 40) };

    let rays = Kind::ALL.map(Kind::rays);
    let clouds = COUNTS.map(Cloud::new);
    let mut subjects = vec![
        fused::<f32x4>(work),
        fused::<f32x8>(work),
        fused::<f32x16>(work),
        mix::<f32x4>(work),
        mix::<f32x8>(work),
        mix::<f32x16>(work),
    ];
    for cloud in &clouds {
        for (kind, rays) in Kind::ALL.into_iter().zip(&rays) {
            let truth = check::reference(rays, &cloud.list());
            let mut add = |subject| subjects.push(subject);
            add(brute::<Fast>(kind, rays, cloud, &truth, Tolerance::TEXTBOOK, work));
            add(brute::<Stable>(kind, rays, cloud, &truth, Tolerance::CLOSEST_POINT, work));
            add(brute::<Exact>(kind, rays, cloud, &truth, Tolerance::EXACT, work));
        }
    }
    let samples = rounds::take(&mut subjects, rounds);
    print(&samples, rounds);
}

fn fused<'a, L: Lanes<Token = ()>>(work: usize) -> Subject<'a> {
    Subject::new(format!("fused {}", L::COUNT), move || probe::fused::<L>(500 * work))
}

fn mix<'a, L: Lanes<Token = ()>>(work: usize) -> Subject<'a> {
    Subject::new(format!("mix {}", L::COUNT), move || probe::mix::<L>(125 * work))
}

/// Brute force over as many tests for every list: about 16 thousand packets and spheres a unit of
/// work.
fn brute<'a, A: Accuracy + 'a>(
    kind: Kind,
    rays: &[spherule_kernel::Ray],
    cloud: &'a Cloud,
    truth: &[Option<(f64, u32)>],
    tolerance: Tolerance,
    work: usize,
) -> Subject<'a> {
    let spheres: Spheres<'a> = cloud.spheres();
    let name = subject_name(A::NAME, kind, spheres.len());
    check::same_bits::<A, Wide>(rays, spheres);
    check::near_reference(&name, &check::kernel_hits::<A, Wide>(rays, spheres), truth, tolerance);

    let passes = (work * 64).div_ceil(spheres.len());
    let packets = packets::<Wide>(rays);
    let mut hits = vec![HitPacket::<f32x16>::none(); packets.len()];
    Subject::new(name, move || {
        for _ in 0..passes {
            nearest::<A, Wide>((), &packets, spheres, &mut hits);
            std::hint::black_box(&hits);
        }
        passes * RAYS * spheres.len()
    })
}

fn subject_name(tier: &str, kind: Kind, spheres: usize) -> String {
    format!("{tier} {} {spheres}", kind.name())
}

/// The best of the widths is the peak: a plain build has no register of 16 lanes.
fn quickest(samples: &Samples, probe: &str) -> String {
    let names = [4, 8, 16].map(|lanes| format!("{probe} {lanes}"));
    let by_median = |name: &String| samples.median(name).middle;
    names.into_iter().min_by(|a, b| by_median(a).total_cmp(&by_median(b))).unwrap_or_default()
}

fn print(samples: &Samples, rounds: usize) {
    let (peak, mixed) = (quickest(samples, "fused"), quickest(samples, "mix"));
    let fused = if cfg!(target_feature = "fma") { "fused" } else { "product and sum" };
    println!("Medians of {rounds} interleaved rounds [quartiles]; ns a lane operation or test.\n");
    println!("| probe, lanes | ns | 10^9 a second |\n|---|---|---|");
    for (probe, what) in [("fused", fused), ("mix", "operations of a test")] {
        for lanes in [4, 8, 16] {
            let time = samples.median(&format!("{probe} {lanes}"));
            let rate = 1.0 / time.middle;
            println!("| {what}, {lanes} | {} | {rate:.1} |", three(time, 4));
        }
    }
    let limit = TEXTBOOK * samples.median(&peak).middle;
    let own = FILTER * samples.median(&peak).middle;
    println!("\nFMA limit of a textbook test = {TEXTBOOK} x `{peak}` = {limit:.4} ns.");
    println!("Floor of the kernel's own filter = {FILTER} x `{peak}` = {own:.4} ns.\n");
    println!(
        "| tier | rays | spheres | ns a test | least | share of the FMA limit | of the own floor | of `{mixed}` | time of fast |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    for spheres in COUNTS {
        for kind in Kind::ALL {
            let fast = subject_name(Fast::NAME, kind, spheres);
            for tier in [Fast::NAME, Stable::NAME, Exact::NAME] {
                let name = subject_name(tier, kind, spheres);
                let slots = samples.ratio(&peak, &name);
                println!(
                    "| {tier} | {} | {spheres} | {} | {:.4} | {} | {} | {} | {} |",
                    kind.name(),
                    three(samples.median(&name), 4),
                    samples.least(&name),
                    three(scaled(slots, TEXTBOOK), 2),
                    three(scaled(slots, FILTER), 2),
                    three(samples.ratio(&mixed, &name), 2),
                    three(samples.ratio(&name, &fast), 2),
                );
            }
        }
    }
}

fn scaled(median: Median, factor: f64) -> Median {
    Median { low: median.low * factor, middle: median.middle * factor, high: median.high * factor }
}

fn three(Median { low, middle, high }: Median, digits: usize) -> String {
    format!("{middle:.digits$} [{low:.digits$}, {high:.digits$}]")
}
