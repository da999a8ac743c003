#!/usr/bin/env bash
# Measures what a first use of the library costs: a crate with mechaudit under `[dev-dependencies]` and two tests, one
# of `faddeeva` and one of a spline, is made in a temporary folder, compiled from nothing and run by `cargo test`, in
# the dev profile. Prints the crates compiled, the processor time of the whole run and the size of `target`; fails where
# one is above its limit. GMP and MPFR come from the user's cache: run it a second time where they were not there yet.
#
# Usage: benches/consumer.sh [KEYS]; KEYS follow the path in the line `mechaudit = { path = …, KEYS }`, for instance
#     benches/consumer.sh 'default-features = false, features = ["full"]'
set -euo pipefail
cd "$(dirname "$0")/.."
crates_allowed=45 seconds_allowed=60 megabytes_allowed=600

crate=$(mktemp -d)
trap 'rm -rf "$crate"' EXIT
mkdir "$crate/src" "$crate/tests"
touch "$crate/src/lib.rs"
# The same versions as here; cargo leaves out what the crate does not need.
cp Cargo.lock "$crate/"
cat >"$crate/Cargo.toml" <<END
[package]
name = "consumer"
version = "0.1.0"
edition = "2024"

[dev-dependencies]
mechaudit = { path = "$PWD"${1:+, $1} }

[workspace]
END
cat >"$crate/tests/accuracy.rs" <<'END'
use mechaudit::audit;
use mechaudit::candidate::AuditError;
use mechaudit::methods::{CubicSplineNotAKnot, Faddeeva, SplineProblem};
use mechaudit::solvers::cubic_spline::{Boundary, CubicSpline};
use mechaudit::solvers::faddeeva::faddeeva;

#[test]
fn w() -> Result<(), AuditError> {
    audit::<Faddeeva>(faddeeva).effort(0.1).run()?.assert_within_budget();
    Ok(())
}

#[test]
fn spline() -> Result<(), AuditError> {
    let solve = |p: SplineProblem| {
        let s = CubicSpline::fit(p.x.to_vec(), p.y.to_vec(), Boundary::NOT_A_KNOT).ok()?;
        let [a, b] = p.queries;
        let row = |q, to| {
            let j = s.jet(q).ok()?;
            Some([j.value, j.first, j.second, j.third, s.integral(q, to).ok()?])
        };
        Some(vec![row(a, b)?, row(b, a)?])
    };
    audit::<CubicSplineNotAKnot>(solve).effort(0.1).run()?.assert_within_budget();
    Ok(())
}
END

cd "$crate"
unset CARGO_TARGET_DIR CARGO_INCREMENTAL RUSTFLAGS
TIMEFORMAT='%U %S'
if ! { time cargo test >output 2>&1; } 2>times; then
    cat output >&2
    exit 1
fi
read -r user system <times
crates=$(grep -c '^ *Compiling ' output)
seconds=$(awk "BEGIN { printf \"%.0f\", $user + $system }")
megabytes=$(du -sm target | cut -f 1)
echo "$crates crates of $crates_allowed, $seconds s of processor time of $seconds_allowed, $megabytes MB of $megabytes_allowed"
[ "$crates" -le "$crates_allowed" ] && [ "$seconds" -le "$seconds_allowed" ] && [ "$megabytes" -le "$megabytes_allowed" ]
