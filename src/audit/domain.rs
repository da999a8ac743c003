//! Where a method is audited: named regions with a sampler each, and named check points.

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use std::cell::{Cell, RefCell};
use std::sync::Arc;

/// A value-stable stream of random numbers for one case.
///
/// ChaCha8 keyed by the seed; the stream number is a hash of method, region and index, so a case
/// can be drawn again without drawing those before it. The conversions to floats are written here
/// so that no dependency's update can change them, and logarithms
/// and exponentials are those of `libm`, which takes the same steps on every machine.
pub struct Draw(ChaCha8Rng);

/// The key of ChaCha8, expanded from a seed.
pub(super) type Key = [u8; 32];

impl Draw {
    /// The stream of one case.
    pub fn new(seed: u64, method: &str, region: &str, index: u64) -> Draw {
        Draw::of(&Draw::keyed(seed), Draw::named(method, region), index)
    }

    /// Returns the key that all streams of a seed share.
    pub(super) fn keyed(seed: u64) -> Key {
        ChaCha8Rng::seed_from_u64(seed).get_seed()
    }

    /// Returns the hash that the streams of a region share.
    ///
    /// A study is named by the path of its file; its streams do not depend on the folder.
    pub(super) fn named(method: &str, region: &str) -> u64 {
        let method = method.rsplit(['/', '\\']).next().unwrap_or(method);
        let names = method.bytes().chain([0]).chain(region.bytes()).chain([0]);
        hashed(0xcbf2_9ce4_8422_2325, names)
    }

    /// [`Draw::new`], the seed expanded and the names hashed before.
    fn of(keyed: &Key, named: u64, index: u64) -> Draw {
        let mut draw = Draw(ChaCha8Rng::from_seed(*keyed));
        draw.restart(named, index);
        draw
    }

    /// Begins the stream of another case of the same seed.
    fn restart(&mut self, named: u64, index: u64) {
        self.0.set_stream(hashed(named, index.to_le_bytes()));
    }

    /// Draws from the stream of one case; the generator is kept for the next one of the seed.
    pub(super) fn with<T>(
        keyed: &Key,
        named: u64,
        index: u64,
        draw: impl FnOnce(&mut Draw) -> T,
    ) -> T {
        thread_local! {
            static KEPT: RefCell<Option<(Key, Draw)>> = const { RefCell::new(None) };
        }
        KEPT.with(|kept| match kept.try_borrow_mut().as_deref_mut() {
            Ok(Some((key, kept))) if key == keyed => {
                kept.restart(named, index);
                draw(kept)
            }
            Ok(kept) => {
                let new = Draw::of(keyed, named, index);
                draw(&mut kept.insert((*keyed, new)).1)
            }
            // A sampler that draws from another stream.
            Err(_) => draw(&mut Draw::of(keyed, named, index)),
        })
    }

    /// Uniform on `[0, 1)` with 53 bits.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * 2f64.powi(-53)
    }

    /// Uniform on `[lo, hi)`.
    pub fn uniform(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// Log-uniform on `[lo, hi)`, both positive.
    pub fn log_uniform(&mut self, lo: f64, hi: f64) -> f64 {
        libm::exp(self.uniform(log(lo), log(hi)))
    }

    /// An integer in `lo..=hi`.
    pub fn integer(&mut self, lo: usize, hi: usize) -> usize {
        lo + (self.unit() * (hi - lo + 1) as f64) as usize
    }

    /// `x` or `−x`.
    pub fn signed(&mut self, x: f64) -> f64 {
        if self.0.next_u64() >> 63 == 0 { x } else { -x }
    }

    /// [`log_uniform`](Draw::log_uniform) of either sign.
    pub fn log_signed(&mut self, lo: f64, hi: f64) -> f64 {
        let x = self.log_uniform(lo, hi);
        self.signed(x)
    }

    /// Zero with probability `p`, log-uniform otherwise.
    pub fn zero_or_log(&mut self, p: f64, lo: f64, hi: f64) -> f64 {
        if self.chance(p) {
            0.0
        } else {
            self.log_uniform(lo, hi)
        }
    }

    /// Uniform on the first range with probability `p`, log-uniform on the second otherwise.
    pub fn uniform_or_log(&mut self, p: f64, [a, b]: [f64; 2], [lo, hi]: [f64; 2]) -> f64 {
        match self.chance(p) {
            true => self.uniform(a, b),
            false => self.log_uniform(lo, hi),
        }
    }

    /// A random element.
    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.integer(0, all.len() - 1)]
    }

    /// Any bits: zeros, infinities, NaN and subnormal numbers among them.
    pub fn any_bits(&mut self) -> f64 {
        let mut half = || self.integer(0, u32::MAX as usize) as u64;
        f64::from_bits(half() << 32 | half())
    }

    /// True with probability `p`.
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }
}

/// The logarithm of an end of a range: samplers name the same few for every case.
fn log(x: f64) -> f64 {
    const KEPT: usize = 16;
    thread_local! {
        static KNOWN: [Cell<(f64, f64)>; KEPT] = const { [const { Cell::new((1.0, 0.0)) }; KEPT] };
    }
    KNOWN.with(|known| {
        let place = x.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 60;
        let place = &known[place as usize];
        let (of, log) = place.get();
        if of == x {
            return log;
        }
        let log = libm::log(x);
        place.set((x, log));
        log
    })
}

/// FNV-1a of more bytes.
fn hashed(hash: u64, bytes: impl IntoIterator<Item = u8>) -> u64 {
    let add = |h: u64, b: u8| (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.into_iter().fold(hash, add)
}

/// Draws one input of a region.
pub type Sampler = Arc<dyn Fn(&mut Draw) -> Vec<f64> + Send + Sync>;

/// A part of the domain.
#[derive(Clone)]
pub struct Region {
    /// The name, without spaces.
    pub name: &'static str,
    /// The inputs of the region, in words and with ranges.
    pub description: &'static str,
    /// Draws one input.
    pub sample: Sampler,
}

impl Region {
    /// Creates a region from a function or a closure that draws one input.
    pub fn new(
        name: &'static str,
        description: &'static str,
        sample: impl Fn(&mut Draw) -> Vec<f64> + Send + Sync + 'static,
    ) -> Region {
        Region {
            name,
            description,
            sample: Arc::new(sample),
        }
    }
}

/// One input that is always audited.
#[derive(Clone)]
pub struct CheckPoint {
    /// Its name, without spaces.
    pub name: &'static str,
    /// The input.
    pub input: Vec<f64>,
}

/// Where a method is audited.
#[derive(Clone, Default)]
pub struct Domain {
    /// Regions sampled at random; seams between algorithms are regions of their own.
    pub regions: Vec<Region>,
    /// Points audited in every run.
    pub check_points: Vec<CheckPoint>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stream_is_pinned() {
        // These values may never change: recorded cases are found again through them.
        let mut d = Draw::new(1, "method", "region", 0);
        let got = [d.unit(), d.uniform(-1.0, 1.0)].map(crate::hex_float);
        assert_eq!(got, ["0x1.899eab3e7ef18p-3", "0x1.1f892ec63e588p-3"]);
        let got = crate::hex_float(d.log_uniform(1e-3, 1e3));
        assert_eq!(got, "0x1.79452ee7f2e8p+8");
        let first = Draw::new(1, "method", "region", 0).unit();
        assert_ne!(Draw::new(1, "method", "region", 1).unit(), first);
        assert_ne!(Draw::new(2, "method", "region", 0).unit(), first);
    }

    /// Bit for bit those of `libm`, whatever was asked before.
    #[test]
    fn logarithms_of_ends() {
        for _ in 0..2 {
            for k in -400..400 {
                let x = f64::from(k).mul_add(0.37, 0.1).exp2();
                assert_eq!(log(x).to_bits(), libm::log(x).to_bits(), "{x}");
            }
        }
        assert_eq!(log(1.0), 0.0);
    }

    /// Streams are the same whichever came before, and inside one another.
    #[test]
    fn a_generator_that_is_kept_draws_the_same() {
        let all = [(1, 0), (1, 1), (2, 1), (2, 0), (1, 0)];
        let named = Draw::named("method", "region");
        for words in [1, 3, 40] {
            for (seed, index) in all {
                let due = Draw::new(seed, "method", "region", index);
                let drawn = |d: &mut Draw| -> Vec<f64> { (0..words).map(|_| d.unit()).collect() };
                let key = Draw::keyed(seed);
                let (inside, around) = Draw::with(&key, named, index, |d| {
                    (Draw::with(&key, named, index, drawn), drawn(d))
                });
                let due = drawn(&mut { due });
                assert_eq!((&inside, &around), (&due, &due));
            }
        }
    }

    #[test]
    fn choices_and_mixtures_of_ranges() {
        let all = |f: &dyn Fn(&mut Draw) -> f64| -> Vec<f64> {
            let draw = |i| f(&mut Draw::new(1, "method", "region", i));
            (0..400).map(draw).collect()
        };
        let share = |x: &[f64], f: &dyn Fn(f64) -> bool| {
            x.iter().filter(|x| f(**x)).count() as f64 / x.len() as f64
        };
        let signed = all(&|d| d.log_signed(1e-3, 1e3));
        assert!(signed.iter().all(|x| (1e-3..=1e3).contains(&x.abs())));
        assert!((0.4..0.6).contains(&share(&signed, &|x| x < 0.0)));
        assert!((0.4..0.6).contains(&share(&signed, &|x| x.abs() < 1.0)));
        let zero = all(&|d| d.zero_or_log(0.25, 1e-3, 1e3));
        assert!((0.2..0.3).contains(&share(&zero, &|x| x == 0.0)));
        assert!(zero.iter().all(|x| *x == 0.0 || (1e-3..=1e3).contains(x)));
        let mixed = all(&|d| d.uniform_or_log(0.25, [-2.0, -1.0], [1e-3, 1e3]));
        assert!((0.2..0.3).contains(&share(&mixed, &|x| (-2.0..=-1.0).contains(&x))));
        assert!((0.7..0.8).contains(&share(&mixed, &|x| (1e-3..=1e3).contains(&x))));
        let one = all(&|d| d.one_of(&[3.0, 5.0, 7.0]));
        for k in [3.0, 5.0, 7.0] {
            assert!((0.25..0.42).contains(&share(&one, &|x| x == k)), "{k}");
        }
        let bits = all(&|d| d.any_bits());
        assert!((0.4..0.6).contains(&share(&bits, &|x| x.is_sign_negative())));
        assert!((0.4..0.6).contains(&share(&bits, &|x| x.abs() < 1.0)));
        assert!((0.4..0.6).contains(&share(&bits, &|x| x.to_bits() & 1 == 1)));
    }

    #[test]
    fn a_closure_draws_with_what_it_holds() {
        let ends = [3.0, 5.0];
        let region = Region::new("between", "", move |d| vec![d.uniform(ends[0], ends[1])]);
        let input = |r: &Region| (r.sample)(&mut Draw::new(1, "method", r.name, 0));
        assert!((3.0..5.0).contains(&input(&region)[0]));
        assert_eq!(input(&region.clone()), input(&region));
    }

    #[test]
    fn a_chance_is_below_its_share() {
        let draw = || Draw::new(1, "method", "region", 0);
        let share = draw().unit();
        assert!(!draw().chance(share) && draw().chance(share.next_up()));
    }

    #[test]
    fn ranges() {
        let mut d = Draw::new(7, "m", "r", 3);
        for _ in 0..1000 {
            assert!((2.0..3.0).contains(&d.uniform(2.0, 3.0)));
            assert!((3..=5).contains(&d.integer(3, 5)));
            assert!(d.signed(1.0).abs() == 1.0);
        }
    }

    /// Integers, signs and chances of one stream, as they follow from its next number on [0, 1).
    #[test]
    fn choices_are_pinned() {
        let stream = || Draw::new(7, "m", "r", 3);
        let (mut d, mut plain) = (stream(), stream());
        let mut drawn = [0; 6];
        for _ in 0..600 {
            let k = d.integer(4, 9);
            assert_eq!(k, 4 + (6.0 * plain.unit()) as usize);
            drawn[k - 4] += 1;
        }
        // Both ends are in, and no number is left out.
        assert!(drawn.iter().all(|n| (70..130).contains(n)), "{drawn:?}");
        let (mut d, mut plain) = (stream(), stream());
        let mut negative = 0;
        for _ in 0..100 {
            let x = d.signed(3.0);
            assert_eq!(x, if plain.unit() < 0.5 { 3.0 } else { -3.0 });
            negative += usize::from(x < 0.0);
        }
        assert!((35..65).contains(&negative), "{negative}");
        for p in [0.0, 0.25, 0.75, 1.0] {
            let (mut d, mut plain) = (stream(), stream());
            for _ in 0..100 {
                assert_eq!(d.chance(p), plain.unit() < p);
            }
        }
        let one = stream().integer(5, 5);
        assert_eq!(one, 5);
    }
}
