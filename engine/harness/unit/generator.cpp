#include "harness/unit/generator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "base/closest_name.hpp"
#include "harness/unit/csv_columns.hpp"
#include "math/sphere.hpp"

namespace lobe::harness {
namespace {

using Base = GlslType::Base;

constexpr int64_t kLargestList = 1 << 24;

Words directionWords(const glm::dvec3& w) {
    const glm::vec3 v(w);
    return {wordOf(v.x), wordOf(v.y), wordOf(v.z)};
}

/// The ends of what floats are, and the neighbours of 1.
std::vector<float> specialReals() {
    using Limits = std::numeric_limits<float>;
    const float below = std::nextafter(1.0f, 0.0f);
    const float above = std::nextafter(1.0f, 2.0f);
    return {0.0f,
            1.0f,
            below,
            above,
            0.5f,
            2.0f,
            Limits::denorm_min(),
            std::nextafter(Limits::min(), 0.0f),
            Limits::min(),
            Limits::epsilon(),
            1e-20f,
            1e20f,
            Limits::max()};
}

}  // namespace

const std::vector<std::string>& Generator::names() {
    static const std::vector<std::string> list{
        "uniform", "log_uniform", "grid",        "special",    "values",
        "csv",     "any",         "unit_sphere", "hemisphere", "grazing_hemisphere"};
    return list;
}

Generator Generator::parse(DirectiveReader& reader, GlslType type, const std::filesystem::path& folder) {
    const std::string name = reader.word("a generator");
    const auto found = std::find(names().begin(), names().end(), name);
    if (found == names().end()) reader.fail("unknown generator '" + name + "'" + didYouMean(name, names()));
    Generator result(Kind::list, type);
    if (name == "values")
        result.readValues(reader);
    else if (name == "special")
        result.readSpecial(reader);
    else if (name == "grid")
        result.readGrid(reader);
    else if (name == "csv")
        result.readCsvColumns(reader, folder);
    else if (name == "any")
        result.kind_ = Kind::any;
    else if (name == "uniform" || name == "log_uniform") {
        result.kind_ = name == "uniform" ? Kind::uniform : Kind::logUniform;
        result.readRange(reader);
    } else {
        result.kind_ = name == "unit_sphere"  ? Kind::unitSphere
                       : name == "hemisphere" ? Kind::hemisphere
                                              : Kind::grazingHemisphere;
        if (type != GlslType{Base::real, 3}) reader.fail(name + " gives vec3, not " + type.name());
        if (result.kind_ == Kind::grazingHemisphere) {
            result.low_ = 1e-7;
            result.high_ = 0.1;
            if (reader.accept('(')) {
                result.low_ = reader.number();
                reader.expect(')');
            }
            if (!(result.low_ > 0.0 && result.low_ < 0.1))
                reader.fail("the smallest angle above the horizon must be in 0..0.1 rad");
        }
    }
    return result;
}

uint32_t Generator::readWord(DirectiveReader& reader) const {
    if (type_.isReal()) return wordOf(reader.real());
    const bool natural = type_.base == Base::natural;
    if (type_.base == Base::boolean) return reader.whole(0, 1) != 0 ? 1U : 0U;
    return static_cast<uint32_t>(reader.whole(
        natural ? 0 : std::numeric_limits<int32_t>::min(),
        natural ? int64_t{std::numeric_limits<uint32_t>::max()} : std::numeric_limits<int32_t>::max()));
}

void Generator::readValues(DirectiveReader& reader) {
    reader.expect('(');
    do {
        Words value;
        const bool bracketed = type_.components > 1;
        if (bracketed) reader.expect('(');
        for (int c = 0; c < type_.components; ++c) {
            if (c > 0) reader.expect(',');
            value.push_back(readWord(reader));
        }
        if (bracketed) reader.expect(')');
        list_.push_back(std::move(value));
    } while (reader.accept(','));
    reader.expect(')');
}

void Generator::readSpecial(DirectiveReader& reader) {
    bool positive = false;
    bool infinite = false;
    bool nan = false;
    if (reader.accept('(')) {
        do {
            if (reader.acceptWord("positive"))
                positive = true;
            else if (reader.acceptWord("inf"))
                infinite = true;
            else if (reader.acceptWord("nan"))
                nan = true;
            else
                reader.fail("expected positive, inf or nan in special(...)");
        } while (reader.accept(','));
        reader.expect(')');
    }
    if (type_.components != 1 || type_.base == Base::boolean)
        reader.fail("special gives single numbers, not " + type_.name());
    if (!type_.isReal()) {
        const bool natural = type_.base == Base::natural;
        for (const int64_t value : {int64_t{0}, int64_t{1}, int64_t{2}, int64_t{0x7fffffff}, int64_t{-1},
                                    int64_t{natural ? 0xffffffffLL : -0x80000000LL}})
            if (value >= 0 || (!positive && !natural)) list_.push_back({static_cast<uint32_t>(value)});
        return;
    }
    std::vector<float> reals = specialReals();
    if (infinite) reals.push_back(std::numeric_limits<float>::infinity());
    for (const float value : reals) {
        list_.push_back({wordOf(value)});
        if (!positive) list_.push_back({wordOf(-value)});
    }
    if (nan) list_.push_back({0x7fc00000U});
}

void Generator::readGrid(DirectiveReader& reader) {
    reader.expect('(');
    low_ = reader.number();
    reader.expect(',');
    high_ = reader.number();
    reader.expect(',');
    const int64_t count = reader.whole(2, kLargestList);
    reader.expect(')');
    if (type_.components != 1 || type_.base == Base::boolean)
        reader.fail("grid gives single numbers, not " + type_.name());
    for (int64_t i = 0; i < count; ++i) {
        const double at = double(i) / double(count - 1);
        const double value = low_ * (1.0 - at) + high_ * at;
        list_.push_back({type_.isReal() ? wordOf(static_cast<float>(value))
                                        : static_cast<uint32_t>(static_cast<int64_t>(std::llround(value)))});
    }
}

void Generator::readCsvColumns(DirectiveReader& reader, const std::filesystem::path& folder) {
    const CsvColumns csv = CsvColumns::parse(reader, folder);
    if (csv.columns.size() != static_cast<size_t>(type_.components))
        reader.fail(type_.name() + " needs " + std::to_string(type_.components) + " columns");
    csvFile_ = csv.file;
    for (const auto& row : csv.rows()) {
        Words value;
        for (const double number : row)
            value.push_back(type_.isReal() ? wordOf(static_cast<float>(number))
                                           : static_cast<uint32_t>(static_cast<int64_t>(number)));
        list_.push_back(std::move(value));
    }
    if (list_.empty()) reader.fail("the file has no rows");
}

void Generator::readRange(DirectiveReader& reader) {
    reader.expect('(');
    low_ = reader.number();
    reader.expect(',');
    high_ = reader.number();
    reader.expect(')');
    if (type_.base == Base::boolean) reader.fail("bool needs values(...) or any");
    if (!(low_ <= high_) || !std::isfinite(low_) || !std::isfinite(high_))
        reader.fail("expected two finite numbers, the smaller first");
    if (kind_ == Kind::logUniform && !(low_ > 0.0 || high_ < 0.0))
        reader.fail("log_uniform needs bounds of one sign, without 0");
    if (type_.isReal() && std::max(-low_, high_) > double(std::numeric_limits<float>::max()))
        reader.fail("the range must be one of floats");
    if (type_.isReal()) {
        low_ = double(static_cast<float>(low_));
        high_ = double(static_cast<float>(high_));
    }
    if (!type_.isReal() && (low_ < (type_.base == Base::natural ? 0.0 : -2147483648.0) ||
                            high_ > (type_.base == Base::natural ? 4294967295.0 : 2147483647.0)))
        reader.fail("the range must be one of " + type_.name());
}

uint32_t Generator::drawWord(Pcg32& random) const {
    if (kind_ == Kind::any) {
        if (type_.base == Base::boolean) return random.next() >> 31;
        uint32_t word = random.next();
        while (type_.isReal() && !isFiniteWord(word))
            word = random.next();
        return word;
    }
    double value = 0.0;
    switch (random.below(32)) {
        case 0:
            value = low_;
            break;
        case 1:
            value = high_;
            break;
        default:
            if (kind_ == Kind::uniform)
                value = type_.isReal() ? random.uniform(low_, high_)
                                       : std::floor(random.uniform(std::ceil(low_), std::floor(high_) + 1.0));
            else
                value = low_ > 0.0 ? random.logUniform(low_, high_) : -random.logUniform(-high_, -low_);
    }
    if (!type_.isReal()) return static_cast<uint32_t>(static_cast<int64_t>(std::round(value)));
    return wordOf(static_cast<float>(value));
}

Words Generator::draw(Pcg32& random) const {
    const auto turn = [&] { return random.uniform(0.0, glm::two_pi<double>()); };
    switch (kind_) {
        case Kind::unitSphere: {
            const double u = random.uniform();
            return directionWords(uniformSphere({u, random.uniform()}));
        }
        case Kind::hemisphere: {
            const double u = random.uniform();
            return directionWords(uniformHemisphere({u, random.uniform()}));
        }
        case Kind::grazingHemisphere: {
            const double angle = random.logUniform(low_, high_);
            return directionWords(fromPolar(glm::half_pi<double>() - angle, turn()));
        }
        default: {
            Words words(static_cast<size_t>(type_.components));
            for (uint32_t& word : words)
                word = drawWord(random);
            return words;
        }
    }
}

bool Generator::allows(std::span<const uint32_t> words) const {
    switch (kind_) {
        case Kind::list:
            return std::any_of(list_.begin(), list_.end(), [&](const Words& item) {
                return std::equal(item.begin(), item.end(), words.begin(), words.end());
            });
        case Kind::any:
            return !type_.isReal() || std::all_of(words.begin(), words.end(), isFiniteWord);
        case Kind::uniform:
        case Kind::logUniform:
            return std::all_of(words.begin(), words.end(), [&](uint32_t word) {
                const double value = numberOf(type_.base, word);
                return value >= low_ && value <= high_;
            });
        default: {
            const glm::dvec3 v(double(realOf(words[0])), double(realOf(words[1])), double(realOf(words[2])));
            const double length = glm::length(v);
            if (!(std::abs(length - 1.0) < 3e-7)) return false;
            if (kind_ == Kind::unitSphere) return true;
            if (kind_ == Kind::hemisphere) return v.z > 0.0;
            return v.z >= 0.99 * low_ && v.z <= high_;
        }
    }
}

}  // namespace lobe::harness
