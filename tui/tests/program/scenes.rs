//! Spheres and rays as rows of numbers, the same in every run.

use spherule_referee::random::Random;

fn triple(random: &mut Random) -> [f32; 3] {
    random.in_cube(1.0).to_array()
}

/// Spheres in a cube, that fill about a seventh of it however many they are.
pub(crate) fn cloud(count: usize, seed: u64) -> Vec<f32> {
    let mut random = Random::seeded(seed);
    let size = (count as f32).powf(-1.0 / 3.0);
    let mut rows = Vec::new();
    for _ in 0..count {
        rows.extend(triple(&mut random));
        rows.push(size * (0.5 + 0.25 * random.between(-1.0, 1.0)));
    }
    rows
}

/// Spheres on spheres, a third as large: touching, nested at the joints, of many sizes.
pub(crate) fn flake(count: usize) -> Vec<f32> {
    let mut random = Random::seeded(5);
    let mut rows = vec![0.0, 0.0, 0.0, 0.5];
    for child in 1..count {
        let parent = &rows[(child - 1) / 9 * 4..][..4];
        let (center, radius) = ([parent[0], parent[1], parent[2]], parent[3]);
        let way = triple(&mut random);
        let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
        let reach = radius * 4.0 / 3.0 / length;
        rows.extend([0, 1, 2].map(|axis| center[axis] + way[axis] * reach));
        rows.push(radius / 3.0);
    }
    rows
}

/// A cloud with everything in it that no scene should have.
pub(crate) fn hostile(count: usize) -> Vec<f32> {
    let mut rows = cloud(count, 11);
    let values = [f32::NAN, f32::INFINITY, -f32::INFINITY, -1.0, 0.0, -0.0, 1e-42, 3e38, 1e13, 1e6];
    for (index, &value) in values.iter().cycle().take(count / 20).enumerate() {
        rows[(index * 20 + index % 7) * 4 + index % 4] = value;
    }
    // The same sphere often, so that a hit ties with others.
    for index in (1..count).step_by(50) {
        rows.copy_within(4 * (index - 1)..4 * index, 4 * index);
    }
    rows
}

/// The rays of a square picture, from tile to tile of 4 x 4.
pub(crate) fn camera(side: usize) -> Vec<f32> {
    let mut rows = Vec::new();
    for index in 0..side * side {
        let (tile, lane) = (index / 16, index % 16);
        let (x, y) = (tile % (side / 4) * 4 + lane % 4, tile / (side / 4) * 4 + lane / 4);
        let place = |pixel| ((2 * pixel + 1) as f32 / side as f32 - 1.0) * 0.364;
        rows.extend([0.0, 0.0, 4.0, place(x), -place(y), -1.0, 0.0, f32::INFINITY]);
    }
    rows
}

/// Rays from anywhere to anywhere, hostile ones among them.
pub(crate) fn scattered(count: usize) -> Vec<f32> {
    let mut random = Random::seeded(23);
    let mut rows = Vec::new();
    for index in 0..count {
        rows.extend(triple(&mut random));
        rows.extend(triple(&mut random));
        rows.extend([0.0, f32::INFINITY]);
        let row = &mut rows[8 * index..];
        match index % 64 {
            7 => row[3] = 0.0,
            13 => row[1] = f32::NAN,
            21 => row[4] = 1e-30,
            29 => row[2] = 1e20,
            37 => row[7] = 0.3,
            43 => row[6] = f32::NAN,
            51 => row[3..6].fill(0.0),
            57 => row[6] = -f32::INFINITY,
            _ => {}
        }
    }
    rows
}

/// Rays from around the origin to near it.
pub(crate) fn inward(count: usize) -> Vec<f32> {
    let mut random = Random::seeded(9);
    let mut rows = Vec::new();
    for _ in 0..count {
        let origin = 3.0 * random.in_cube(1.0);
        rows.extend(origin.to_array());
        rows.extend((0.5 * random.in_cube(1.0) - origin).to_array());
        rows.extend([0.0, f32::INFINITY]);
    }
    rows
}
