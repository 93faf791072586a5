#include "harness/evaluator.hpp"

#include <algorithm>
#include <cassert>
#include <ctime>
#include <map>

#include "gl/objects.hpp"

namespace lobe::harness {
namespace {

/// Texels of a row lie in one column each, K rows of texels to a row of the image: tables of any length fit.
constexpr int kTableWidth = 1024;

constexpr const char* kVertexSource =
    "void main()\n"
    "{\n"
    "    gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, "
    "1.0);\n"
    "}\n";

int componentsOf(const std::string& type) {
    static const std::map<std::string, int> components{
        {"float", 1}, {"int", 1}, {"vec2", 2}, {"vec3", 3}, {"vec4", 4}};
    return components.at(type);
}

int texelsPerRow(const Snippet& snippet) {
    return (inputWidth(snippet) + 3) / 4;
}

std::string component(int index) {
    return "input" + std::to_string(index / 4) + "." + std::string(1, "xyzw"[index % 4]);
}

/// Declares the snippet's inputs as local variables.
std::string inputDeclarations(const Snippet& snippet) {
    std::string text;
    for (int texel = 0; texel < texelsPerRow(snippet); ++texel)
        text += "    vec4 input" + std::to_string(texel) +
                " = texelFetch(uInputs, ivec2(pixel.x, pixel.y * " + std::to_string(texelsPerRow(snippet)) +
                " + " + std::to_string(texel) + "), 0);\n";
    int index = 0;
    for (const Variable& variable : snippet.inputs) {
        text += "    " + variable.type + " " + variable.name + " = " + variable.type + "(";
        for (int c = 0; c < componentsOf(variable.type); ++c, ++index)
            text += (c > 0 ? ", " : "") + component(index);
        text += ");\n";
    }
    return text;
}

/// The rows as texels: row i at column i % width of image row i / width, its texels below each other.
std::vector<float> inputTexels(std::span<const float> inputs, size_t rows, size_t width, size_t texels,
                               size_t imageRows) {
    std::vector<float> image(imageRows * texels * kTableWidth * 4, 0.0f);
    for (size_t i = 0; i < rows; ++i)
        for (size_t c = 0; c < width; ++c) {
            const size_t y = i / kTableWidth * texels + c / 4;
            image[(y * kTableWidth + i % kTableWidth) * 4 + c % 4] = inputs[i * width + c];
        }
    return image;
}

gl::Texture uploadInputs(const std::vector<float>& image, int height) {
    gl::Texture texture = gl::makeTarget(GL_RGBA32F, kTableWidth, height);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kTableWidth, height, GL_RGBA, GL_FLOAT, image.data());
    return texture;
}

void drawInto(const gl::Framebuffer& framebuffer, int results, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    std::vector<GLenum> buffers;
    buffers.reserve(static_cast<size_t>(results));
    for (int i = 0; i < results; ++i)
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    glDrawBuffers(results, buffers.data());
    glViewport(0, 0, kTableWidth, height);
    for (GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE})
        glDisable(state);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const auto vertices = gl::VertexArray::make();
    glBindVertexArray(vertices.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace

int inputWidth(const Snippet& snippet) {
    int width = 0;
    for (const Variable& variable : snippet.inputs)
        width += componentsOf(variable.type);
    return width;
}

std::string snippetSource(const Snippet& snippet) {
    std::string text;
    for (const std::string& include : snippet.includes)
        text += "#include \"" + include + "\"\n";
    text += "uniform sampler2D uInputs;\n";
    for (int i = 0; i < snippet.results; ++i)
        text += "layout(location = " + std::to_string(i) + ") out vec4 oResult" + std::to_string(i) + ";\n";
    text += snippet.functions + "\nvoid main()\n{\n    ivec2 pixel = ivec2(gl_FragCoord.xy);\n" +
            inputDeclarations(snippet);
    text += "    vec4 result[" + std::to_string(snippet.results) + "];\n";
    for (int i = 0; i < snippet.results; ++i)
        text += "    result[" + std::to_string(i) + "] = vec4(0.0);\n";
    text += snippet.body + "\n";
    for (int i = 0; i < snippet.results; ++i)
        text += "    oResult" + std::to_string(i) + " = result[" + std::to_string(i) + "];\n";
    return text + "}\n";
}

Evaluator::Evaluator(const gl::ShaderLibrary& library, Snippet snippet) : snippet_(std::move(snippet)) {
    assert(snippet_.results >= 1 && snippet_.results <= 8);
    const std::string fragment = "generated/" + snippet_.name + ".frag";
    const std::map<std::string, std::string> generated{{"generated/table.vert", kVertexSource},
                                                       {fragment, snippetSource(snippet_)}};
    program_ = gl::Program(library.source("generated/table.vert", {}, generated),
                           library.source(fragment, {}, generated), snippet_.name);
}

namespace {

/// A table on the GPU, and what it is drawn into.
struct Drawing {
    size_t imageRows;
    gl::Texture source;
    std::vector<gl::Texture> targets;
    gl::Framebuffer framebuffer;
    gl::TextureBuffer table;

    /// Binds everything for `program`.
    Drawing(const Snippet& snippet, const gl::Program& program, std::span<const float> inputs,
            std::span<const float> brdfTable)
        : imageRows((inputs.size() / width(snippet) + kTableWidth - 1) / kTableWidth) {
        const auto texels = static_cast<size_t>(texelsPerRow(snippet));
        source = uploadInputs(
            inputTexels(inputs, inputs.size() / width(snippet), width(snippet), texels, imageRows),
            static_cast<int>(imageRows * texels));
        std::vector<GLuint> colors;
        for (int i = 0; i < snippet.results; ++i) {
            targets.push_back(gl::makeTarget(GL_RGBA32F, kTableWidth, height()));
            colors.push_back(targets.back().id());
        }
        framebuffer = gl::makeFramebuffer(colors, 0, GL_NONE);
        program.use();
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, source.id());
        program.set("uInputs", 0);
        if (brdfTable.empty()) return;
        table = gl::makeTextureBuffer(GL_RGBA32F, brdfTable.data(), brdfTable.size_bytes());
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_BUFFER, table.texture.id());
        glActiveTexture(GL_TEXTURE0);
        program.set("uBrdfTable", 1);
    }

    static size_t width(const Snippet& snippet) { return static_cast<size_t>(inputWidth(snippet)); }
    int height() const { return static_cast<int>(imageRows); }
    void draw() const { drawInto(framebuffer, static_cast<int>(targets.size()), height()); }
};

double milliseconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

ResultTable Evaluator::evaluate(std::span<const float> inputs, std::span<const float> brdfTable) const {
    const auto width = static_cast<size_t>(inputWidth(snippet_));
    const size_t rows = width == 0 ? 0 : inputs.size() / width;
    assert(rows * width == inputs.size());
    ResultTable table{4 * snippet_.results,
                      std::vector<float>(rows * 4 * static_cast<size_t>(snippet_.results))};
    if (rows == 0) return table;

    const Drawing drawing(snippet_, program_, inputs, brdfTable);
    drawing.draw();
    std::vector<float> image(drawing.imageRows * kTableWidth * 4);
    for (int i = 0; i < snippet_.results; ++i) {
        glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        glReadPixels(0, 0, kTableWidth, drawing.height(), GL_RGBA, GL_FLOAT, image.data());
        for (size_t row = 0; row < rows; ++row)
            std::copy_n(image.begin() + static_cast<std::ptrdiff_t>(row * 4), 4,
                        table.values.begin() +
                            static_cast<std::ptrdiff_t>(
                                (row * static_cast<size_t>(snippet_.results) + static_cast<size_t>(i)) * 4));
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::checkErrors("evaluating a table");
    return table;
}

std::vector<double> Evaluator::drawTimes(std::span<const float> inputs, std::span<const float> brdfTable,
                                         int runs, bool softwareDriver) const {
    const Drawing drawing(snippet_, program_, inputs, brdfTable);
    const clockid_t clock = softwareDriver ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
    drawing.draw();  // compiles the variant for these targets
    glFinish();
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        const double start = milliseconds(clock);
        drawing.draw();
        glFinish();
        times.push_back(milliseconds(clock) - start);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::checkErrors("timing a table");
    return times;
}

}  // namespace lobe::harness
