//! The calls that Embree is timed in.

use spherule_kernel::LevelName;

/// How many rays a call takes, and what it says of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Call {
    /// The name in tables.
    pub(super) name: &'static str,
    /// Rays of a record.
    pub(super) rays: usize,
    /// Whether a call takes a block of records.
    pub(super) is_stream: bool,
    /// Whether rays are said to be coherent.
    pub(super) is_coherent: bool,
}

/// Returns the calls of packets that a level has instructions for (a device traces wider ones ray by ray), of single rays, and of streams
/// if there are any.
///
/// A library goes another way with rays that are said to be coherent. Which is the quicker, their order alone does not tell: so
/// packets and streams are there with and without the flag. It says nothing of single rays.
pub(super) fn calls(level: LevelName, has_streams: bool) -> Vec<Call> {
    const OF_4: (usize, [&str; 2]) = (4, ["4 rays a call", "4 rays a call, coherent"]);
    const OF_8: (usize, [&str; 2]) = (8, ["8 rays a call", "8 rays a call, coherent"]);
    const OF_16: (usize, [&str; 2]) = (16, ["16 rays a call", "16 rays a call, coherent"]);
    let packets: &[_] = match level {
        LevelName::Baseline => &[OF_4],
        LevelName::Avx2 => &[OF_4, OF_8],
        LevelName::Avx512 => &[OF_8, OF_16],
        other => unreachable!("Embree is not asked for {other:?}"),
    };
    let both = |rays, is_stream, names: [&'static str; 2]| {
        [false, true].map(|is_coherent| {
            let name = names[usize::from(is_coherent)];
            Call { name, rays, is_stream, is_coherent }
        })
    };
    let packets = packets.iter().flat_map(|&(rays, names)| both(rays, false, names));
    let single = Call { name: "1 rays a call", rays: 1, is_stream: false, is_coherent: false };
    let streams = has_streams.then(|| both(1, true, ["streams", "streams, coherent"]));
    packets.chain([single]).chain(streams.into_iter().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packets_and_streams_are_tried_with_and_without_the_flag() {
        for (level, has_streams) in
            LevelName::ALL.into_iter().flat_map(|level| [(level, false), (level, true)])
        {
            let calls = calls(level, has_streams);
            for call in &calls {
                let alike =
                    |other: &&Call| (other.rays, other.is_stream) == (call.rays, call.is_stream);
                let flags: Vec<_> = calls.iter().filter(alike).map(|it| it.is_coherent).collect();
                let is_single = call.rays == 1 && !call.is_stream;
                let expected: &[_] = if is_single { &[false] } else { &[false, true] };
                assert_eq!(flags, expected, "{call:?}");
                assert_eq!(calls.iter().filter(|other| other.name == call.name).count(), 1);
            }
            assert_eq!(calls.iter().any(|call| call.is_stream), has_streams);
        }
    }
}
