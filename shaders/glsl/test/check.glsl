/// check.glsl - what tests call to state that something holds. lobe-check includes it before every test file.
///
/// value  the first failing call of a run is kept: its line, its kind, its values
/// stable NaN and infinity are told by exponent bits: isnan may be optimised away, and !(a <= b) turned into a > b
/// error  none: comparisons are exact but for the product in check_near

int lobe_check_line = 0;  // of the first failure, 0 if none
int lobe_check_kind = 0;
int lobe_check_base = 0;  // 0 float, 1 int, 2 uint, 3 bool
uvec3 lobe_check_values = uvec3(0u);
bool lobe_check_skipped = false;

#define check(condition) lobe_check_true(__LINE__, condition)
#define check_equal(a, b) lobe_check_equal(__LINE__, a, b)
#define check_near(a, b, rel) lobe_check_near(__LINE__, a, b, rel)
#define check_abs(a, b, absolute) lobe_check_abs(__LINE__, a, b, absolute)
#define check_ulp(a, b, ulps) lobe_check_ulp(__LINE__, a, b, ulps)
#define check_less(a, b) lobe_check_less(__LINE__, a, b)
#define check_less_equal(a, b) lobe_check_less_equal(__LINE__, a, b)
#define check_finite(a) lobe_check_finite(__LINE__, a)
#define assume(condition) lobe_check_assume(condition)

bool lobe_is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool lobe_is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

/// Number of floats from a to b; -0 and +0 are one. For numbers.
uint lobe_ulps_between(float a, float b)
{
    uint p = floatBitsToUint(a);
    uint q = floatBitsToUint(b);
    uint x = p & 0x7fffffffu;
    uint y = q & 0x7fffffffu;
    return (p >> 31) != (q >> 31) ? x + y : max(x, y) - min(x, y);
}

void lobe_check_keep(int line, int kind, int base, bool holds, uvec3 values)
{
    if (!holds && lobe_check_line == 0 && !lobe_check_skipped) {
        lobe_check_line = line;
        lobe_check_kind = kind;
        lobe_check_base = base;
        lobe_check_values = values;
    }
}

void lobe_check_real(int line, int kind, bool holds, float a, float b, float tolerance)
{
    lobe_check_keep(line, kind, 0, holds, floatBitsToUint(vec3(a, b, tolerance)));
}

/// Rows for which it does not hold do not count.
void lobe_check_assume(bool condition)
{
    if (!condition && lobe_check_line == 0)
        lobe_check_skipped = true;
}

void lobe_check_true(int line, bool condition) { lobe_check_keep(line, 1, 3, condition, uvec3(condition, 0u, 0u)); }

void lobe_check_equal(int line, float a, float b)
{
    bool same = lobe_ulps_between(a, b) == 0u || (lobe_is_nan(a) && lobe_is_nan(b));
    lobe_check_real(line, 2, same, a, b, 0.0);
}
void lobe_check_equal(int line, int a, int b) { lobe_check_keep(line, 2, 1, a == b, uvec3(a, b, 0)); }
void lobe_check_equal(int line, uint a, uint b) { lobe_check_keep(line, 2, 2, a == b, uvec3(a, b, 0u)); }
void lobe_check_equal(int line, bool a, bool b) { lobe_check_keep(line, 2, 3, a == b, uvec3(a, b, 0u)); }

/// |a - b| at most rel times the larger.
void lobe_check_near(int line, float a, float b, float rel)
{
    bool finite = lobe_is_finite(a) && lobe_is_finite(b);
    bool near = finite && abs(a - b) <= rel * max(abs(a), abs(b));
    lobe_check_real(line, 3, near || lobe_ulps_between(a, b) == 0u && !lobe_is_nan(a), a, b, rel);
}

void lobe_check_abs(int line, float a, float b, float absolute)
{
    bool finite = lobe_is_finite(a) && lobe_is_finite(b);
    bool near = finite && abs(a - b) <= absolute;
    lobe_check_real(line, 4, near || lobe_ulps_between(a, b) == 0u && !lobe_is_nan(a), a, b, absolute);
}

void lobe_check_ulp(int line, float a, float b, int ulps)
{
    bool near = !lobe_is_nan(a) && !lobe_is_nan(b) && lobe_ulps_between(a, b) <= uint(ulps);
    lobe_check_keep(line, 5, 0, near, uvec3(floatBitsToUint(a), floatBitsToUint(b), uint(ulps)));
}

void lobe_check_less(int line, float a, float b)
{
    lobe_check_real(line, 6, !lobe_is_nan(a) && !lobe_is_nan(b) && a < b, a, b, 0.0);
}
void lobe_check_less(int line, int a, int b) { lobe_check_keep(line, 6, 1, a < b, uvec3(a, b, 0)); }

void lobe_check_less_equal(int line, float a, float b)
{
    lobe_check_real(line, 7, !lobe_is_nan(a) && !lobe_is_nan(b) && a <= b, a, b, 0.0);
}
void lobe_check_less_equal(int line, int a, int b) { lobe_check_keep(line, 7, 1, a <= b, uvec3(a, b, 0)); }

void lobe_check_finite(int line, float a) { lobe_check_real(line, 8, lobe_is_finite(a), a, 0.0, 0.0); }

// The same for vectors, component by component.
void lobe_check_equal(int line, vec2 a, vec2 b) { lobe_check_equal(line, a.x, b.x); lobe_check_equal(line, a.y, b.y); }
void lobe_check_near(int line, vec2 a, vec2 b, float rel)
{
    lobe_check_near(line, a.x, b.x, rel);
    lobe_check_near(line, a.y, b.y, rel);
}
void lobe_check_abs(int line, vec2 a, vec2 b, float absolute)
{
    lobe_check_abs(line, a.x, b.x, absolute);
    lobe_check_abs(line, a.y, b.y, absolute);
}
void lobe_check_ulp(int line, vec2 a, vec2 b, int ulps)
{
    lobe_check_ulp(line, a.x, b.x, ulps);
    lobe_check_ulp(line, a.y, b.y, ulps);
}
void lobe_check_less(int line, vec2 a, vec2 b) { lobe_check_less(line, a.x, b.x); lobe_check_less(line, a.y, b.y); }
void lobe_check_less_equal(int line, vec2 a, vec2 b)
{
    lobe_check_less_equal(line, a.x, b.x);
    lobe_check_less_equal(line, a.y, b.y);
}
void lobe_check_finite(int line, vec2 a) { lobe_check_finite(line, a.x); lobe_check_finite(line, a.y); }
void lobe_check_equal(int line, vec3 a, vec3 b)
{
    lobe_check_equal(line, a.x, b.x);
    lobe_check_equal(line, a.y, b.y);
    lobe_check_equal(line, a.z, b.z);
}
void lobe_check_near(int line, vec3 a, vec3 b, float rel)
{
    lobe_check_near(line, a.x, b.x, rel);
    lobe_check_near(line, a.y, b.y, rel);
    lobe_check_near(line, a.z, b.z, rel);
}
void lobe_check_abs(int line, vec3 a, vec3 b, float absolute)
{
    lobe_check_abs(line, a.x, b.x, absolute);
    lobe_check_abs(line, a.y, b.y, absolute);
    lobe_check_abs(line, a.z, b.z, absolute);
}
void lobe_check_ulp(int line, vec3 a, vec3 b, int ulps)
{
    lobe_check_ulp(line, a.x, b.x, ulps);
    lobe_check_ulp(line, a.y, b.y, ulps);
    lobe_check_ulp(line, a.z, b.z, ulps);
}
void lobe_check_less(int line, vec3 a, vec3 b)
{
    lobe_check_less(line, a.x, b.x);
    lobe_check_less(line, a.y, b.y);
    lobe_check_less(line, a.z, b.z);
}
void lobe_check_less_equal(int line, vec3 a, vec3 b)
{
    lobe_check_less_equal(line, a.x, b.x);
    lobe_check_less_equal(line, a.y, b.y);
    lobe_check_less_equal(line, a.z, b.z);
}
void lobe_check_finite(int line, vec3 a)
{
    lobe_check_finite(line, a.x);
    lobe_check_finite(line, a.y);
    lobe_check_finite(line, a.z);
}
void lobe_check_equal(int line, vec4 a, vec4 b)
{
    lobe_check_equal(line, a.x, b.x);
    lobe_check_equal(line, a.y, b.y);
    lobe_check_equal(line, a.z, b.z);
    lobe_check_equal(line, a.w, b.w);
}
void lobe_check_near(int line, vec4 a, vec4 b, float rel)
{
    lobe_check_near(line, a.x, b.x, rel);
    lobe_check_near(line, a.y, b.y, rel);
    lobe_check_near(line, a.z, b.z, rel);
    lobe_check_near(line, a.w, b.w, rel);
}
void lobe_check_abs(int line, vec4 a, vec4 b, float absolute)
{
    lobe_check_abs(line, a.x, b.x, absolute);
    lobe_check_abs(line, a.y, b.y, absolute);
    lobe_check_abs(line, a.z, b.z, absolute);
    lobe_check_abs(line, a.w, b.w, absolute);
}
void lobe_check_ulp(int line, vec4 a, vec4 b, int ulps)
{
    lobe_check_ulp(line, a.x, b.x, ulps);
    lobe_check_ulp(line, a.y, b.y, ulps);
    lobe_check_ulp(line, a.z, b.z, ulps);
    lobe_check_ulp(line, a.w, b.w, ulps);
}
void lobe_check_less(int line, vec4 a, vec4 b)
{
    lobe_check_less(line, a.x, b.x);
    lobe_check_less(line, a.y, b.y);
    lobe_check_less(line, a.z, b.z);
    lobe_check_less(line, a.w, b.w);
}
void lobe_check_less_equal(int line, vec4 a, vec4 b)
{
    lobe_check_less_equal(line, a.x, b.x);
    lobe_check_less_equal(line, a.y, b.y);
    lobe_check_less_equal(line, a.z, b.z);
    lobe_check_less_equal(line, a.w, b.w);
}
void lobe_check_finite(int line, vec4 a)
{
    lobe_check_finite(line, a.x);
    lobe_check_finite(line, a.y);
    lobe_check_finite(line, a.z);
    lobe_check_finite(line, a.w);
}
