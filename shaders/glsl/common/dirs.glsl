/// dirs.glsl - local frames, and the directions that every model is evaluated with.
///
/// frame  z = shading normal, x = tangent, y = bitangent; right-handed but for a mirrored tangent (w = -1)
/// stable h is added in world space and then rotated: rotating wi and wo first and adding their rounded
///        components costs a narrow lobe one to two digits
/// source Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017
/// twin   lobe::Directions (engine/shading/brdf.hpp)

struct Frame { vec3 t, b, n; };

struct Dirs {
    vec3 wi;  // to the light, unit
    vec3 wo;  // to the eye, unit
    vec3 h;   // wi + wo, not unit
};

/// A frame about the unit vector n with an arbitrary but continuous tangent (but for a seam at n.z = 0).
Frame frame_from_normal(vec3 n)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return Frame(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

/// A frame about the unit vector n whose x axis is the part of `tangent` that is perpendicular to n. `tangent.w` is
/// glTF's handedness. Falls back to frame_from_normal where the tangent has no such part.
Frame frame_from_normal_tangent(vec3 n, vec4 tangent)
{
    vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
    float m = max(max(abs(t.x), abs(t.y)), abs(t.z));
    if (!(m > 1e-6 * max(max(abs(tangent.x), abs(tangent.y)), abs(tangent.z))))
        return frame_from_normal(n);
    t = normalize(t / m);
    return Frame(t, (tangent.w < 0.0 ? -1.0 : 1.0) * cross(n, t), n);
}

/// The frame's tangent and handedness as one number beside its normal: the tangent's direction in
/// frame_from_normal(f.n), projected onto a diamond, as 1 to 5, negative where the frame is left-handed.
float frame_encode_tangent(Frame f)
{
    Frame g = frame_from_normal(f.n);
    vec2 t = vec2(dot(g.t, f.t), dot(g.b, f.t));
    float x = t.x / max(abs(t.x) + abs(t.y), 1e-37);
    float turn = t.y >= 0.0 ? 1.0 - x : x - 1.0;
    return dot(cross(f.n, f.t), f.b) < 0.0 ? -3.0 - turn : 3.0 + turn;
}

Frame frame_decode_tangent(vec3 n, float code)
{
    Frame g = frame_from_normal(n);
    float turn = abs(code) - 3.0;
    float x = 1.0 - abs(turn);
    vec2 t = normalize(vec2(x, (turn >= 0.0 ? 1.0 : -1.0) * (1.0 - abs(x))));
    vec3 tangent = g.t * t.x + g.b * t.y;
    return Frame(tangent, (code < 0.0 ? -1.0 : 1.0) * cross(n, tangent), n);
}

vec3 frame_to_local(Frame f, vec3 v) { return vec3(dot(f.t, v), dot(f.b, v), dot(f.n, v)); }

/// For callers with many lights: wo_local = frame_to_local(f, view_dir_w), rotated once.
Dirs dirs_make_wo(Frame f, vec3 wo_local, vec3 light_dir_w, vec3 view_dir_w)
{
    return Dirs(frame_to_local(f, light_dir_w), wo_local, frame_to_local(f, light_dir_w + view_dir_w));
}

Dirs dirs_make(Frame f, vec3 light_dir_w, vec3 view_dir_w)
{
    return dirs_make_wo(f, frame_to_local(f, view_dir_w), light_dir_w, view_dir_w);
}
