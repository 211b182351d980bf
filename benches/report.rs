//! Speed against error of every tier, lane width and regime, as Markdown and as a plot.
//!
//! ```text
//! cargo bench -p spherule-benches --bench report                # prints
//! cargo bench -p spherule-benches --bench report -- --write     # and writes into benches/report
//! cargo bench -p spherule-benches --bench report -- --test      # one short round, checks only
//! ```
//!
//! and once more with `RUSTFLAGS="-C target-cpu=native"`: `report.md` keeps a section for every
//! build. What is measured, and how, stands in [`spherule_benches::report`].

use spherule_benches::report::contender::contenders;
use spherule_benches::report::machine::Machine;
use spherule_benches::report::{dominance, error, page, plot, speed, target};
use std::path::Path;
use std::time::Duration;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked = |option: &str| std::env::args().any(|argument| argument == option);
    let (quick, write) = (asked("--test"), asked("--write"));
    let (cases, rounds, at_least) = if quick {
        (300, 1, Duration::from_micros(1))
    } else {
        (50_000, 101, Duration::from_micros(400))
    };

    let machine = Machine::this();
    let contenders = contenders();
    eprintln!("error: {cases} cases a regime");
    let errors = error::measure(&contenders, cases);
    for entry in &errors {
        let differing = entry.differing;
        assert!(!quick || differing == 0, "{}: {differing} answers depend on lanes", entry.name);
    }
    eprintln!("speed: {rounds} rounds");
    let speed = speed::measure(&contenders, rounds, at_least);
    let targets = target::targets(&contenders, &speed);
    let rivalries = dominance::rivalries(&contenders, &errors, &speed);

    let of_error = page::errors(&machine, &errors);
    let of_speed = page::speed(&machine, &contenders, &speed, &targets, &rivalries, &errors);
    let picture = plot::svg(&machine, &contenders, &errors, &speed)?;
    println!("{of_error}\n{of_speed}");

    if write && !quick {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("report");
        std::fs::create_dir_all(&folder)?;
        let build = machine.build();
        std::fs::write(folder.join(format!("{build}.svg")), picture)?;
        let path = folder.join("report.md");
        let before = std::fs::read_to_string(&path).unwrap_or_default();
        let after = page::replaced(&before, "error", &of_error);
        std::fs::write(path, page::replaced(&after, &format!("speed, {build}"), &of_speed))?;
    }
    Ok(())
}
