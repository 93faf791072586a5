/// What a JSON document must look like, as tables, and the check that names the first property that does not.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lobe {

struct ObjectSchema;

/// A rule for one value.
struct ValueRule {
    enum class Kind : uint8_t { boolean, text, integer, number, index, array, object, map };
    Kind kind = Kind::object;
    double minimum = 0.0;  ///< numbers, inclusive
    double maximum = 0.0;
    bool aboveMinimum = false;            ///< the minimum itself is excluded
    std::vector<int64_t> amongNumbers;    ///< integers: if not empty, one of these
    std::vector<std::string> amongTexts;  ///< texts: likewise
    std::string target;   ///< indices: the root array ("accessors") that must have the element
    size_t minItems = 0;  ///< arrays
    size_t maxItems = SIZE_MAX;
    const ObjectSchema* schema = nullptr;  ///< objects
    std::vector<ValueRule> items;          ///< arrays, maps: one rule for all elements
};

struct PropertyRule {
    std::string name;
    ValueRule rule;
    bool required = false;
};

struct ObjectSchema {
    std::vector<PropertyRule> properties;  ///< others are allowed and not looked at
};

ValueRule boolean();
ValueRule text();
ValueRule oneOf(std::vector<std::string> texts);
ValueRule oneOf(std::vector<int64_t> numbers);
ValueRule integer(int64_t minimum, int64_t maximum = INT64_C(1) << 53);
ValueRule number();                                ///< any that a float can hold
ValueRule number(double minimum, double maximum);  ///< inclusive
ValueRule numberAbove(double minimum);
ValueRule indexOf(std::string rootArray);
ValueRule arrayOf(ValueRule item, size_t minItems = 0, size_t maxItems = SIZE_MAX);
ValueRule objectOf(const ObjectSchema& schema);
ValueRule mapOf(ValueRule value);  ///< an object with any names

PropertyRule required(std::string name, ValueRule rule);
PropertyRule optional(std::string name, ValueRule rule);

/// Throws InputError "FILE: accessors[3].count: VALUE; expected ...".
void checkJson(const nlohmann::json& root, const ObjectSchema& schema, const std::string& file);

}  // namespace lobe
