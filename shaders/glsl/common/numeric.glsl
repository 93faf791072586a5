/// numeric.glsl - elementary functions that GLSL lacks or leaves inaccurate.
///
/// source log1p(x) = 2 atanh(x / (2 + x)), the odd series of atanh
/// stable near 1 the built-in log has only absolute accuracy (2e-7 on llvmpipe), so a small log1p must not use it
/// error  numeric_log1p: relative < 2e-7 for |x| < 0.3, 3e-7 beyond (llvmpipe; tests/shading/glsl_basics_test.cpp)

/// ln(1 + x) for x > -1; infinite x gives the built-in's log of infinity.
float numeric_log1p(float x)
{
    float s = x / (2.0 + x);
    float s2 = s * s;
    // |x| < 0.3 has s2 < 0.032: the first term left out, s2^6 / 13, is below 1e-10.
    float series = 2.0 * s * (1.0 + s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0 + s2 / 11.0)))));
    return abs(x) < 0.3 ? series : log(1.0 + x);
}

/// exp(-x) for x >= 0 up to infinity, exactly 0 from 200 on, where some built-ins leave their range.
float numeric_exp_negative(float x) { return x < 200.0 ? exp(-x) : 0.0; }
