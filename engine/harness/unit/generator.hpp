/// Where a test's inputs come from: random draws, or lists.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/unit/directive_reader.hpp"
#include "harness/unit/glsl_type.hpp"
#include "math/random.hpp"

namespace lobe::harness {

/// One value of an input, a word a component.
using Words = std::vector<uint32_t>;

/// What stands after "@in x:".
class Generator {
public:
    enum class Kind : uint8_t { list, uniform, logUniform, any, unitSphere, hemisphere, grazingHemisphere };

    /// Reads one, for an input of `type`; csv files are looked for from `folder`. Throws InputError.
    static Generator parse(DirectiveReader& reader, GlslType type, const std::filesystem::path& folder);
    /// Names of all kinds, for messages and documentation.
    static const std::vector<std::string>& names();

    Kind kind() const { return kind_; }
    bool isList() const { return kind_ == Kind::list; }
    bool isDirection() const { return kind_ >= Kind::unitSphere; }
    const std::vector<Words>& list() const { return list_; }
    /// The CSV file, empty if none. Inputs from one file take its rows together.
    const std::filesystem::path& csvFile() const { return csvFile_; }

    /// A random value; not for lists. Ends of ranges come up often: one time in 32 each.
    Words draw(Pcg32& random) const;
    /// Whether it could have come from here: what failing inputs are shrunk within.
    bool allows(std::span<const uint32_t> words) const;

private:
    Generator(Kind kind, GlslType type) : kind_(kind), type_(type) {}
    void readValues(DirectiveReader& reader);
    void readSpecial(DirectiveReader& reader);
    void readGrid(DirectiveReader& reader);
    void readCsvColumns(DirectiveReader& reader, const std::filesystem::path& folder);
    void readRange(DirectiveReader& reader);
    uint32_t readWord(DirectiveReader& reader) const;
    uint32_t drawWord(Pcg32& random) const;

    Kind kind_;
    GlslType type_;
    double low_ = 0.0, high_ = 0.0;
    std::vector<Words> list_;
    std::filesystem::path csvFile_;
};

}  // namespace lobe::harness
