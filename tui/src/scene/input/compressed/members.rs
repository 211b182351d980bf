//! The members of a gzip file, one behind the other.
//!
//! Zeros behind the last one are no data, as for `zcat`: a tape or a disk fills its blocks with them. Other bytes are damage,
//! behind zeros too.

use flate2::bufread::GzDecoder;
use std::io::{self, BufRead, BufReader, Chain, Cursor, Read};

/// Bytes of the file that are read at once.
const BLOCK: usize = 32 << 10;

/// How many bytes tell what follows a member, ...
const HEAD: u64 = 1;
/// ... and how each begins.
const FIRST: u8 = 0x1f;

/// A member, behind the bytes that told it.
type Member<R> = GzDecoder<Chain<Cursor<Vec<u8>>, BufReader<R>>>;

/// What all members hold.
pub(super) struct Members<R> {
    /// The one that is being read; `None` after the last.
    member: Option<Member<R>>,
}

impl<R: Read> Members<R> {
    /// The members of a file that begins with one.
    pub(super) fn new(reader: R) -> Self {
        let rest = BufReader::with_capacity(BLOCK, reader);
        Self { member: Some(GzDecoder::new(Cursor::new(Vec::new()).chain(rest))) }
    }
}

impl<R: Read> Read for Members<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if bytes.is_empty() {
            return Ok(0);
        }
        while let Some(member) = &mut self.member {
            let read = member.read(bytes)?;
            if read > 0 {
                return Ok(read);
            }
            let mut head = Vec::new();
            member.get_mut().take(HEAD).read_to_end(&mut head)?;
            match head.first() {
                None | Some(0) => {
                    pass_padding(member.get_mut())?;
                    self.member = None;
                    return Ok(0);
                }
                Some(&FIRST) => {}
                Some(_) => return Err(damage("other bytes behind its end")),
            }
            self.member = self.member.take().map(|ended| {
                let (_, rest) = ended.into_inner().into_inner();
                GzDecoder::new(Cursor::new(head).chain(rest))
            });
        }
        Ok(0)
    }
}

/// Reads the rest of the file, which is zeros or damage.
fn pass_padding(rest: &mut impl BufRead) -> io::Result<()> {
    for byte in rest.bytes() {
        if byte? != 0 {
            return Err(damage("other bytes behind the zeros at its end"));
        }
    }
    Ok(())
}

fn damage(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, what)
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    fn member(text: &str) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(text.as_bytes()).expect("memory");
        encoder.finish().expect("memory")
    }

    /// A pipe that gives a byte at a time.
    struct Slow<'a>(&'a [u8]);

    impl Read for Slow<'_> {
        fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
            let count = bytes.len().min(1);
            self.0.read(&mut bytes[..count])
        }
    }

    fn unpacked(bytes: &[u8]) -> io::Result<String> {
        let mut text = String::new();
        let read = Members::new(Slow(bytes)).read_to_string(&mut text);
        let mut at_once = String::new();
        let read_at_once = Members::new(bytes).read_to_string(&mut at_once);
        assert_eq!(read.is_ok(), read_at_once.is_ok());
        assert!(read.is_err() || text == at_once);
        read.map(|_| text)
    }

    #[test]
    fn members_follow_each_other_and_what_follows_them_is_no_data() {
        let two = [member("one\n"), member(""), member("two\n")].concat();
        let blocks = vec![0; 3 * BLOCK];
        let ends: [(&[u8], &str); 4] = [
            (b"", "nothing"),
            (&[0; 512], "zeros"),
            (b"\0", "one zero"),
            (&blocks, "blocks of zeros"),
        ];
        for (behind, what) in ends {
            let all = [&*two, behind].concat();
            assert_eq!(unpacked(&all).expect(what), "one\ntwo\n", "{what}");
        }
    }

    #[test]
    fn a_member_that_is_cut_or_damaged_is_an_error() {
        let (one, two) = (member("one\n"), member("two\n"));
        let kind = |bytes: &[u8]| unpacked(bytes).expect_err("no whole member").kind();
        for end in [1, 2, 5, two.len() - 1] {
            assert_eq!(kind(&[&*one, &two[..end]].concat()), io::ErrorKind::UnexpectedEof);
        }
        let mut wrong = two;
        let sum = wrong.len() - 8;
        wrong[sum] ^= 1;
        assert_eq!(kind(&[&*one, &wrong].concat()), io::ErrorKind::InvalidInput);
        for behind in ["junk", "other bytes, more than a header"] {
            let error = unpacked(&[&one, behind.as_bytes()].concat()).expect_err("other bytes");
            assert_eq!(error.kind(), io::ErrorKind::InvalidInput, "{behind}");
            assert_eq!(error.to_string(), "other bytes behind its end");
        }
    }

    #[test]
    fn what_is_behind_zeros_is_not_lost() {
        let two = member("two\n");
        for zeros in [1, 2, 3, 512, BLOCK] {
            for behind in [&*two, b"x".as_slice()] {
                let all = [&*member("one\n"), &*vec![0; zeros], behind].concat();
                let error = unpacked(&all).expect_err("data behind zeros");
                assert_eq!(error.kind(), io::ErrorKind::InvalidInput, "{zeros}");
            }
        }
    }
}
