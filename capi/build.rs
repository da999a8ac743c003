//! Where `double _Complex` is passed like a structure of two doubles.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(complex_by_value)");
    let target = |part: &str| std::env::var(format!("CARGO_CFG_TARGET_{part}")).unwrap_or_default();
    if ["x86_64", "aarch64"].contains(&target("ARCH").as_str()) && target("FAMILY") == "unix" {
        println!("cargo::rustc-cfg=complex_by_value");
    }
}
