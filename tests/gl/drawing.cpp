#include "drawing.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace lobe::gl::test {
namespace {

constexpr const char* kVertex = R"(
layout(location = 0) in vec4 place;  // x, y, z, phase
uniform mat4 clipFromWorld;
out vec2 uv;
out float phase;
void main() {
    uv = place.xy;
    phase = place.w;
    gl_Position = clipFromWorld * vec4(place.xyz, 1.0);
}
)";

constexpr const char* kFragment = R"(
in vec2 uv;
in float phase;
uniform sampler2D image;
out vec4 color;
void main() {
    vec4 texel = texture(image, uv * 0.37);
    float wave = sin(7.0 * uv.x + phase) * exp(-0.3 * dot(uv, uv));
    color = vec4(pow(texel.rgb, vec3(2.2)) * (1.0 + wave), 0.25 + 0.1 * abs(wave));
}
)";

Texture noise(int side) {
    std::vector<unsigned char> texels;
    unsigned state = 1;
    for (int i = 0; i < side * side * 4; ++i) {
        state = state * 1664525u + 1013904223u;
        texels.push_back(static_cast<unsigned char>(state >> 24));
    }
    Texture texture = Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

/// A fan of triangles at many depths, some of which reach behind the camera.
std::vector<glm::vec4> triangles() {
    std::vector<glm::vec4> corners;
    for (int i = 0; i < 60; ++i) {
        const float a = 0.7f * static_cast<float>(i);
        const float depth = -0.15f * static_cast<float>(i) + 0.5f;
        corners.emplace_back(2.0f * std::cos(a), 1.5f * std::sin(a), depth, a);
        corners.emplace_back(2.2f * std::cos(a + 1.9f), 1.7f * std::sin(a + 1.9f), depth - 1.0f, a + 1.0f);
        corners.emplace_back(1.8f * std::cos(a + 4.1f), 1.3f * std::sin(a + 4.1f), depth - 3.0f, a + 2.0f);
    }
    return corners;
}

}  // namespace

std::vector<float> drawPicture() {
    const Texture color = makeTarget(GL_RGBA16F, kWidth, kHeight);
    const Texture depth = makeTarget(GL_DEPTH_COMPONENT24, kWidth, kHeight);
    const Framebuffer framebuffer = makeFramebuffer({color.id()}, depth.id(), GL_DEPTH_ATTACHMENT);
    const Program program(glsl("drawing.vert", kVertex), glsl("drawing.frag", kFragment), "drawing");
    const Texture image = noise(64);
    const std::vector<glm::vec4> corners = triangles();
    const VertexArray array = VertexArray::make();
    const Buffer buffer = Buffer::make();
    glBindVertexArray(array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec4)), corners.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(glm::vec4), nullptr);

    glViewport(0, 0, kWidth, kHeight);
    glClearColor(0.01f, 0.02f, 0.03f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE);
    program.use();
    program.set("image", 0);
    program.set("clipFromWorld", glm::perspective(1.0f, static_cast<float>(kWidth) / kHeight, 0.1f, 50.0f) *
                                     glm::lookAt(glm::vec3(0.3f, 0.2f, 2.0f), glm::vec3(0.0f, 0.0f, -2.0f),
                                                 glm::vec3(0.0f, 1.0f, 0.0f)));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, image.id());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);

    std::vector<float> pixels(static_cast<size_t>(kWidth) * kHeight * 4);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_FLOAT, pixels.data());
    checkErrors("drawPicture");
    return pixels;
}

}  // namespace lobe::gl::test
