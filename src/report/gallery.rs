//! Reports as they are printed: texts by name in one file of `snapshots/`.

/// Texts by name.
#[derive(Default)]
pub struct Gallery(String);

impl Gallery {
    /// Adds a text, with visible escapes. Of a drawing the style sheet, the grid and what all marks
    /// have in common are left out.
    pub fn add(&mut self, name: impl std::fmt::Display, text: impl AsRef<str>) {
        let mut text = text.as_ref().replace('\u{1b}', "␛");
        if let (Some(from), Some(to)) = (text.find("<style>"), text.find("</style>")) {
            text.replace_range(from..to, "");
        }
        self.0 += &format!("== {name}\n");
        let grid = |line: &&str| !line.contains(" stroke=\"#dce0e3\" stroke-width=\"1\" ");
        for line in text.lines().filter(grid) {
            let mut line = line.trim_end().to_owned();
            for common in [
                " fill=\"none\"",
                " font-family=\"sans-serif\"",
                "</polyline>",
                "</circle>",
            ] {
                line = line.replace(common, "");
            }
            self.0 += &(line + "\n");
        }
    }

    /// Adds a document but for the program's version.
    // Documents are those of the program's tests, not of the library's.
    #[allow(dead_code)]
    pub fn add_json(&mut self, name: impl std::fmt::Display, mut value: serde_json::Value) {
        if let Some(object) = value.as_object_mut() {
            object.shift_remove("mechaudit_version");
        }
        self.add(name, serde_json::to_string_pretty(&value).unwrap());
    }

    /// Compares the texts with `snapshots/report-NAME.snap`.
    pub fn pin(self, name: &str) {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../../snapshots"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(format!("report-{name}"), self.0));
    }
}
