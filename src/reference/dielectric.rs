//! How much does a clear interface reflect? Fresnel 1823, light that is not polarised, from the outside.

/// The mean of both polarisations for the index that has this f0 (0..1), at cosine `mu` of 0..1.
pub fn f(f0: f64, mu: f64) -> f64 {
    if f0 >= 1.0 || mu <= 0.0 {
        // A mirror; and at grazing everything is one, but for no interface.
        return if f0 > 0.0 { 1.0 } else { 0.0 };
    }
    let index = (1.0 + f0.sqrt()) / (1.0 - f0.sqrt());
    // Snell.
    let inside = (1.0 - (1.0 - mu * mu) / (index * index)).sqrt();
    let s = (mu - index * inside) / (mu + index * inside);
    let p = (index * mu - inside) / (index * mu + inside);
    0.5 * (s * s + p * p)
}
