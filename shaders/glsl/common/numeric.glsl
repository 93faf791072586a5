/// numeric.glsl - elementary functions that GLSL lacks or leaves inaccurate.
///
/// source Cody and Waite, Software Manual for the Elementary Functions, 1980 (arguments reduced with ln 2 in two parts);
///        log(x) = 2 atanh((x - 1) / (x + 1)), log1p(x) = 2 atanh(x / (2 + x)), the odd series of atanh
/// stable built-in exp and log are off by up to 64 ulp and by an absolute 2e-7 near 1 on software drivers, and the
///        specification leaves more to others; these are adds, multiplies and bits, alike everywhere
/// error  relative: numeric_exp < 2.5e-7, numeric_log < 3e-7, numeric_log1p < 3e-7 for |x| < 0.3 and 5.3e-7 beyond
///        (tests/shading/glsl_basics_test.cpp)

/// 2 atanh(s) for |s| < 0.18: the first term left out, s^12 / 13, is below 1e-10 relative.
float numeric_two_atanh(float s)
{
    float s2 = s * s;
    return 2.0 * s * (1.0 + s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0 + s2 / 11.0)))));
}

/// ln x for normal x > 0, to its last digits near 1 too; about -88 for 0, 89 for infinity.
float numeric_log(float x)
{
    int bits = floatBitsToInt(x);
    int e = (bits - 0x3f3504f3) >> 23;  // x = m 2^e, m from sqrt(1/2) to sqrt(2)
    float m = intBitsToFloat(bits - (e << 23));
    float k = float(e);
    return k * 0.693359375 + (numeric_two_atanh((m - 1.0) / (m + 1.0)) - k * 2.12194440e-4);
}

/// ln(1 + x) for x > -1.
float numeric_log1p(float x) { return abs(x) < 0.3 ? numeric_two_atanh(x / (2.0 + x)) : numeric_log(1.0 + x); }

/// e^x; exactly 0 below -87, e^88 above 88.
float numeric_exp(float x)
{
    float y = clamp(x, -87.0, 88.0);
    float k = floor(y * 1.44269504 + 0.5);
    float r = (y - k * 0.693359375) + k * 2.12194440e-4;  // |r| <= ln(2) / 2
    float p = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r / 5040.0))))));
    return x < -87.0 ? 0.0 : p * intBitsToFloat((int(k) + 127) << 23);
}

/// x^y for x > 0: relative error 5e-7 (1 + |y ln x|).
float numeric_pow(float x, float y) { return numeric_exp(y * numeric_log(x)); }
