//! Spheres and rays as rows of numbers, the same in every run.

/// Numbers in [-1, 1) (splitmix64).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn triple(&mut self) -> [f32; 3] {
        [(); 3].map(|()| self.next())
    }
}

/// Spheres in a cube, that fill about a seventh of it however many they are.
pub(crate) fn cloud(count: usize, seed: u64) -> Vec<f32> {
    let mut numbers = Numbers(seed);
    let size = (count as f32).powf(-1.0 / 3.0);
    let mut rows = Vec::new();
    for _ in 0..count {
        rows.extend(numbers.triple());
        rows.push(size * (0.5 + 0.25 * numbers.next()));
    }
    rows
}

/// Spheres on spheres, a third as large: touching, nested at the joints, of many sizes.
pub(crate) fn flake(count: usize) -> Vec<f32> {
    let mut numbers = Numbers(5);
    let mut rows = vec![0.0, 0.0, 0.0, 0.5];
    for child in 1..count {
        let parent = &rows[(child - 1) / 9 * 4..][..4];
        let (center, radius) = ([parent[0], parent[1], parent[2]], parent[3]);
        let way = numbers.triple();
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
    let mut numbers = Numbers(23);
    let mut rows = Vec::new();
    for index in 0..count {
        rows.extend(numbers.triple());
        rows.extend(numbers.triple());
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
