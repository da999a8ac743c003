#!/bin/sh
# Every measurement of benches/README.md, one after another on an idle machine; their output goes to
# the folder given. MECHAUDIT_DIR, LIBCERF_DIR and FADDEEVA_DIR: see benches/peers/README.md.
set -eu
cd "$(dirname "$0")/.."
out=${1:?"usage: benches/measure.sh FOLDER"}
mkdir -p "$out"

measure() {
    name=$1
    shift
    echo "$name: $*"
    "$@" >"$out/$name.txt" 2>&1 || echo "$name failed, see $out/$name.txt"
}

{ uname -a; grep -m 1 "model name" /proc/cpuinfo; rustc --version; git rev-parse HEAD; } >"$out/machine.txt" || true
for bench in class_iii planar run_up spline chirp_oscillator judgements elementary faddeeva_reference; do
    measure "$bench" cargo bench --bench "$bench"
done
measure scipy python3 benches/compare_scipy.py
measure lapack python3 benches/compare_lapack.py "${MECHAUDIT_DIR:-/usr/local}"
measure dyads python3 benches/compare_dyads.py
measure dop853 python3 benches/compare_dop853.py
measure flint python3 benches/compare_flint.py
measure integrators python3 benches/integrators/atlas.py
measure four-bar python3 benches/integrators/damped_four_bar.py target/release/mechaudit
peers() {
    name=$1
    shift
    measure "$name" cargo run --release --manifest-path benches/peers/Cargo.toml -- --format markdown "$@"
}
for run in 1 2 3; do
    peers "peers-speed-$run" --speed
done
peers peers-accuracy --accuracy 20000
peers peers-accuracy-own --accuracy 10000000 --codes mechaudit
