//! Is the truth at vectors of 32 bits the papers', and right to a part in 10^12?

use dashu_float::FBig;
use dashu_float::ops::SquareRoot;
use glam::{DVec3, Vec3};
use umber::interface::ProbeInput;
use umber::reference::coupled::Coupled;
use umber::reference::given::{self, Given};
use umber::reference::{beckmann, cook_torrance, oren_nayar, schlick, v_cavity};
use umber::studies::stability::CASES;

use crate::samples::assert_close;
use crate::tolerances::{GIVEN_BY_DIGITS, GIVEN_BY_PAPER};

/// An input's vectors, and what the truth sees of them.
fn seen(input: &ProbeInput) -> ([Vec3; 3], Given) {
    let vectors = [input.normal, input.light, input.eye].map(Vec3::from);
    (vectors, Given::new(vectors[0], vectors[1], vectors[2]))
}

/// Ordinary inputs: no smoother than 0.3, no lower than 0.2 above the surface.
fn ordinary() -> Vec<ProbeInput> {
    let generic = CASES.iter().find(|case| case.name == "generic");
    let inputs = generic.map_or_else(Vec::new, |case| case.inputs(3, 4000));
    let inputs = inputs.into_iter().filter(|input| {
        let (_, at) = seen(input);
        at.least_cosine() > 0.2 && input.roughness > 0.3
    });
    let inputs: Vec<_> = inputs.collect();
    assert!(inputs.len() > 100, "{}", inputs.len());
    inputs
}

#[test]
fn unit_vectors_give_what_the_papers_say() {
    for input in ordinary() {
        let (vectors, at) = seen(&input);
        let [n, l, e] = vectors.map(|v| v.as_dvec3().normalize());
        let (m, f0) = (f64::from(input.roughness), f64::from(input.f0));
        let h = (l + e).normalize();
        let grey = DVec3::splat(f0);
        let coupled = Coupled::corrected(DVec3::ONE, grey, m);
        let both = coupled.diffuse(n, l, e) + coupled.specular(n, l, e, 0.0);
        for (what, got, want) in [
            (
                "oren-nayar",
                given::oren_nayar(&at, m),
                oren_nayar::lobe(n, l, e, m),
            ),
            (
                "conserving",
                given::conserving_oren_nayar(&at, m),
                oren_nayar::conserving_lobe(n, l, e, m),
            ),
            ("d", given::beckmann_d(&at, m), beckmann::d(n, h, m)),
            ("g", given::v_cavity_g(&at), v_cavity::g(n, l, e)),
            ("f", given::schlick_f(&at, f0), schlick::f(grey, l.dot(h)).x),
            (
                "cook-torrance",
                given::cook_torrance(&at, m, f0),
                cook_torrance::lobe(n, l, e, m, grey).x,
            ),
            ("corrected", given::corrected(&at, m, f0), both.x),
        ] {
            assert_close(got, want, GIVEN_BY_PAPER, what);
        }
    }
}

#[test]
fn the_listing_where_it_is_defined_is_its_formula() {
    for input in ordinary() {
        let (vectors, at) = seen(&input);
        let [n, l, e] = vectors.map(|v| v.as_dvec3().normalize());
        let (m, f0) = (f64::from(input.roughness), f64::from(input.f0));
        let want = umber::reference::slides::cook_torrance::cook_torrance(n, l, e, m, f0);
        let got = given::slides_cook_torrance(&at, m, f0);
        assert_close(got, want, GIVEN_BY_PAPER, "slides");
    }
}

/// 200 bits.
type Big = FBig;

const BITS: usize = 200;

fn big(x: f64) -> Big {
    let exact = Big::try_from(x).expect("finite");
    exact.with_precision(BITS).value()
}

fn dot(a: Vec3, b: Vec3) -> Big {
    let product = |x: f32, y: f32| big(x.into()) * big(y.into());
    product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z)
}

/// The same formulas by digits alone, apart from the truth's own code.
struct Digits {
    nol: Big,
    noe: Big,
    s: Big,
    noh: Big,
    sine2: Big,
    hh: Big,
    difference2: Big,
}

impl Digits {
    fn new([n, l, e]: [Vec3; 3]) -> Self {
        let (nol, noe) = (dot(n, l), dot(n, e));
        let sum: [Big; 3] = std::array::from_fn(|i| big(l[i].into()) + big(e[i].into()));
        let apart: [Big; 3] = std::array::from_fn(|i| big(l[i].into()) - big(e[i].into()));
        let square =
            |v: &[Big; 3]| v[0].clone() * &v[0] + v[1].clone() * &v[1] + v[2].clone() * &v[2];
        let n: [Big; 3] = std::array::from_fn(|i| big(n[i].into()));
        let cross: [Big; 3] = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            n[j].clone() * &sum[k] - n[k].clone() * &sum[j]
        });
        Self {
            s: dot(l, e) - nol.clone() * &noe,
            noh: nol.clone() + &noe,
            sine2: square(&cross),
            hh: square(&sum),
            difference2: square(&apart),
            nol,
            noe,
        }
    }

    fn oren_nayar(&self, sigma: f64) -> Big {
        let sigma2 = big(sigma) * big(sigma);
        let a = big(1.0) - big(0.5) * &sigma2 / (sigma2.clone() + big(33.0) / big(100.0));
        let b = big(45.0) / big(100.0) * &sigma2 / (sigma2.clone() + big(9.0) / big(100.0));
        let s = if self.s > big(0.0) {
            self.s.clone()
        } else {
            big(0.0)
        };
        let steeper = if self.nol >= self.noe {
            &self.nol
        } else {
            &self.noe
        };
        a * &self.nol + b * s * &self.nol / steeper
    }

    fn d(&self, m: f64) -> Big {
        let noh2 = self.noh.clone() * &self.noh;
        let m2 = big(m) * big(m);
        let exponent = self.sine2.clone() / &noh2 / &m2;
        let secant2 = self.hh.clone() / &noh2;
        (-exponent).exp() * secant2.clone() * secant2 / (pi() * m2)
    }

    fn g(&self) -> Big {
        let least = if self.nol < self.noe {
            &self.nol
        } else {
            &self.noe
        };
        let g = big(4.0) * &self.noh * least / &self.hh;
        if g < big(1.0) { g } else { big(1.0) }
    }

    fn f(&self, f0: f64) -> Big {
        let x = self.difference2.clone() / (big(4.0) + big(2.0) * self.hh.sqrt());
        let f90 = if 50.0 * f0 < 1.0 {
            big(50.0) * big(f0)
        } else {
            big(1.0)
        };
        let x2 = x.clone() * &x;
        big(f0) + (f90 - big(f0)) * (x2.clone() * x2 * x)
    }
}

/// By Machin 1706: 16 atan(1/5) - 4 atan(1/239).
fn pi() -> Big {
    let atan_of_inverse = |x: f64| {
        let mut power = big(1.0) / big(x);
        let mut sum = big(0.0);
        // 1/5 to the power of 2 k + 1 leaves 200 bits at k = 43.
        for k in 0..45 {
            let term = power.clone() / big(f64::from(2 * k + 1));
            sum = if k % 2 == 0 { sum + term } else { sum - term };
            power /= big(x) * big(x);
        }
        sum
    };
    big(16.0) * atan_of_inverse(5.0) - big(4.0) * atan_of_inverse(239.0)
}

#[test]
fn the_truth_is_right_to_a_part_in_a_million_million() {
    assert_eq!(pi().to_f64().value(), std::f64::consts::PI);
    let mut compared = 0;
    for case in CASES {
        for input in case.inputs(5, 100) {
            let (vectors, at) = seen(&input);
            let (m, f0) = (f64::from(input.roughness), f64::from(input.f0));
            if at.least_cosine() < 1e-8 || m < 1e-4 || at.beckmann_exponent(m) > 100.0 {
                continue;
            }
            let digits = Digits::new(vectors);
            let cook_torrance = digits.d(m) * digits.g() * digits.f(f0) / (big(4.0) * &digits.noe);
            for (what, got, want) in [
                (
                    "oren-nayar",
                    given::oren_nayar(&at, m),
                    digits.oren_nayar(m),
                ),
                ("d", given::beckmann_d(&at, m), digits.d(m)),
                ("g", given::v_cavity_g(&at), digits.g()),
                ("f", given::schlick_f(&at, f0), digits.f(f0)),
                (
                    "cook-torrance",
                    given::cook_torrance(&at, m, f0),
                    cook_torrance,
                ),
            ] {
                let what = format!("{what}, {}: {input:?}", case.name);
                assert_close(got, want.to_f64().value(), GIVEN_BY_DIGITS, &what);
            }
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}
