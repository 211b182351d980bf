//! Tables and charts: see the crate's documentation.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    spherule_benches::report()
}
