//! When rays are counted anew.

use super::*;

#[test]
fn what_rays_enter_by_themselves_is_counted_now_and_then() {
    let (tree, _) = scene(2000, 0);
    let (tree, mut sharing) = (tree.bvh(), Sharing::NOTHING);
    let mut strategies = Vec::new();
    let packets = vec![RayPacket::<[f32; 16]>::inactive(); 1 << 13];
    with_memory(|memory| {
        for _ in 0..8 {
            let (strategy, rays) = sharing.next::<_, AnyHit>(&tree, memory, &packets);
            strategies.push((strategy == StreamStrategy::Stream, rays));
            let rays = rays as u32;
            if strategy == StreamStrategy::Stream {
                sharing.take::<AnyHit>(&tree, seen(rays, rays, 20 * rays));
            } else {
                sharing.take_alone(Entered { rays, boxes: 20 * rays });
            }
        }
    });
    // Some by themselves, as many together, then as many as fit; and after 32,768 some by themselves again.
    let [first, alone, all] = [(true, 1024), (false, 1024), (true, TOGETHER)];
    assert_eq!(strategies, [alone, first, all, all, all, all, alone, all]);
}

#[test]
fn rays_that_look_otherwise_are_counted_anew() {
    let (tree, _) = scene(2000, 0);
    let (tree, mut sharing) = (tree.bvh(), Sharing::NOTHING);
    // A camera's rays, then some that look anywhere, then the camera's again.
    let mut random = Random(61);
    let packets: Vec<RayPacket> = (0..1600)
        .map(|place| {
            let ray = |_| {
                Ray::new(
                    Vec3::ZERO,
                    Vec3::from_array([(); 3].map(|()| random.below(1 << 20) as f32 - 5e5)),
                )
            };
            let anywhere: [Ray; 16] = core::array::from_fn(ray);
            let camera = [Ray::new(Vec3::ZERO, Vec3::Z); 16];
            RayPacket::new(if (320..1280).contains(&place) { &anywhere } else { &camera })
        })
        .collect();
    let (mut from, mut strategies) = (0, Vec::new());
    with_memory(|memory| {
        while from < packets.len() {
            let left = &packets[from..];
            let (strategy, count) = sharing.next::<_, ClosestHit>(&tree, memory, left);
            assert!(count > 0, "{strategies:?}");
            let is_stream = strategy == StreamStrategy::Stream;
            strategies.push((is_stream, from, count / 16));
            if is_stream {
                let met = if (320..1280).contains(&from) { 1 } else { 30 };
                sharing.take::<ClosestHit>(&tree, seen(count as u32, 1000, 1000 * met));
            }
            from += count.div_ceil(16);
        }
    });
    // A sample of each kind, and the strategy that it gives to rays that look like it.
    let expected = [
        (true, 0, 64),
        (true, 64, 256),
        (true, 320, 64),
        (false, 384, 512),
        (false, 896, 384),
        (true, 1280, 40),
        (true, 1320, 280),
    ];
    assert_eq!(strategies, expected);
}
