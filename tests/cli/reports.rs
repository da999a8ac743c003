//! The forms of an audit's report.

use crate::common::{browsed, markup, needs_nothing_else};
use serde_json::Value;
use std::process::Command;

const PROGRAM: &str = env!("CARGO_BIN_EXE_mechaudit");

fn run(args: &[&str]) -> (i32, String) {
    let mut command = Command::new(PROGRAM);
    let output = command
        .args(args)
        .env_remove("MECHAUDIT_EFFORT")
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    (output.status.code().unwrap(), text)
}

fn schema(file: &str) -> Value {
    let path = format!("{}/../../schema/{file}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Where a document is not as the schema of that file says.
pub fn against(file: &str, document: &Value) -> Vec<String> {
    let mut found = Vec::new();
    let root = schema(file);
    faults(&root, &root, document, "", &mut found);
    found
}

/// Where `value` is not as the schema says; the part of JSON Schema that the files use.
fn faults(schema: &Value, root: &Value, value: &Value, place: &str, found: &mut Vec<String>) {
    if let Some(name) = schema["$ref"].as_str() {
        let (file, pointer) = name.split_once('#').unwrap();
        let other = match file {
            "" => root,
            file => &self::schema(file),
        };
        let target = other.pointer(pointer).expect(name);
        return faults(target, other, value, place, found);
    }
    let is = |kind: &str| match kind {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("{other} in the schema"),
    };
    if let Some(one_of) = schema["anyOf"].as_array() {
        let fits = |s: &Value| {
            let mut inner = Vec::new();
            faults(s, root, value, place, &mut inner);
            inner
        };
        let tried: Vec<Vec<String>> = one_of.iter().map(fits).collect();
        if !tried.iter().any(Vec::is_empty) {
            found.extend(tried.into_iter().flatten());
        }
        return;
    }
    if let (Some(due), Some(items)) = (schema["prefixItems"].as_array(), value.as_array()) {
        for (i, (s, item)) in due.iter().zip(items).enumerate() {
            faults(s, root, item, &format!("{place}/{i}"), found);
        }
        if due.len() != items.len() {
            found.push(format!("{place}: {} items", items.len()));
        }
    }
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    if !kinds.is_empty() && !kinds.iter().any(|k| is(k)) {
        found.push(format!("{place}: {value} is none of {kinds:?}"));
    }
    if let Some(allowed) = schema["enum"].as_array()
        && !allowed.contains(value)
    {
        found.push(format!("{place}: {value} is not allowed"));
    }
    if let (Some(object), Some(known)) = (value.as_object(), schema["properties"].as_object()) {
        for name in schema["required"].as_array().into_iter().flatten() {
            if !object.contains_key(name.as_str().unwrap()) {
                found.push(format!("{place}: {name} is missing"));
            }
        }
        for (name, inner) in object {
            match known.get(name) {
                Some(s) => faults(s, root, inner, &format!("{place}/{name}"), found),
                None => found.push(format!("{place}: {name} is not in the schema")),
            }
        }
    }
    if let (Some(items), true) = (value.as_array(), schema["items"].is_object()) {
        for (i, item) in items.iter().enumerate() {
            faults(&schema["items"], root, item, &format!("{place}/{i}"), found);
        }
    }
}

#[test]
fn json_is_as_its_schema_says() {
    let check = |v: &Value| against("audit.schema.json", v);
    let (code, text) = run(&["audit", "--cases", "2", "--format", "json"]);
    let mut v: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, check(&v)), (0, Vec::new()));
    // Maps where they are asked for.
    assert!(
        v["methods"]
            .as_array()
            .unwrap()
            .iter()
            .all(|m| m.get("map").is_none())
    );
    let (code, text) = run(&["audit", "erf", "--cases", "1", "--maps", "--format", "json"]);
    let mapped: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, check(&mapped)), (0, Vec::new()));
    let map = &mapped["methods"][0]["map"];
    for output in map["outputs"].as_array().unwrap() {
        assert_eq!(output["ulps"].as_array().unwrap().len(), 144 * 104);
    }
    assert_eq!(
        (&map["not_passed"], map["outputs"].as_array().unwrap().len()),
        (&0.into(), 2)
    );
    // Failures too: nothing is within a millionth of an ulp but exact values.
    let (code, text) = run(&[
        "audit",
        "slider-crank",
        "--cases",
        "1",
        "--ulps",
        "1e-6",
        "--format",
        "json",
    ]);
    let failing: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, check(&failing)), (1, Vec::new()));
    assert!(
        !failing["methods"][0]["failures"]
            .as_array()
            .unwrap()
            .is_empty()
    );
    // A candidate with answers of every kind, its numbers in single precision.
    let wrong = "sh -c 'i=0; while read x; do i=$((i+1)); case $((i%5)) in 0) echo nan,1;; \
                 1) echo inf,0;; 2) echo refuse;; 3) echo 1;; 4) echo x;; esac; done'";
    let args = [
        "audit", "erf", "--cases", "2", "--single", "--format", "json",
    ];
    let (code, text) = run(&[&args[..], &["--relative", "1e-5", "--exec", wrong]].concat());
    let wrong: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, check(&wrong)), (1, Vec::new()));
    let kinds = &wrong["methods"][0]["total"]["kinds"];
    for kind in ["nan", "infinity", "refusal", "missing", "unreadable"] {
        assert!(kinds[kind].as_u64().unwrap() > 0, "{kind}: {kinds}");
    }
    // The check itself finds faults.
    v["methods"][0]["cases"] = "many".into();
    v["methods"][1].as_object_mut().unwrap().remove("laws");
    v["more"] = 1.into();
    assert_eq!(check(&v).len(), 3, "{:?}", check(&v));
}

#[test]
fn a_comparison_is_as_its_schema_says() {
    let wrong = "sh -c 'while read x; do echo nan,1; done'";
    let options = [
        "erf", "--cases", "3", "--region", "disc", "--with", "ours", "--format", "json",
    ];
    let args = [&["compare"], &options[..], &["--exec", wrong]].concat();
    let (code, text) = run(&args);
    let v: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, against("compare.schema.json", &v)), (1, Vec::new()));
    let before = std::env::temp_dir().join(format!("mechaudit-before-{}.json", std::process::id()));
    std::fs::write(&before, &text).unwrap();
    let baseline = ["--no-speed", "--baseline", before.to_str().unwrap()];
    let (code, text) = run(&[&args[..], &baseline].concat());
    std::fs::remove_file(&before).unwrap();
    let mut v: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, against("compare.schema.json", &v)), (1, Vec::new()));
    assert!(v["baseline"].is_object() && v["candidates"][0]["speed"].is_null());
    v["candidates"][0]["report"]
        .as_object_mut()
        .unwrap()
        .remove("total");
    v["regions"][0]["standings"][1]["best"] = 1.into();
    assert_eq!(against("compare.schema.json", &v).len(), 2);
}

#[test]
fn junit_has_a_suite_for_each_method() {
    let (code, text) = run(&["audit", "slider-crank", "--cases", "2", "--format", "junit"]);
    let report = quick_junit::Report::deserialize_from_str(&text).unwrap();
    let suite = &report.test_suites[0];
    let method = mechaudit::methods::find("slider-crank").unwrap();
    let hard = usize::from(!method.hard().is_empty());
    let due = 1 + hard + method.domain().regions.len() + method.laws().len();
    assert_eq!((code, suite.tests, suite.failures), (0, due, 0), "{text}");
    // The budget in force and what was found.
    for part in ["budget", "references from", "% of budget"] {
        assert!(text.contains(part), "{part} is missing in {text}");
    }
    let args = [
        "audit",
        "slider-crank",
        "--cases",
        "2",
        "--ulps",
        "1e-6",
        "--format",
        "junit",
    ];
    let (code, text) = run(&args);
    let report = quick_junit::Report::deserialize_from_str(&text).unwrap();
    let suite = &report.test_suites[0];
    assert!(code == 1 && suite.failures > 3, "{text}");
    assert!(
        text.contains("reproduce") && text.contains("--case"),
        "{text}"
    );
}

#[test]
fn the_page_is_whole_and_needs_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("audit.html");
    let target = path.to_str().unwrap();
    let (code, _) = run(&[
        "audit", "--cases", "1", "--format", "html", "--output", target,
    ]);
    assert_eq!(code, 0);
    let page = std::fs::read_to_string(&path).unwrap();
    needs_nothing_else(&page);
    let markup = markup(&page);
    // The explanations of the columns are words, and speak of NaN.
    let (figures, _) = markup.split_once("<h2 id=\"columns\">").unwrap();
    for broken in ["NaN", "=\"inf", "-inf", "undefined", "{}"] {
        assert!(!figures.contains(broken), "{broken}");
    }
    let registry = mechaudit::methods::registry();
    for (i, m) in registry.iter().enumerate() {
        let anchor = |how: &str| markup.matches(&format!("{how}method-{i}\"")).count();
        assert!(
            anchor("href=\"#") >= 1 && anchor("id=\"") == 1,
            "{}",
            m.name()
        );
        assert!(
            markup.contains(m.summary()) || m.summary().contains('&'),
            "{}",
            m.name()
        );
    }
    // Without scripts the numbers are there.
    assert!(markup.matches("<table").count() > registry.len());
    if let Some(dom) = browsed(&path, 1280) {
        // A parser that had to mend the page would have changed these.
        for tag in ["<details", "</details>", "</section>"] {
            assert_eq!(dom.matches(tag).count(), page.matches(tag).count(), "{tag}");
        }
        assert!(dom.trim_end().ends_with("</html>"));
    }
}
