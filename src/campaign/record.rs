//! The file of a shard: a line that says what it is, and a line with what was found.

use super::identity::Identity;
use super::plan::hex;
use super::shard::Content;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Grows when the content of a shard changes its meaning.
pub const SCHEMA: u32 = 1;

/// The campaign that the file of a shard belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// The version of the form.
    pub campaign_shard: u32,
    /// The plan's digest.
    pub plan: String,
    /// Its number.
    pub shard: u64,
    /// The number found.
    pub shards: u64,
    /// The program that computed it.
    #[serde(flatten)]
    pub identity: Identity,
    /// SHA-256 of the second line.
    pub content: String,
    /// The time that it took: seconds, and the number of threads.
    pub seconds: f64,
    /// See there.
    pub threads: usize,
}

/// A shard that is expected.
#[derive(Clone, Debug)]
pub struct Record<'a> {
    /// The plan's digest.
    pub plan: &'a str,
    /// Its number.
    pub shard: u64,
    /// The number found.
    pub shards: u64,
    /// The program that has to have computed it.
    pub identity: &'a Identity,
}

/// The findings in the place of a shard.
#[derive(Clone, Debug, PartialEq)]
pub enum Found<'a> {
    /// The shard, with its second line.
    Whole(Box<Header>, &'a [u8]),
    /// Half of a file, or one whose content has changed.
    Damaged(String),
    /// A shard of another plan or number.
    Foreign(String),
    /// The shard, by another version: not to be mixed with this one's, nor to be overwritten.
    OtherVersion(String),
}

/// The reason why a shard's content cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("its content is no shard's: {0}")]
pub struct RecordError(#[from] serde_json::Error);

impl<'a> Record<'a> {
    /// The file's bytes.
    pub fn write(&self, content: &Content, seconds: f64, threads: usize) -> Vec<u8> {
        let body = serde_json::to_vec(content).expect("a content is JSON");
        let header = Header {
            campaign_shard: SCHEMA,
            plan: self.plan.into(),
            shard: self.shard,
            shards: self.shards,
            identity: self.identity.clone(),
            content: hex(&Sha256::digest(&body)),
            seconds,
            threads,
        };
        let mut bytes = serde_json::to_vec(&header).expect("a header is JSON");
        bytes.push(b'\n');
        bytes.extend(body);
        bytes.push(b'\n');
        bytes
    }

    /// Returns the state of a shard's file from its bytes.
    pub fn read<'b>(&self, bytes: &'b [u8]) -> Found<'b> {
        /// Read before everything else, which later versions may write otherwise.
        #[derive(Deserialize)]
        struct Schema {
            campaign_shard: u32,
        }
        let damaged = |why: &str| Found::Damaged(why.into());
        let Some(end) = bytes.iter().position(|b| *b == b'\n') else {
            return damaged("its first line has no end");
        };
        let (first, body) = (&bytes[..end], &bytes[end + 1..]);
        match serde_json::from_slice::<Schema>(first) {
            Ok(s) if s.campaign_shard == SCHEMA => {}
            Ok(s) => {
                let other = s.campaign_shard;
                return Found::OtherVersion(format!("its form has version {other}, not {SCHEMA}"));
            }
            Err(_) => return damaged("its first line is no header of a shard"),
        }
        let Ok(header) = serde_json::from_slice::<Header>(first) else {
            return damaged("its first line is no header of a shard");
        };
        if header.plan != self.plan {
            return Found::Foreign("it belongs to another plan".into());
        }
        if (header.shard, header.shards) != (self.shard, self.shards) {
            let (shard, shards) = (header.shard, header.shards);
            return Found::Foreign(format!("it is shard {shard} of {shards}"));
        }
        if let Some(how) = self.identity.differs(&header.identity) {
            return Found::OtherVersion(how);
        }
        let Some(body) = body.strip_suffix(b"\n") else {
            return damaged("its content has no end");
        };
        if hex(&Sha256::digest(body)) != header.content {
            return damaged("its content is not what its digest says");
        }
        Found::Whole(Box::new(header), body)
    }
}

impl Content {
    /// Reads the second line of a shard.
    ///
    /// # Errors
    /// Bytes that are no content.
    pub fn read(body: &[u8]) -> Result<Content, RecordError> {
        Ok(serde_json::from_slice(body)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(program: &str, references: &str) -> Identity {
        Identity {
            program: program.into(),
            references: references.into(),
            solvers: "s".into(),
        }
    }

    #[test]
    fn a_file_is_whole_or_what_is_wrong_with_it() {
        let own = identity("1", "r");
        fn record<'a>(plan: &'a str, shard: u64, identity: &'a Identity) -> Record<'a> {
            Record {
                plan,
                shard,
                shards: 4,
                identity,
            }
        }
        let expected = record("p", 2, &own);
        let content = Content { parts: Vec::new() };
        let bytes = expected.write(&content, 1.5, 2);
        let Found::Whole(header, body) = expected.read(&bytes) else {
            panic!("it is whole");
        };
        assert_eq!((header.shard, header.threads), (2, 2));
        assert_eq!(Content::read(body).unwrap(), content);
        // Cut off anywhere, or changed anywhere after the header.
        for end in 0..bytes.len() {
            assert!(
                matches!(expected.read(&bytes[..end]), Found::Damaged(_)),
                "{end}"
            );
        }
        let start = bytes.iter().position(|b| *b == b'\n').unwrap() + 1;
        for at in start..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 4;
            assert!(matches!(expected.read(&changed), Found::Damaged(_)), "{at}");
        }
        for other in [record("q", 2, &own), record("p", 3, &own)] {
            assert!(matches!(other.read(&bytes), Found::Foreign(_)));
        }
        // Another form of the file is not read by this one's rules.
        let text = String::from_utf8(bytes.clone()).unwrap();
        let form = text.replacen("\"campaign_shard\":1", "\"campaign_shard\":2", 1);
        assert!(matches!(
            expected.read(form.as_bytes()),
            Found::OtherVersion(_)
        ));
        for other in [identity("2", "r"), identity("1", "q")] {
            let found = record("p", 2, &other).read(&bytes);
            assert!(matches!(found, Found::OtherVersion(_)), "{found:?}");
        }
    }
}
