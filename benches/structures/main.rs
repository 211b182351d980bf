//! Scene structures and other programs, scene by scene: tables in Markdown.
//!
//! `cargo bench -p spherule-benches --bench structures`, with `--features embree` where the system
//! has libembree3. After `--`: `--scene NAME` for one scene, `--quick` for few rounds.

mod bvh_tree;
mod obvhs_tree;
mod parry_tree;

use bvh_tree::Binary;
use obvhs_tree::Obvhs;
use parry_tree::Parry;
use spherule_benches::scenes::{Name, Size};
use spherule_benches::structures::contender::{Contender, question_name};
use spherule_benches::structures::measure::{self, QUESTIONS};
use spherule_benches::structures::peer::builder;
use spherule_kernel::dispatch::Level;

fn main() {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let asked = |option: &str| arguments.iter().any(|argument| argument == option);
    let only = arguments.iter().position(|argument| argument == "--scene");
    let only = only.and_then(|index| arguments.get(index + 1));
    let (size, rounds) = match (asked("--test"), asked("--quick")) {
        (true, _) => (Size::SMALL, 1),
        (_, true) => (Size::FULL, 3),
        _ => (Size::FULL, 9),
    };
    let peers = [builder::<Obvhs>(), builder::<Binary>(), builder::<Parry>()];
    let levels = [Level::best()];
    for name in Name::ALL {
        if only.is_some_and(|only| only != name.as_str()) {
            continue;
        }
        let (tree, measured) = measure::scene(&name.scene(size), &levels, &peers, rounds);
        println!("\n{}: {:.1} bytes a sphere, depth {}", name.as_str(), tree.bytes, tree.depth);
        for measured in measured {
            for question in QUESTIONS {
                println!("  {}, {}", measured.kind.as_str(), question_name(question));
                let best = measured.fastest(question, Contender::is_embree);
                for &contender in &measured.contenders {
                    let rate = measured.rate(contender, question);
                    let ratio = best.map(|best| {
                        let ratio = measured.times_as_fast(contender, best, question);
                        format!("{:6.2} [{:.2}, {:.2}]", ratio.middle, ratio.low, ratio.high)
                    });
                    println!("    {contender:40} {rate:8.2} {}", ratio.unwrap_or_default());
                }
            }
            for (contender, agreement) in &measured.agreements {
                println!("    {contender}: {agreement:?}");
            }
        }
    }
}
