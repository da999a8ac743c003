use super::*;

#[test]
fn parts_of_one_method_are_told_apart_by_their_labels() {
    let text = "
        name = \"labels\"
        [[part]]
        methods = [\"faddeeva\"]
        seeds = [1, 2]
        cases = 1
        [[part]]
        methods = [\"faddeeva\"]
        regions = [\"small\"]
        cases = 1
        [[part]]
        kind = \"proof\"
        methods = [\"faddeeva\"]
        [[part]]
        kind = \"proof\"
        methods = [\"faddeeva\"]
        within = 0.5
    ";
    let plan = Plan::read(&Source::toml(text)).unwrap();
    let labels: Vec<String> = plan.parts.iter().map(Part::label).collect();
    let expected = [
        "faddeeva, seed 1",
        "faddeeva, seed 2",
        "faddeeva, small, seed 1",
        "faddeeva, proof",
        "faddeeva, proof within 0.5",
    ];
    assert_eq!(labels, expected);
}

#[test]
fn what_a_part_leaves_out() {
    let of = |kind: &str| {
        let text = format!("name = \"x\"\n[[part]]\nmethods = [\"erf\"]\n{kind}");
        let plan = Plan::read(&Source::toml(&text)).unwrap();
        plan.parts.into_iter().next().unwrap()
    };
    let program = of("kind = \"candidate\"\ncases = 1\nexec = \"true\"");
    assert_eq!(
        (program.seed, program.hunts, program.evaluations),
        (1, 0, 0)
    );
    let spoken = program.program.unwrap();
    assert_eq!(
        (spoken.timeout, spoken.decimal, spoken.binary),
        (60.0, false, false)
    );
    let hunts = of("kind = \"hunt\"\nhunts = 3");
    assert_eq!((hunts.hunts, hunts.evaluations), (3, 10_000));
    let hunt = of("kind = \"hunt\"\nevaluations = 5");
    assert_eq!((hunt.hunts, hunt.evaluations), (1, 5));
}

/// Cases, outputs and budgets of a part hold for the method as it is judged.
#[test]
fn a_part_is_judged_as_it_says() {
    let of = |more: &str| {
        let text = format!("name = \"x\"\n[[part]]\nmethods = [\"faddeeva\"]\ncases = 1\n{more}");
        let part = Plan::read(&Source::toml(text))
            .unwrap()
            .parts
            .swap_remove(0);
        let method = part.method();
        let v: &dyn Method = &part.variant(&*method).unwrap();
        let domain = v.domain();
        (
            domain.regions.iter().map(|r| r.name).collect::<Vec<_>>(),
            domain.check_points.len(),
            v.outputs()
                .iter()
                .map(|o| format!("{} {}", o.name, o.budget.limit))
                .collect::<Vec<_>>(),
            v.norm_budget().map(|n| n.to_string()),
            v.laws().len(),
            v.format(),
        )
    };
    let plain = of("");
    let ordinary = of("ordinary = true");
    assert!(ordinary.0.len() < plain.0.len() && ordinary.1 < plain.1);
    let one = of("regions = [\"far\"]");
    assert_eq!((one.0, one.1), (vec!["far"], 0));
    let some = of("outputs = [\"Im W\"]").2;
    assert!(some.len() == 1 && some[0].starts_with("Im W "), "{some:?}");
    for (more, part) in [
        ("ulps = 7", "7 ulp"),
        ("relative = 0.5", "relative error 5e-1"),
        ("absolute = 0.25", "2.5e-1"),
    ] {
        let limits = of(more).2;
        assert!(
            limits.len() == 2 && limits.iter().all(|l| l.contains(part)),
            "{limits:?}"
        );
    }
    assert_ne!(of("normwise = 123").3, plain.3);
    assert_ne!(of("single = true").5, plain.5);
    let program = of("kind = \"candidate\"\nexec = \"true\"");
    assert!(plain.4 > 0 && program.4 == 0);
}

fn read(part: &str) -> Result<Plan, PlanError> {
    Plan::read(&Source::toml(format!("name = \"x\"\n[[part]]\n{part}")))
}

fn refused(part: &str) -> String {
    let plan = read(part);
    plan.map(|_| panic!("{part} is a part"))
        .unwrap_or_else(|e: PlanError| e.to_string())
}

/// A part that breaks one rule is refused by this rule, in its words.
#[test]
fn each_rule_has_its_words() {
    let audit = "methods = [\"faddeeva\"]\ncases = 1\n";
    let program = "kind = \"candidate\"\nmethods = [\"faddeeva\"]\ncases = 1\nexec = \"true\"\n";
    let hunt = "kind = \"hunt\"\nmethods = [\"faddeeva\"]\nhunts = 1\n";
    let proof = "kind = \"proof\"\nmethods = [\"faddeeva\"]\n";
    for part in [audit, program, hunt, proof] {
        assert!(read(part).is_ok(), "{part}");
    }
    let rules: [(&str, &[&str], &str); 20] = [
        ("methods = []\ncases = 1", &[""], "methods = [] names none"),
        (audit, &["seeds = []"], "seeds = [] names none"),
        (
            audit,
            &[
                "ulps = 1\nrelative = 1",
                "ulps = 1\nabsolute = 1",
                "relative = 1\nabsolute = 1",
            ],
            "ulps, relative and absolute exclude each other",
        ),
        (
            audit,
            &[
                "ulps = 0",
                "ulps = inf",
                "relative = -1",
                "absolute = nan",
                "normwise = 0",
                "normwise = -inf",
            ],
            "a limit is finite and positive",
        ),
        (
            program,
            &[
                "timeout = 0",
                "timeout = -1",
                "timeout = inf",
                "timeout = nan",
            ],
            "timeout is a positive number of seconds",
        ),
        (
            program,
            &["decimal = true\nbinary = true"],
            "decimal and binary exclude each other",
        ),
        (
            audit,
            &["hunts = 1", "evaluations = 1"],
            "hunts and evaluations belong to kind = \"hunt\", which needs one of them",
        ),
        (
            "kind = \"hunt\"\nmethods = [\"faddeeva\"]",
            &[""],
            "hunts and evaluations belong to kind = \"hunt\", which needs one of them",
        ),
        (
            audit,
            &["exec = \"true\""],
            "exec belongs to kind = \"candidate\", which needs it",
        ),
        (
            "kind = \"candidate\"\nmethods = [\"faddeeva\"]\ncases = 1",
            &[""],
            "exec belongs to kind = \"candidate\", which needs it",
        ),
        (
            audit,
            &["decimal = true", "binary = true", "timeout = 1"],
            "decimal, binary and timeout belong to kind = \"candidate\"",
        ),
        (
            hunt,
            &["cases = 1"],
            "cases belong to kind = \"audit\" and \"candidate\", which need them",
        ),
        (
            proof,
            &["cases = 1"],
            "cases belong to kind = \"audit\" and \"candidate\", which need them",
        ),
        (
            "methods = [\"faddeeva\"]\n",
            &["", "kind = \"candidate\"\nexec = \"true\""],
            "cases belong to kind = \"audit\" and \"candidate\", which need them",
        ),
        (audit, &["within = 1"], "within belongs to kind = \"proof\""),
        (hunt, &["within = 1"], "within belongs to kind = \"proof\""),
        (
            proof,
            &["within = 0", "within = -1", "within = inf", "within = nan"],
            "within is a positive number",
        ),
        (
            proof,
            &[
                "seeds = [2]",
                "regions = [\"mid\"]",
                "box = \"Re z=0..1\"",
                "ordinary = true",
                "single = true",
                "outputs = [\"Re W\"]",
                "ulps = 1",
                "relative = 1",
                "absolute = 1",
                "normwise = 1",
            ],
            "a proof is of all inputs and outputs: of its keys it has methods and within alone",
        ),
        (hunt, &["box = \"Re z=0..1\""], "a hunt has no box"),
        (
            "",
            &[
                "methods = [\"faddeeva\"]\ncases = 0",
                "kind = \"hunt\"\nmethods = [\"faddeeva\"]\nhunts = 0",
                "kind = \"hunt\"\nmethods = [\"faddeeva\"]\nevaluations = 0",
            ],
            "cases, hunts and evaluations are 1 or more",
        ),
    ];
    for (part, all, why) in rules {
        for more in all {
            let said = refused(&format!("{part}{more}"));
            assert_eq!(said, format!("part 1: {why}"), "{part}{more}");
        }
    }
    // The least and the usual are none of these.
    for (part, more) in [
        (audit, "ulps = 1e-300\nnormwise = 1e-300"),
        (program, "timeout = 0.001\ndecimal = true"),
        (program, "binary = true"),
        (
            hunt,
            "evaluations = 1\nulps = 2\nordinary = true\nregions = [\"mid\"]",
        ),
        (proof, "within = 1"),
    ] {
        assert!(read(&format!("{part}{more}")).is_ok(), "{part}{more}");
    }
}

/// A part is numbered as it stands in the file, however many methods and seeds come before it.
#[test]
fn a_bad_part_is_named_by_its_number() {
    let first = "methods = [\"erf\", \"erfc\"]\nseeds = [1, 2]\ncases = 1\n[[part]]\n";
    let of = |second: &str| refused(&format!("{first}{second}"));
    assert_eq!(
        of("methods = [\"erf\"]\ncases = 0"),
        "part 2: cases, hunts and evaluations are 1 or more"
    );
    for (more, why) in [
        (
            "regions = [\"nowhere\"]",
            "part 2: erf has no region \"nowhere\"",
        ),
        ("outputs = [\"Re W\"]", "part 2: erf has no output \"Re W\""),
        ("box = \"Re z=1..\"", "part 2: "),
    ] {
        let said = of(&format!("methods = [\"erf\"]\ncases = 1\n{more}"));
        assert!(said.starts_with(why), "{said}");
    }
    assert!(
        of("methods = [\"erff\"]\ncases = 1").starts_with("part 2: there is no method \"erff\"")
    );
    let none = Plan::read(&Source::toml("name = \"x\"\npart = []")).unwrap_err();
    assert!(none.to_string().contains("the plan has no parts"), "{none}");
}

#[test]
fn a_plan_that_was_read_is_checked_again() {
    let mut plan = read("methods = [\"erf\", \"erfc\"]\ncases = 1").unwrap();
    assert!(plan.check().is_ok());
    plan.parts[1].method = "erff".into();
    let why = plan.check().unwrap_err().to_string();
    assert!(
        why.starts_with("part 2: there is no method \"erff\""),
        "{why}"
    );
    assert!(
        why.contains("did you mean \"erf\"?") && why.contains("there are: "),
        "{why}"
    );
}

/// Methods in their order, each with every seed; the file's seed where a part has none, one where
/// the file has none.
#[test]
fn a_part_of_the_file_is_one_for_each_method_and_seed() {
    let of = |head: &str, more: &str| {
        let text = format!(
            "name = \"x\"\n{head}\n[[part]]\nmethods = [\"erfc\", \"erf\"]\ncases = 1\n{more}"
        );
        let plan = Plan::read(&Source::toml(text)).unwrap();
        let names: Vec<&str> = plan.methods().iter().map(|m| m.name()).collect();
        let parts: Vec<(&str, u64)> = names
            .into_iter()
            .zip(plan.parts.iter().map(|p| p.seed))
            .collect();
        assert_eq!(plan.name, "x");
        parts
    };
    assert_eq!(of("", ""), [("erfc", 1), ("erf", 1)]);
    assert_eq!(of("seed = 7", ""), [("erfc", 7), ("erf", 7)]);
    let expected = [("erfc", 3), ("erfc", 2), ("erf", 3), ("erf", 2)];
    assert_eq!(of("seed = 7", "seeds = [3, 2]"), expected);
}

#[test]
fn a_digest_is_of_all_that_a_plan_says() {
    let plan = |cases: u32| read(&format!("methods = [\"erf\"]\ncases = {cases}")).unwrap();
    assert_eq!(plan(1).digest(), plan(1).digest());
    assert_ne!(plan(1).digest(), plan(2).digest());
    let named = Plan {
        name: "y".into(),
        ..plan(1)
    };
    assert_ne!(plan(1).digest(), named.digest());
    assert_eq!(hex(&[0, 1, 16, 171, 255]), "000110abff");
}

/// A case of a part is judged again as the part has judged it.
#[test]
fn the_options_of_a_part_are_those_of_a_command() {
    let of = |part: &str| {
        let plan = read(&format!("methods = [\"faddeeva\"]\ncases = 3\n{part}")).unwrap();
        plan.parts[0].tail()
    };
    for (part, expected) in [
        ("", ""),
        ("ordinary = true\nregions = [\"far\"]", ""),
        (
            "box = \"Re z=0..1\"\nordinary = true\nregions = [\"far\", \"mid\"]",
            " --region far --region mid --ordinary",
        ),
        ("box = \"Re z=0..1\"\nsingle = true", " --single"),
        (
            "outputs = [\"Re W\", \"Im W\"]\nulps = 2\nnormwise = 0.5",
            " --outputs 'Re W,Im W' --ulps 2.0 --normwise 0.5",
        ),
        ("relative = 1e-9", " --relative 1e-9"),
        (
            "absolute = 0.25\nsingle = true",
            " --absolute 0.25 --single",
        ),
        (
            "kind = \"candidate\"\nexec = \"it's\"\ndecimal = true",
            " --exec 'it'\\''s' --decimal",
        ),
        (
            "kind = \"candidate\"\nexec = \"w\"\nbinary = true",
            " --exec 'w' --binary",
        ),
    ] {
        assert_eq!(of(part), expected, "{part}");
    }
}

#[test]
fn settings_and_labels_are_those_of_the_part() {
    let plan = read(
        "methods = [\"faddeeva\"]\nseeds = [9]\ncases = 12\nregions = [\"far\", \"mid\"]\nbox = \"Re z=0..1\"",
    );
    let part = plan.unwrap().parts.swap_remove(0);
    let settings = part.settings();
    let expected = (9, 12, POINTS);
    assert_eq!(
        (settings.seed, settings.cases_per_region, settings.points),
        expected
    );
    assert_eq!(part.label(), "faddeeva, far, mid, Re z=0..1, seed 9");
    let method = part.method();
    let variant = part.variant(&*method).unwrap();
    assert_eq!(variant.domain().regions.len(), 2);
    // Twelve of each region, with what the box names from the box.
    let cases = crate::audit::Cases::new(&variant, &settings);
    assert_eq!(cases.len(), 24);
    assert!((0..24).all(|i| (0.0..=1.0).contains(&cases.get(i).input[0])));
}

/// A part has no entries that its kind does not use.
#[test]
fn parts_hold_what_their_kind_has() {
    let of = |part: &str| {
        read(&format!("methods = [\"faddeeva\"]\n{part}"))
            .unwrap()
            .parts
            .swap_remove(0)
    };
    let audit = of("cases = 3");
    assert_eq!(
        (audit.kind, audit.cases, audit.hunts, audit.evaluations),
        (Kind::Audit, 3, 0, 0)
    );
    assert!(audit.program.is_none() && audit.limit.is_none() && audit.within.is_none());
    let hunt = of("kind = \"hunt\"\nhunts = 4\nevaluations = 5");
    assert_eq!(
        (hunt.kind, hunt.cases, hunt.hunts, hunt.evaluations),
        (Kind::Hunt, 0, 4, 5)
    );
    let proof = of("kind = \"proof\"\nwithin = 2");
    assert_eq!(
        (proof.kind, proof.within, proof.hunts, proof.evaluations),
        (Kind::Proof, Some(2.0), 0, 0)
    );
    let program =
        of("kind = \"candidate\"\ncases = 1\nexec = \"w 1\"\nbinary = true\ntimeout = 2.5");
    let expected = Program {
        exec: "w 1".into(),
        decimal: false,
        binary: true,
        timeout: 2.5,
    };
    assert_eq!(
        (program.kind, program.program),
        (Kind::Candidate, Some(expected))
    );
    for (name, x) in [("ulps", 3.0), ("relative", 0.5), ("absolute", 0.25)] {
        let part = of(&format!("cases = 1\n{name} = {x}"));
        assert_eq!(part.limit, Some((name.to_string(), x)));
    }
}
