//! How much does a metal reflect at one wavelength? Fresnel's equations for a complex index n + i k.

/// The mean of both polarisations at cosine `mu` of 0..1, 1 at grazing: |amplitude|^2, in complex numbers.
pub fn f(n: f64, k: f64, mu: f64) -> f64 {
    if mu <= 0.0 {
        return 1.0;
    }
    // w = sqrt((n + i k)^2 - sin^2) = a + i b.
    let sine2 = 1.0 - mu * mu;
    let (re, im) = (n * n - k * k - sine2, 2.0 * n * k);
    let modulus = re.hypot(im);
    let a = (0.5 * (modulus + re)).max(0.0).sqrt();
    let b = (0.5 * (modulus - re)).max(0.0).sqrt();
    let s = ((mu - a).powi(2) + b * b) / ((mu + a).powi(2) + b * b);
    // (n + i k)^2 mu = x + i y.
    let (x, y) = ((n * n - k * k) * mu, 2.0 * n * k * mu);
    let p = ((x - a).powi(2) + (y - b).powi(2)) / ((x + a).powi(2) + (y + b).powi(2));
    0.5 * (s + p)
}
