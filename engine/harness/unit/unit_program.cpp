#include "harness/unit/unit_program.hpp"

#include <algorithm>
#include <sstream>

#include "base/error.hpp"
#include "gl/objects.hpp"
#include "harness/brdf_table.hpp"

namespace lobe::harness {
namespace {

/// Rows of inputs lie side by side, this many to a row of the image; the texels of one below each other.
constexpr size_t kTableWidth = 1024;

constexpr const char* kTriangle =
    "void main()\n"
    "{\n"
    "    gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, "
    "1.0);\n"
    "}\n";
constexpr const char* kNothing = "void main()\n{\n}\n";

size_t imageHeight(size_t rows) {
    return (rows + kTableWidth - 1) / kTableWidth;
}

gl::Texture uploadWords(const std::vector<uint32_t>& image, size_t height) {
    gl::Texture texture = gl::makeTarget(GL_RGBA32UI, kTableWidth, static_cast<int>(height));
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kTableWidth, static_cast<GLsizei>(height), GL_RGBA_INTEGER,
                    GL_UNSIGNED_INT, image.data());
    return texture;
}

std::vector<std::string> outputNames(int outputs) {
    std::vector<std::string> names;
    names.reserve(static_cast<size_t>(outputs));
    for (int i = 0; i < outputs; ++i)
        names.push_back("lobe_output" + std::to_string(i));
    return names;
}

}  // namespace

UnitProgram::UnitProgram(const gl::ShaderLibrary& library, const TestFile& file, const TestCase& test)
    : test_(test), outputs_(unitOutputs(test)) {
    const bool vertex = test.stage == Stage::vertex;
    const std::map<std::string, std::string> generated{{"generated/test", unitSource(file, test)},
                                                       {"generated/other", vertex ? kNothing : kTriangle}};
    if (outputs_ > 8)
        throw InputError(test.place.text() + ": " + test.name + ": expected at most 5 reference functions");
    source_ = library.source("generated/test", {}, generated);
    const gl::ShaderSource other = library.source("generated/other", {}, generated);
    program_ = gl::Program(vertex ? source_ : other, vertex ? other : source_, test.name,
                           vertex ? outputNames(outputs_) : std::vector<std::string>());
    if (test.model != nullptr) {
        PackedTables tables = packTables(*test.model);
        tables_ = std::move(tables.floats);
        firstRows_ = std::move(tables.firstRow);
    }
}

RowOutputs UnitProgram::evaluate(std::span<const uint32_t> words) const {
    // A test without inputs is run once.
    const auto width = static_cast<size_t>(test_.width());
    const size_t rows = width == 0 ? 1 : words.size() / width;
    if (rows == 0) return {static_cast<size_t>(outputs_) * 4, {}};
    const size_t texels = std::max<size_t>((width + 3) / 4, 1);
    const size_t height = imageHeight(rows);
    std::vector<uint32_t> image(height * texels * kTableWidth * 4, 0U);
    const int table = test_.model == nullptr ? -1 : test_.model->tableParameter();
    const size_t tableWord =
        table < 0 ? width : static_cast<size_t>(test_.inputs[static_cast<size_t>(table) + 2].offset);
    for (size_t i = 0; i < rows; ++i)
        for (size_t c = 0; c < width; ++c) {
            const size_t y = i / kTableWidth * texels + c / 4;
            const uint32_t word = words[i * width + c];
            image[(y * kTableWidth + i % kTableWidth) * 4 + c % 4] =
                c == tableWord ? static_cast<uint32_t>(firstRows_.at(word)) : word;
        }
    const gl::Texture inputs = uploadWords(image, height * texels);
    program_.use();
    program_.set("lobe_inputs", 0);
    gl::TextureBuffer buffer;
    if (!tables_.empty()) {
        buffer = gl::makeTextureBuffer(GL_RGBA32F, tables_.data(), tables_.size() * sizeof(float));
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_BUFFER, buffer.texture.id());
        glActiveTexture(GL_TEXTURE0);
        program_.set("uBrdfTable", 1);
    }
    for (const GLenum state :
         {GL_BLEND, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_DITHER})
        glDisable(state);
    const auto vertices = gl::VertexArray::make();
    glBindVertexArray(vertices.id());
    RowOutputs outputs = test_.stage == Stage::vertex ? evaluateVertices(inputs.id(), rows)
                                                      : evaluateFragments(inputs.id(), rows);
    glBindVertexArray(0);
    gl::checkErrors("evaluating a test");
    return outputs;
}

RowOutputs UnitProgram::evaluateFragments(unsigned inputs, size_t rows) const {
    const auto height = static_cast<int>(imageHeight(rows));
    const auto outputs = static_cast<size_t>(outputs_);
    std::vector<gl::Texture> targets;
    std::vector<GLuint> colors;
    std::vector<GLenum> buffers;
    for (size_t i = 0; i < outputs; ++i) {
        targets.push_back(gl::makeTarget(GL_RGBA32UI, kTableWidth, height));
        colors.push_back(targets.back().id());
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    }
    const gl::Framebuffer framebuffer = gl::makeFramebuffer(colors, 0, GL_NONE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glDrawBuffers(static_cast<GLsizei>(outputs), buffers.data());
    glViewport(0, 0, kTableWidth, height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindTexture(GL_TEXTURE_2D, inputs);  // after the targets were made
    glDrawArrays(GL_TRIANGLES, 0, 3);

    RowOutputs result{outputs * 4, std::vector<uint32_t>(rows * outputs * 4)};
    std::vector<uint32_t> image(static_cast<size_t>(height) * kTableWidth * 4);
    for (size_t i = 0; i < outputs; ++i) {
        glReadBuffer(buffers[i]);
        glReadPixels(0, 0, kTableWidth, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, image.data());
        for (size_t row = 0; row < rows; ++row)
            std::copy_n(image.data() + row * 4, 4, result.words.data() + (row * outputs + i) * 4);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return result;
}

RowOutputs UnitProgram::evaluateVertices(unsigned inputs, size_t rows) const {
    const auto outputs = static_cast<size_t>(outputs_);
    RowOutputs result{outputs * 4, std::vector<uint32_t>(rows * outputs * 4)};
    const auto bytes = static_cast<GLsizeiptr>(result.words.size() * sizeof(uint32_t));
    const auto buffer = gl::Buffer::make();
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer.id());
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.id());
    // A context without a window has no framebuffer of its own, and no draw goes without.
    const gl::Texture unused = gl::makeTarget(GL_RGBA8, 1, 1);
    const gl::Framebuffer framebuffer = gl::makeFramebuffer({unused.id()}, 0, GL_NONE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glBindTexture(GL_TEXTURE_2D, inputs);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(rows));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, result.words.data());
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return result;
}

SourcePlace UnitProgram::placeOf(size_t line) const {
    if (line < 1 || line > source_.places.size()) return test_.place;
    const gl::ShaderSource::Place& place = source_.places[line - 1];
    return {place.file, place.line};
}

std::string UnitProgram::lineText(size_t line) const {
    std::istringstream lines(source_.text);
    std::string text;
    for (size_t i = 0; i < line; ++i)
        std::getline(lines, text);
    const size_t first = text.find_first_not_of(" \t");
    return first == std::string::npos ? "" : text.substr(first);
}

}  // namespace lobe::harness
