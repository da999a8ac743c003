use super::*;
use std::os::unix::fs::symlink;

fn written(name: &Path, text: &str) {
    let place = Destination::open(name).unwrap();
    place
        .write(|out| out.write_all(text.as_bytes()), |e| e)
        .unwrap();
}

/// As many links are followed as by the system, and no more.
#[test]
fn links_are_followed_as_the_system_does() {
    let folder = tempfile::tempdir().unwrap();
    let at = |k: usize| folder.path().join(k.to_string());
    std::fs::write(at(0), "").unwrap();
    for k in 1..=LINKS + 1 {
        symlink(at(k - 1), at(k)).unwrap();
        let found = followed(&at(k));
        assert_eq!(found.is_ok(), File::open(at(k)).is_ok(), "{k} links");
        assert_eq!(found.is_ok(), k <= LINKS, "{k} links");
        assert!(found.is_err() || found.unwrap() == at(0));
    }
}

#[test]
fn a_folder_is_the_part_before_the_name() {
    for (path, due) in [("a/b", "a"), ("/a", "/"), ("a", "."), ("a/b/c", "a/b")] {
        assert_eq!(folder(Path::new(path)), Path::new(due));
    }
}

#[test]
fn a_shorter_content_takes_the_place_of_a_longer_one() {
    let folder = tempfile::tempdir().unwrap();
    let [file, other] = ["file", "other"].map(|n| folder.path().join(n));
    std::fs::write(&file, "something long").unwrap();
    std::fs::hard_link(&file, &other).unwrap();
    written(&file, "short");
    assert_eq!(std::fs::read_to_string(&other).unwrap(), "short");
    std::fs::remove_file(&other).unwrap();
    written(&file, "new");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "new");
}

/// Whatever stands for an open file of a process is no file of a folder.
#[test]
fn descriptors_are_known_by_their_folder() {
    for (path, due) in [
        ("/dev/fd/1", true),
        ("/proc/self/fd/1", true),
        ("/dev/null", false),
        ("/tmp/file", false),
    ] {
        assert_eq!(is_descriptor(Path::new(path)), due, "{path}");
    }
}
