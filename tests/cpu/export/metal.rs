//! Does a C++ compiler, which Metal's is at heart, take an exported text?

use std::process::Command;

/// What the text uses of Metal's library, as C++ has it: enough to check names, types and calls.
const LIBRARY: &str = r"
#pragma once
#include <cmath>
#define constant static const
#define thread
namespace metal {
using uint = unsigned int;
using std::abs; using std::acos; using std::asin; using std::atan2; using std::ceil; using std::cos; using std::exp;
using std::exp2; using std::floor; using std::log; using std::log2; using std::pow; using std::sin; using std::sqrt;
using std::tan;
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a < b ? b : a; }
inline float clamp(float x, float a, float b) { return min(max(x, a), b); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline float rsqrt(float x) { return 1.0f / sqrt(x); }
template <int N> struct vec;
template <> struct vec<2> {
    float x, y;
    vec() : x(0), y(0) {}
    explicit vec(float a) : x(a), y(a) {}
    vec(float a, float b) : x(a), y(b) {}
};
template <> struct vec<3> {
    float x, y, z;
    vec() : x(0), y(0), z(0) {}
    explicit vec(float a) : x(a), y(a), z(a) {}
    vec(float a, float b, float c) : x(a), y(b), z(c) {}
};
template <> struct vec<4> {
    float x, y, z, w;
    vec() : x(0), y(0), z(0), w(0) {}
    explicit vec(float a) : x(a), y(a), z(a), w(a) {}
    vec(float a, float b, float c, float d) : x(a), y(b), z(c), w(d) {}
};
using float2 = vec<2>;
using float3 = vec<3>;
using float4 = vec<4>;
#define EACH(op) \
    template <int N> vec<N> operator op(vec<N>, vec<N>); \
    template <int N> vec<N> operator op(vec<N>, float); \
    template <int N> vec<N> operator op(float, vec<N>);
EACH(+) EACH(-) EACH(*) EACH(/)
template <int N> vec<N> operator-(vec<N>);
template <int N> vec<N> min(vec<N>, vec<N>);
template <int N> vec<N> max(vec<N>, vec<N>);
template <int N> vec<N> clamp(vec<N>, vec<N>, vec<N>);
template <int N> vec<N> mix(vec<N>, vec<N>, vec<N>);
template <int N> vec<N> pow(vec<N>, vec<N>);
template <int N> vec<N> exp(vec<N>);
template <int N> vec<N> abs(vec<N>);
template <int N> vec<N> sqrt(vec<N>);
template <int N> vec<N> normalize(vec<N>);
template <int N> float dot(vec<N>, vec<N>);
template <int N> float length(vec<N>);
float3 cross(float3, float3);
}
";

/// Whether it is well-formed; what the compiler says where it is not. The compiler is the one that glslang was built with.
pub fn compiled(text: &str) -> Result<(), String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder"))
            .and_then(|()| std::fs::write(&path, text))
    };
    for (name, text) in [
        ("metal_stdlib", LIBRARY),
        ("simd/simd.h", ""),
        ("library.cpp", text),
    ] {
        write(name, text).map_err(|error| error.to_string())?;
    }
    let compiler = std::env::var_os("CXX").unwrap_or_else(|| "c++".into());
    let output = Command::new(compiler)
        .current_dir(folder.path())
        .args(["-std=c++17", "-fsyntax-only", "-I.", "library.cpp"])
        .output()
        .map_err(|error| error.to_string())?;
    match output.status.success() {
        true => Ok(()),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}
