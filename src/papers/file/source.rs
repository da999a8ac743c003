//! Where the files of a paper come from: a folder, a single file, or texts that are compiled in.

use crate::study::{StudyError, document::LONGEST};
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Texts that are compiled in, by the names of their files.
pub type Texts = &'static [(&'static str, &'static str)];

/// The files of a paper.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// The files of a folder.
    Folder(PathBuf),
    /// Texts.
    Texts(Texts),
}

impl Source {
    /// The text of a file; its name may lead into folders below, not out of the paper's folder.
    pub fn read(&self, name: &str) -> Result<String, StudyError> {
        let below = Path::new(name)
            .components()
            .all(|part| matches!(part, Component::Normal(_)));
        if name.is_empty() || !below {
            let reason = format!("{name:?} is not the name of a file in the paper's folder");
            return Err(StudyError::new(reason));
        }
        match self {
            Source::Folder(folder) => read(&folder.join(name), name),
            Source::Texts(texts) => match texts.iter().find(|t| t.0 == name) {
                Some((_, text)) => Ok((*text).to_string()),
                None => Err(StudyError::new(format!("there is no file {name:?}"))),
            },
        }
    }
}

/// The text of a regular file of bounded length.
fn read(path: &Path, name: &str) -> Result<String, StudyError> {
    let cannot =
        |reason: String| StudyError::new(format!("the file {name} cannot be read: {reason}"));
    let of = |e: std::io::Error| cannot(e.to_string());
    // A pipe or a device might never end.
    if !std::fs::metadata(path).map_err(of)?.is_file() {
        return Err(cannot("it is no regular file".into()));
    }
    let file = std::fs::File::open(path).map_err(of)?;
    let mut bytes = Vec::new();
    let limit = LONGEST as u64 + 1;
    file.take(limit).read_to_end(&mut bytes).map_err(of)?;
    if bytes.len() > LONGEST {
        return Err(cannot(format!("it has more than {LONGEST} bytes")));
    }
    String::from_utf8(bytes).map_err(|_| cannot("it is not text in UTF-8".into()))
}
