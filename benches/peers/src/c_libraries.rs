//! C and C++ libraries, opened at run time where they are installed.

use crate::code::{Code, Codes, Scalar, Shape};
use libloading::Library;
use num_complex::Complex64;
use std::ffi::{OsString, c_int, c_void};
use std::path::{Path, PathBuf};
use std::process::Command;

/// `double complex` and `std::complex<double>` as the C calling conventions in use (System V
/// x86-64, AArch64) return them: like a structure of two doubles.
#[repr(C)]
#[derive(Clone, Copy)]
struct CComplex {
    re: f64,
    im: f64,
}

type Plain = unsafe extern "C" fn(CComplex) -> CComplex;
/// `mechaudit_batch`.
type Batch =
    unsafe extern "C" fn(c_int, usize, *const f64, isize, *mut f64, isize, *mut c_void) -> c_int;
type WithTolerance = unsafe extern "C" fn(CComplex, f64) -> CComplex;

/// Adds this project's own C library, where `MECHAUDIT_DIR` has it, libcerf, in as many versions as
/// `LIBCERF_DIR` lists, and the MIT Faddeeva package.
pub fn add(codes: &mut Codes) {
    if !cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) || cfg!(windows) {
        let reason = "C calling convention for complex numbers not known on this target";
        codes.add("libcerf", Err(reason.into()));
        codes.add("MIT Faddeeva", Err(reason.into()));
        return;
    }
    if let Some(folder) = folders("MECHAUDIT_DIR").first() {
        match library_in(folder, &["libmechaudit"]).map(|path| own(&path)) {
            Some(Ok([scalar, batch])) => codes.found.extend([scalar, batch]),
            Some(Err(e)) => codes.add("mechaudit C", Err(e)),
            None => {
                let reason = format!("no libmechaudit in {}", folder.display());
                codes.add("mechaudit C", Err(reason));
            }
        }
    }
    let stems = ["libcerf"];
    let given = folders("LIBCERF_DIR");
    if given.is_empty() {
        let found = pkg_config_folder("libcerf").and_then(|d| library_in(&d, &stems));
        let path = found.unwrap_or_else(|| PathBuf::from(file_name("libcerf")));
        let outcome = libcerf(&path)
            .map_err(|e| format!("neither LIBCERF_DIR nor pkg-config nor the loader has it: {e}"));
        codes.add("libcerf", outcome);
    }
    for folder in &given {
        let outcome = match library_in(folder, &stems) {
            Some(path) => libcerf(&path),
            None => Err(format!("no libcerf in {}", folder.display())),
        };
        codes.add("libcerf", outcome);
    }

    let stems = ["libfaddeeva", "libFaddeeva", "libopenspecfun"];
    let outcome = match folders("FADDEEVA_DIR").first() {
        Some(folder) => match library_in(folder, &stems) {
            Some(path) => mit(&path),
            None => Err(format!(
                "none of {} in {}",
                stems.map(file_name).join(", "),
                folder.display()
            )),
        },
        None => mit(Path::new(&file_name("libopenspecfun")))
            .map_err(|e| format!("FADDEEVA_DIR is not set, and no openspecfun: {e}")),
    };
    codes.add("MIT Faddeeva", outcome);
}

fn file_name(stem: &str) -> String {
    format!("{stem}{}", std::env::consts::DLL_SUFFIX)
}

/// The folders an environment variable lists.
fn folders(variable: &str) -> Vec<PathBuf> {
    let value: OsString = std::env::var_os(variable).unwrap_or_default();
    std::env::split_paths(&value)
        .filter(|p| !p.as_os_str().is_empty())
        .collect()
}

fn pkg_config_folder(package: &str) -> Option<PathBuf> {
    let output = Command::new("pkg-config")
        .args(["--variable=libdir", package])
        .output()
        .ok()
        .filter(|o| o.status.success())?;
    let folder = String::from_utf8(output.stdout).ok()?;
    Some(PathBuf::from(folder.trim()))
}

/// A library of one of these names in the folder or its `lib`.
fn library_in(folder: &Path, stems: &[&str]) -> Option<PathBuf> {
    let folders = [folder.to_owned(), folder.join("lib")];
    let mut paths = folders
        .iter()
        .flat_map(|f| stems.iter().map(|s| f.join(file_name(s))));
    paths.find(|p| p.exists())
}

/// Opens a library for the rest of the run.
fn open(path: &Path) -> Result<&'static Library, String> {
    // SAFETY: loading runs the library's initialisers; that is what naming it asks for.
    let library = unsafe { Library::new(path) }.map_err(|e| e.to_string())?;
    // Objects linked with -ffast-math may switch the whole process to flush-to-zero.
    let half = std::hint::black_box(f64::MIN_POSITIVE) / 2.0;
    if std::hint::black_box(half) == 0.0 {
        eprintln!(
            "{} turned subnormal numbers off for this process: nothing measured here is valid",
            path.display()
        );
        std::process::exit(1);
    }
    Ok(Box::leak(Box::new(library)))
}

/// The name of the file itself; it usually carries the version.
fn file(path: &Path) -> String {
    let real = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = real.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// The project's function through its C interface.
fn own(path: &Path) -> Result<[Box<dyn Code>; 2], String> {
    let library = open(path)?;
    // SAFETY: mechaudit.h: `double _Complex mechaudit_faddeeva_c(double _Complex)`.
    let w: Plain = *unsafe { library.get(b"mechaudit_faddeeva_c\0") }.map_err(|e| e.to_string())?;
    // SAFETY: mechaudit.h: `mechaudit_status mechaudit_batch(int function, size_t n, const double
    // *z, ptrdiff_t incz, double *w, ptrdiff_t incw, mechaudit_error *error)`.
    let batch: Batch = *unsafe { library.get(b"mechaudit_batch\0") }.map_err(|e| e.to_string())?;
    let scalar = Scalar {
        name: "mechaudit C".into(),
        version: file(path),
        own: true,
        w: move |z: Complex64| {
            // SAFETY: a pure function of its argument.
            let r = unsafe { w(CComplex { re: z.re, im: z.im }) };
            Complex64::new(r.re, r.im)
        },
    };
    let batch = CBatch {
        version: file(path),
        batch,
    };
    Ok([Box::new(scalar), Box::new(batch)])
}

/// The project's batches through its C interface.
struct CBatch {
    version: String,
    batch: Batch,
}

impl Code for CBatch {
    fn name(&self) -> &str {
        "mechaudit C batch"
    }
    fn version(&self) -> &str {
        &self.version
    }
    fn shape(&self) -> Shape {
        Shape::Batch
    }
    fn own(&self) -> bool {
        true
    }
    fn evaluate(&self, z: &[Complex64], out: &mut [Complex64]) {
        assert_eq!(z.len(), out.len());
        let (from, to) = (z.as_ptr().cast(), out.as_mut_ptr().cast());
        // SAFETY: both hold that number of complex numbers, one after another; NULL asks for no
        // message.
        let status = unsafe { (self.batch)(0, z.len(), from, 1, to, 1, std::ptr::null_mut()) };
        assert_eq!(status, 0, "status of mechaudit_batch");
    }
}

fn libcerf(path: &Path) -> Result<Box<dyn Code>, String> {
    let library = open(path)?;
    // SAFETY: cerf.h of all versions: `double _Complex w_of_z(double _Complex)`.
    let w: Plain = *unsafe { library.get(b"w_of_z\0") }.map_err(|e| e.to_string())?;
    Ok(Box::new(Scalar {
        name: match file(path).split_once(".so.") {
            Some((_, version)) => format!("libcerf {version}"),
            None => "libcerf".into(),
        },
        version: file(path),
        own: false,
        w: move |z: Complex64| {
            // SAFETY: a pure function of its argument.
            let r = unsafe { w(CComplex { re: z.re, im: z.im }) };
            Complex64::new(r.re, r.im)
        },
    }))
}

fn mit(path: &Path) -> Result<Box<dyn Code>, String> {
    let library = open(path)?;
    let c_name = b"Faddeeva_w\0".as_slice();
    let cpp_name = b"_ZN8Faddeeva1wESt7complexIdEd\0".as_slice();
    // SAFETY: Faddeeva.h: `double complex Faddeeva_w(double complex, double relerr)`, Faddeeva.hh:
    // `std::complex<double> Faddeeva::w(std::complex<double>, double relerr)`.
    let found = unsafe { library.get::<WithTolerance>(c_name) }
        .or_else(|_| unsafe { library.get::<WithTolerance>(cpp_name) });
    let w: WithTolerance = *found.map_err(|e| e.to_string())?;
    Ok(Box::new(Scalar {
        name: "MIT Faddeeva".into(),
        version: file(path),
        own: false,
        w: move |z: Complex64| {
            // SAFETY: a pure function of its arguments; 0 asks for full accuracy.
            let r = unsafe { w(CComplex { re: z.re, im: z.im }, 0.0) };
            Complex64::new(r.re, r.im)
        },
    }))
}
