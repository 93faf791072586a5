/// numeric.glsl - elementary functions that GLSL lacks or leaves inaccurate.
///
/// source Cody and Waite, Software Manual for the Elementary Functions, 1980 (arguments reduced with ln 2 in two parts);
///        log(x) = 2 atanh((x - 1) / (x + 1)), log1p(x) = 2 atanh(x / (2 + x)), the odd series of atanh
/// stable built-in exp and log are off by up to 64 ulp and by an absolute 2e-7 near 1 on software drivers, and the
///        specification leaves more to others; these are adds, multiplies and bits, alike everywhere
/// error  relative: numeric_exp < 2.5e-7, numeric_log < 3e-7, numeric_log1p < 3e-7 for |x| < 0.3 and 5.3e-7 beyond
///        others as said with each (tests/shading/glsl_basics_test.cpp, numeric_test.cpp)

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
float numeric_log1p(float x)
{
    // numeric_log(1 + x) beyond 0.3; both ways share the division and the series.
    bool near = abs(x) < 0.3;
    int bits = floatBitsToInt(1.0 + x);
    int e = near ? 0 : (bits - 0x3f3504f3) >> 23;
    float m = intBitsToFloat(bits - (e << 23));
    float k = float(e);
    float s = (near ? x : m - 1.0) / (near ? 2.0 + x : m + 1.0);
    return k * 0.693359375 + (numeric_two_atanh(s) - k * 2.12194440e-4);
}

/// ln(1 + x) / x for 0 <= x < 1e37; 1 at 0. Relative error < 3.6e-7 for x < 0.3 and 6e-7 beyond.
float numeric_log1p_ratio(float x)
{
    float y = max(x, 1e-37);
    return numeric_log1p(y) / y;
}

/// e^x; exactly 0 below -87, e^88 above 88.
float numeric_exp(float x)
{
    float y = clamp(x, -87.0, 88.0);
    float k = floor(y * 1.44269504 + 0.5);
    float r = (y - k * 0.693359375) + k * 2.12194440e-4;  // |r| <= ln(2) / 2
    float p = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r / 5040.0))))));
    return x < -87.0 ? 0.0 : p * intBitsToFloat((int(k) + 127) << 23);
}

/// scale e^x for x <= 0, also where e^x alone is too small for a float; relative error < 3e-7; exactly 0 below -174.
float numeric_exp_times(float x, float scale)
{
    float y = max(x, -174.0);
    float k = floor(y * 1.44269504 + 0.5);
    float r = (y - k * 0.693359375) + k * 2.12194440e-4;
    int half_k = int(k) / 2;
    float head = scale * intBitsToFloat((half_k + 127) << 23);
    return x < -174.0 ? 0.0 : numeric_exp(r) * head * intBitsToFloat((int(k) - half_k + 127) << 23);
}

/// x^y for x > 0: relative error 5e-7 (1 + |y ln x|).
float numeric_pow(float x, float y) { return numeric_exp(y * numeric_log(x)); }

/// (cos x, sin x), absolute error < 2e-7 for |x| < 1000.
vec2 numeric_cos_sin(float x)
{
    float k = floor(x * 0.636619772 + 0.5);  // quarter turns
    float r = ((x - k * 1.5703125) - k * 4.83751297e-4) - k * 7.54978942e-8;
    float z = r * r;
    float s = r + r * z * (-1.6666654611e-1 + z * (8.3321608736e-3 - z * 1.9515295891e-4));
    float c = 1.0 - 0.5 * z + z * z * (4.166664568298827e-2 + z * (-1.388731625493765e-3 + z * 2.443315711809948e-5));
    vec2 turned = (int(k) & 1) == 0 ? vec2(c, s) : vec2(-s, c);
    return (int(k) & 2) == 0 ? turned : -turned;
}

/// The angle of (x, y) for x, y >= 0, in 0..pi/2; relative error < 4e-7. 0 for (0, 0).
float numeric_angle(float x, float y)
{
    bool small = y <= 0.414213562 * x;
    bool middle = y < 2.41421356 * x;
    float t = small ? y / max(x, 1e-37) : middle ? (y - x) / (y + x) : -x / y;
    float z = t * t;
    float series = t + t * z * (((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z - 3.33329491539e-1);
    return (small ? 0.0 : middle ? 0.785398163 : 1.57079633) + series;
}

/// erfc(x) for x >= 0; relative error < 7.5e-7 + 1.2e-7 x^2, of which the fit has 1.2e-7.
float numeric_erfc(float x)
{
    // Rational Chebyshev fit of Press et al., Numerical Recipes: fractional error 1.2e-7 everywhere.
    float t = 1.0 / (1.0 + 0.5 * x);
    float p = -1.26551223 + t * (1.00002368 + t * (0.37409196 + t * (0.09678418 + t * (-0.18628806 + t * (0.27886807
              + t * (-1.13520398 + t * (1.48851587 + t * (-0.82215223 + t * 0.17087277))))))));
    return t * numeric_exp(p - x * x);
}
