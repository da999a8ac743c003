//! `mechaudit eval` as its user meets it.

use crate::common::{self, Done, run_on, said};
use mechaudit::reference::HexFloat;
use mechaudit::solvers::faddeeva::faddeeva;
use num_complex::Complex;
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::Child;
use std::time::Duration;

fn start(args: &[&str]) -> Child {
    common::start(&[&["eval"], args].concat())
}

fn eval(args: &[&str], input: &[u8]) -> Done {
    run_on(input, &[&["eval"], args].concat())
}

fn good(args: &[&str], input: &str) -> String {
    let d = eval(args, input.as_bytes());
    assert_eq!((d.code, d.err.as_str()), (0, ""), "{args:?} {input:?}");
    d.out
}

/// One line on stderr with all the parts, exit code 2, and this much on stdout.
fn refused(d: &Done, parts: &[&str], out: &str) {
    assert_eq!(d.code, 2, "{}", d.err);
    assert_eq!(d.err.lines().count(), 1, "{}", d.err);
    assert!(d.err.starts_with("mechaudit: "), "{}", d.err);
    for part in parts {
        assert!(d.err.contains(part), "{part:?} is missing in {}", d.err);
    }
    assert_eq!(d.out, out);
}

const W: &str = "faddeeva";

#[test]
fn hexadecimal_floats_in_the_order_of_the_lines() {
    let input =
        "# a comment\n\n 1.5 , -0.25 \r\n0x1.8p+0,-0x1p-2\n\t\n0,0\n-0,0\n0,-1e300\nnan,1\n";
    let w = faddeeva(Complex::new(1.5, -0.25));
    let hex = mechaudit::audit::hex_float;
    let first = format!("{},{}\n", hex(w.re), hex(w.im));
    let due = format!("{first}{first}0x1p+0,0x0p+0\n0x1p+0,-0x0p+0\ninf,0x0p+0\nnan,nan\n");
    assert_eq!(good(&[W], input), due);
    assert_eq!(good(&[W, "--threads", "1"], input), due);
    assert_eq!(good(&[W], input.trim_end()), due, "no newline at the end");
    assert_eq!(good(&[W], ""), "");
    assert_eq!(good(&[W], "# nothing\n\n"), "");
}

#[test]
fn a_decimal_is_the_nearest_double() {
    let hex = "0x1.999999999999ap-4,0x1.999999999999ap-4\n";
    assert_eq!(good(&[W], "0.1,1e-1\n"), good(&[W], hex));
    // Outputs read back as the same bits.
    let out = good(&[W], "0.3,-0.7\n5,1e-300\n1e-310,2\n");
    for line in out.lines() {
        for field in line.split(',') {
            let x = HexFloat::parse(field).unwrap().to_f64();
            assert_eq!(mechaudit::audit::hex_float(x), field);
        }
    }
}

#[test]
fn certified_digits() {
    let out = good(
        &[W, "--digits", "30"],
        "0,1\n0x0p0,1\n0.1,0\n1e200,0\n0,-1e9\n",
    );
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines[0], "0.427583576155807004410750344491,0");
    assert_eq!(lines[1], lines[0]);
    // e^{-1/100}: the decimal is taken exactly, the double next to it is another number.
    assert!(
        lines[2].starts_with("0.990049833749168053573905977180,"),
        "{}",
        lines[2]
    );
    let double = good(&[W, "--digits", "30"], "0x1.999999999999ap-4,0\n");
    assert!(!double.starts_with("0.99004983374916805357"), "{double}");
    assert!(double.starts_with("0.990049833749168"), "{double}");
    // Far beyond every exponent of a double.
    assert!(
        lines[3].ends_with(",5.64189583547756286948079451561e-201"),
        "{}",
        lines[3]
    );
    assert!(lines[4].contains("e434294481903251827"), "{}", lines[4]);
    let digits = |line: &str| line.split(',').next().unwrap().len();
    let many = good(&[W, "--digits", "1000"], "0.25,0.5\n");
    assert_eq!(digits(&many), 1002);
    // Fewer digits are the first of more, but for the last.
    let few = good(&[W, "--digits", "12"], "0.25,0.5\n");
    assert_eq!(few[..12], many[..12]);
}

#[test]
fn a_bad_line_ends_it() {
    let one = good(&[W], "1,1\n");
    for (bad, why) in [
        ("2", "1 numbers where 2 are due: Re z, Im z"),
        ("1,2,3", "3 numbers where 2 are due"),
        ("1;2", "is neither"),
        ("1,x", "\"x\" is neither a decimal nor a hexadecimal float"),
        ("1,", "\"\" is neither"),
        ("1,1 2", "is neither"),
        ("0x1.8q3,0", "is not a hexadecimal float"),
        ("1e,0", "is neither"),
        ("1,2 # no", "is neither"),
    ] {
        for threads in ["1", "2"] {
            let input = format!("1,1\n# skipped\n{bad}\n1,1\nworse\n");
            let d = eval(&[W, "--threads", threads], input.as_bytes());
            let line = format!("line 3 ({bad:?}): ");
            refused(&d, &[&line, why], &one);
        }
    }
    let d = eval(&[W], b"1,1\n\xff,1\n");
    refused(&d, &["line 2", "not UTF-8"], &one);
    let mut long = b"1,1\n".to_vec();
    long.resize(33 << 20, b'1');
    refused(&eval(&[W], &long), &["line 2", "longer than"], &one);
}

#[test]
fn digits_of_what_is_not_finite_or_too_large() {
    let one = good(&[W, "--digits", "5"], "1,1\n");
    for (bad, why) in [
        ("inf,0", "must be finite"),
        ("0,-nan", "must be finite"),
        ("1e100001,0", "beyond"),
        ("0x1p999999,0", "is not a hexadecimal float"),
    ] {
        let d = eval(
            &[W, "--digits", "5"],
            format!("1,1\n{bad}\n1,1\n").as_bytes(),
        );
        refused(&d, &["line 2", why], &one);
    }
}

#[test]
fn many_lines_stay_in_order_whatever_the_threads() {
    const N: usize = 100_000;
    let mut input = String::new();
    let mut due = String::new();
    let hex = mechaudit::audit::hex_float;
    for i in 0..N {
        let (x, y) = (
            (i % 317) as f64 / 16.0 - 9.0,
            (i % 1009) as f64 / 64.0 - 4.0,
        );
        if i % 1000 == 7 {
            input.push_str("# a comment\n\n");
        }
        writeln!(input, "{},{}", x, hex(y)).unwrap();
        let w = faddeeva(Complex::new(x, y));
        writeln!(due, "{},{}", hex(w.re), hex(w.im)).unwrap();
    }
    for threads in ["1", "2", "7"] {
        // Not assert_eq: a difference would print megabytes.
        assert!(good(&[W, "--threads", threads], &input) == due, "{threads}");
    }
    let some: String = input.lines().take(3000).map(|l| format!("{l}\n")).collect();
    let one = good(&[W, "--digits", "20", "--threads", "1"], &some);
    assert!(one == good(&[W, "--digits", "20", "--threads", "5"], &some));
    assert_eq!(one.lines().count(), 2994);
}

/// Whoever writes a line and waits gets the answer.
#[test]
fn answers_come_without_waiting_for_more() {
    let mut child = start(&[W]);
    let mut stdin = child.stdin.take().unwrap();
    let stdout = child.stdout.take().unwrap();
    let (send, receive) = std::sync::mpsc::channel();
    let reader = std::thread::spawn(move || {
        for line in BufReader::new(stdout).lines() {
            send.send(line.unwrap()).unwrap();
        }
    });
    for _ in 0..3 {
        stdin.write_all(b"0,0\n").unwrap();
        stdin.flush().unwrap();
        let line = receive
            .recv_timeout(Duration::from_secs(30))
            .expect("an answer");
        assert_eq!(line, "0x1p+0,0x0p+0");
    }
    drop(stdin);
    assert!(child.wait().unwrap().success());
    reader.join().unwrap();
}

#[test]
fn a_closed_pipe_ends_it_quietly() {
    let mut child = start(&[W]);
    let mut stdin = child.stdin.take().unwrap();
    let mut stdout = child.stdout.take().unwrap();
    let writer =
        std::thread::spawn(
            move || while stdin.write_all(b"1,1\n".repeat(1000).as_slice()).is_ok() {},
        );
    let mut some = [0; 10];
    stdout.read_exact(&mut some).unwrap();
    drop(stdout);
    let status = child.wait().unwrap();
    writer.join().unwrap();
    let mut err = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut err)
        .unwrap();
    assert_eq!((status.code(), err.as_str()), (Some(0), ""));
}

/// Frames are answered bit for bit as lines are; refusals are frames, what is laid out otherwise
/// ends the run.
#[test]
fn binary_frames() {
    let in_frames = |method: &str, input: &[u8]| {
        let mut child = common::program()
            .args(["eval", method])
            .env("MECHAUDIT_PROTOCOL", "binary")
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(input).unwrap();
        let o = child.wait_with_output().unwrap();
        (
            o.status.code(),
            o.stdout,
            String::from_utf8(o.stderr).unwrap(),
        )
    };
    let frame = |x: &[f64]| -> Vec<u8> {
        let count = (x.len() as u64).to_le_bytes();
        [
            &count[..],
            &x.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>(),
        ]
        .concat()
    };
    let points = [[1.5, -0.25], [0.0, 1.0], [-3.0, 1e-9], [f64::NAN, 0.0]];
    let frames: Vec<u8> = points.iter().flat_map(|p| frame(p)).collect();
    let due: Vec<u8> = (points.iter())
        .flat_map(|p| {
            let w = faddeeva(Complex::new(p[0], p[1]));
            frame(&[w.re, w.im])
        })
        .collect();
    assert_eq!(in_frames(W, &frames), (Some(0), due, String::new()));
    // A crank that cannot be joined.
    let apart = [1.0, 1.0, 1.0, 2.5, 3.0, 1.0];
    let (code, out, err) = in_frames("four-bar", &frame(&apart));
    assert_eq!(
        (code, out, err.as_str()),
        (Some(0), u64::MAX.to_le_bytes().to_vec(), "")
    );
    assert_eq!(in_frames(W, &[]), (Some(0), vec![], String::new()));
    // A chirp that is refused in words takes a frame among others.
    let chirp = |w: f64| frame(&[w, 0.5, 4.0, 1.0, 2.0, 0.3, 0.1, -2.0, 3.0]);
    let good = in_frames("chirp-response", &chirp(10.0)).1;
    let (code, out, err) = in_frames("chirp-response", &[chirp(-10.0), chirp(10.0)].concat());
    let due = [&u64::MAX.to_le_bytes()[..], &good].concat();
    assert_eq!((code, out, err.as_str()), (Some(0), due, ""));
    // Lines before it are answered.
    let good = frame(&[0.0, 1.0]);
    for (input, part) in [
        (frame(&[1.0]), "frame 2: 1 number"),
        (good[..20].to_vec(), "frame 2: cut off"),
        (u64::MAX.to_le_bytes().to_vec(), "frame 2: a refusal"),
        (1000u64.to_le_bytes().to_vec(), "frame 2: cut off"),
        (1_000_000u64.to_le_bytes().to_vec(), "frame 2 claims"),
    ] {
        let (code, out, err) = in_frames(W, &[good.clone(), input].concat());
        assert_eq!(
            (code, out.len(), err.lines().count()),
            (Some(2), 24, 1),
            "{err}"
        );
        assert!(err.contains(part), "{err}");
    }
    let program = env!("CARGO_BIN_EXE_mechaudit");
    let exec = format!("{program} eval erf");
    let d = common::run(&["audit", "erf", "--cases", "20", "--binary", "--exec", &exec]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
}

#[test]
fn usage() {
    let list = good(&["--list"], "");
    assert!(list.starts_with("tridiagonal  "), "{list}");
    assert!(good(&["--help"], "").contains("Examples:"));
    let refusal = |args: &[&str], part: &str| refused(&eval(args, b""), &[part], "");
    refusal(&[], "NAME");
    refusal(&[W, "--digits", "0"], "--digits");
    refusal(&[W, "--digits", "10001"], "--digits");
    refusal(&[W, "--threads", "0"], "--threads");
    refusal(&[W, "--threads", "many"], "--threads");
    refusal(&[W, "--list"], "--list");
}

/// The relatives of W: solver and reference under one name, in the same line protocol.
mod relatives {
    use super::*;

    /// 30 digits by mpmath 1.3 at 60 digits.
    #[test]
    fn certified_digits_at_one_and_a_half() {
        let digits = [
            ("erf", ERF),
            ("erfc", ERFC),
            ("erfcx", ERFCX),
            ("erfi", ERFI),
            ("dawson", DAWSON),
            ("faddeeva-derivative", W_DERIVATIVE),
        ];
        for (name, due) in digits {
            let out = good(&[name, "--digits", "30"], "1.5,-0.25\n");
            assert_eq!(out.trim_end(), due, "{name}");
        }
        let out = good(&["voigt", "--digits", "30"], "0.5,1.5,0.25\n");
        assert_eq!(out.trim_end(), VOIGT);
    }

    #[test]
    fn beyond_every_exponent() {
        // F(iy) = i (√π/2) e^{y²} erf y, and erfc(10^6) ~ e^{-10^12}.
        let out = good(&["dawson", "--digits", "8"], "0,1e10\n");
        assert!(
            out.starts_with("0,") && out.contains("e43429448190325182"),
            "{out}"
        );
        let out = good(&["erfc", "--digits", "8"], "1e6,0\n");
        assert!(out.contains("e-43429448") && out.ends_with(",0\n"), "{out}");
        let out = good(&["voigt", "--digits", "8"], "1e12,1,0\n");
        assert!(out.contains("e-2171472409516259"), "{out}");
    }

    #[test]
    fn wrong_lines() {
        let d = eval(&["voigt"], b"1,1,1\n1,1\n");
        let one = good(&["voigt"], "1,1,1\n");
        refused(&d, &["line 2", "3 are due: x, sigma, gamma"], &one);
        // No density: nothing can be certified, which is a finding.
        let d = eval(&["voigt", "--digits", "5"], b"0,-1,1\n");
        assert_eq!(d.code, 1, "{}", d.err);
        said(&d, "σ ≥ 0");
        let list = good(&["--list"], "");
        assert_eq!(
            list.lines().count(),
            mechaudit::methods::registry().len(),
            "{list}"
        );
    }

    const ERF: &str = "0.977075892537154476271289580721,-0.0275503504607330975612928446825";
    const ERFC: &str = "0.0229241074628455237287104192789,0.0275503504607330975612928446825";
    const ERFCX: &str = "0.316877774605057178129687280066,0.0403961692615149384749174982810";
    const ERFI: &str = "3.65608742891315335552057984054,-2.38665832372883391444177417179";
    const DAWSON: &str = "0.427751810570010655085803671336,0.0741602497455792348829448128222";
    const W_DERIVATIVE: &str =
        "-0.274808995763108479722115592740,-0.549846608568289185888578088379";
    const VOIGT: &str = "0.222873634811780506387463876075";
}
