use mechaudit::solvers::faddeeva as s; use num_complex::Complex;
fn main(){ for (x,y) in [(0.0,-40.0),(7588.4,-11914.7),(1e-310,-5.0),(0.0,-30.0),(1.0,-38.7),(1.0,-50.0)] { println!("{x} {y} {:?}", s::faddeeva(Complex::new(x,y))); } }
