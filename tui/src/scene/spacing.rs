//! How far particles are apart: their size, where nothing states it.

use spherule_kernel::Vec3;

/// Half of the distance between particles, if they fill the box that most of them are in; none if the box has no size.
pub(super) fn half_spacing(centers: &[Vec3]) -> Option<f32> {
    /// How many particles tell where most are.
    const MOST: usize = 10_000;
    let some: Vec<Vec3> =
        centers.iter().step_by(centers.len().div_ceil(MOST).max(1)).copied().collect();
    if some.len() < 2 {
        return None;
    }
    let (mut volume, mut dimensions) = (1.0_f64, 0_u8);
    for axis in 0..3 {
        let mut along: Vec<f32> = some.iter().map(|center| center[axis]).collect();
        along.sort_by(f32::total_cmp);
        let cut = along.len() / 20;
        let range = f64::from(along[along.len() - 1 - cut]) - f64::from(along[cut]);
        if range > 0.0 {
            volume *= range / 0.9;
            dimensions += 1;
        }
    }
    if dimensions == 0 {
        return None;
    }
    let apart = (volume / centers.len() as f64).powf(1.0 / f64::from(dimensions));
    let half = (0.5 * apart) as f32;
    Some(half).filter(|half| half.is_finite() && *half > 0.0)
}
