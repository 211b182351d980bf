//! The stations of the lecture, in its order.

mod algebraic;
mod first_picture;
mod geometric;
mod illumination;
mod image_order;
mod interval;
mod nearest;
mod object_order;
mod precision;
mod race;
mod ray;
mod scaling;
mod vectors;
mod viewing_rays;

use super::station::Station;

/// All of them.
pub static STATIONS: [Station; 14] = [
    vectors::STATION,
    ray::STATION,
    scaling::STATION,
    viewing_rays::STATION,
    algebraic::STATION,
    geometric::STATION,
    interval::STATION,
    first_picture::STATION,
    image_order::STATION,
    object_order::STATION,
    race::STATION,
    nearest::STATION,
    illumination::STATION,
    precision::STATION,
];

/// The index of a station by its number, counted from 1, or its name.
///
/// # Errors
/// Lists the stations, if there is no such one.
pub fn station(text: &str) -> Result<usize, String> {
    let by_number = text.parse().ok().and_then(|number: usize| number.checked_sub(1));
    let by_name = || STATIONS.iter().position(|station| station.name == text);
    by_number.filter(|&index| index < STATIONS.len()).or_else(by_name).ok_or_else(|| {
        format!("unknown station; 1 to {}, or a name that --list prints", STATIONS.len())
    })
}
