#include "ray_casting.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rendering.hpp"

namespace lobe::test {
namespace {

constexpr const char* kFragment = R"(
#include "shadow/rays.glsl"
uniform samplerBuffer uQueries;
uniform int uWidth;
layout(location = 0) out vec4 oVisibility;
void main()
{
    int i = int(gl_FragCoord.y) * uWidth + int(gl_FragCoord.x);
    vec4 q0 = texelFetch(uQueries, 3 * i), q1 = texelFetch(uQueries, 3 * i + 1), q2 = texelFetch(uQueries, 3 * i + 2);
    float visible = ray_visibility(q0.xyz, vec3(q0.w, q1.xy), vec3(q1.zw, q2.x), q2.y);
    oVisibility = vec4(visible, ray_unfinished ? 1.0 : 0.0, 0.0, 0.0);
}
)";

/// Distance from 0 to the segment.
double segmentDistance(const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(-glm::dot(a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(a + t * along);
}

}  // namespace

View viewFrom(const glm::dvec3& eye) {
    return makeView(lookAt(eye, eye - glm::dvec3(0, 0, 1), 0.7), 640, 360);
}

std::vector<float> castRays(const Scene& scene, const View& view, const std::vector<RayQuery>& queries) {
    eglContext().makeCurrent();
    const RayScene rays(scene, 1 << 27);
    constexpr int kWidth = 256;
    const int height = static_cast<int>(queries.size() + kWidth - 1) / kWidth;
    std::vector<float> data(static_cast<size_t>(kWidth) * static_cast<size_t>(height) * 12);
    for (size_t i = 0; i < queries.size(); ++i) {
        const RayQuery& q = queries[i];
        const float values[] = {q.position.x, q.position.y,  q.position.z,  q.normal.x,    q.normal.y,
                                q.normal.z,   q.direction.x, q.direction.y, q.direction.z, q.distance};
        std::copy(std::begin(values), std::end(values), data.begin() + static_cast<ptrdiff_t>(12 * i));
    }
    const gl::TextureBuffer buffer =
        gl::makeTextureBuffer(GL_RGBA32F, data.data(), data.size() * sizeof(float));
    const gl::Defines defines = {{"RAY_ALPHA", "1"}};
    const gl::ShaderLibrary library = shaderLibrary();
    const gl::Program program(library.source("pass/screen.vert", {}),
                              library.source("rays_test.frag", defines, {{"rays_test.frag", kFragment}}),
                              "rays_test");
    const gl::Texture target = gl::makeTarget(GL_RGBA32F, kWidth, height);
    const gl::Framebuffer framebuffer = gl::makeFramebuffer({target.id()}, 0, GL_DEPTH_ATTACHMENT);
    glViewport(0, 0, kWidth, height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    program.use();
    program.set("uFarDepth", 0.0f);
    program.set("uQueries", 0);
    program.set("uWidth", kWidth);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_BUFFER, buffer.texture.id());
    rays.bind(program, 1, view);
    const gl::VertexArray array = gl::VertexArray::make();
    glBindVertexArray(array.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<float> pixels(static_cast<size_t>(kWidth) * static_cast<size_t>(height) * 4);
    glReadPixels(0, 0, kWidth, height, GL_RGBA, GL_FLOAT, pixels.data());
    gl::checkErrors("castRays");
    std::vector<float> result;
    size_t unfinished = 0;
    for (size_t i = 0; i < queries.size(); ++i) {
        result.push_back(pixels[4 * i]);
        if (pixels[4 * i + 1] != 0.0f) ++unfinished;
    }
    EXPECT_EQ(unfinished, 0u);
    return result;
}

BruteForce::BruteForce(const Scene& scene) {
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        const auto vertex = [&](size_t i) {
            return glm::dvec3(instance.worldFromLocal *
                              glm::dvec4(glm::dvec3(primitive.positions[primitive.indices[i]]), 1.0));
        };
        for (size_t i = 0; i < primitive.indices.size(); i += 3)
            triangles_.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
    }
}

Truth BruteForce::visibility(const glm::dvec3& origin, const glm::dvec3& direction, double distance,
                             double tolerance) const {
    const double length = glm::length(direction);
    const glm::dvec3 z = direction / length;
    const glm::dvec3 x =
        glm::normalize(glm::cross(z, std::abs(z.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 y = glm::cross(z, x);
    Truth truth = Truth::visible;
    for (const auto& triangle : triangles_) {
        std::array<glm::dvec2, 3> p;
        glm::dvec3 depths(0.0);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 v = triangle[static_cast<size_t>(i)] - origin;
            p[static_cast<size_t>(i)] = {glm::dot(v, x), glm::dot(v, y)};
            depths[i] = glm::dot(v, z);
        }
        const auto edge = [&](size_t i, size_t j) { return p[i].x * p[j].y - p[i].y * p[j].x; };
        const glm::dvec3 weights(edge(1, 2), edge(2, 0), edge(0, 1));
        const double sum = weights.x + weights.y + weights.z;
        const bool inside = glm::all(glm::greaterThan(weights, glm::dvec3(0.0))) ||
                            glm::all(glm::lessThan(weights, glm::dvec3(0.0)));
        const double border =
            std::min({segmentDistance(p[0], p[1]), segmentDistance(p[1], p[2]), segmentDistance(p[2], p[0])});
        if (!inside && border > tolerance) continue;
        const double nearest = std::min({depths.x, depths.y, depths.z});
        const double farthest = std::max({depths.x, depths.y, depths.z});
        if (farthest < -tolerance || nearest > distance * length + tolerance) continue;
        const double t = glm::dot(weights, depths) / sum;
        // The depth where the ray meets the plane is off by its slope times what the ray is off across.
        const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        const double slope = glm::length(normal) / std::max(std::abs(glm::dot(normal, z)), 1e-300);
        const double error = tolerance * slope;
        if (border > tolerance && t > error && t < distance * length - error) return Truth::blocked;
        if (border > tolerance && (t < -error || t > distance * length + error)) continue;
        truth = Truth::tooClose;
    }
    return truth;
}

glm::dvec3 startOf(const RayQuery& query, const View& view, const glm::dvec2& error) {
    const glm::dvec3 position(query.position), normal(query.normal);
    const double side = glm::dot(normal, glm::dvec3(query.direction)) < 0.0 ? -1.0 : 1.0;
    return view.eye + position + side * (error.x + error.y * glm::length(position)) * normal;
}

}  // namespace lobe::test
